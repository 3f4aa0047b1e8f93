// Scattering, first half: each candidate to the groups of visible clusters whose cells it may meet. A thread takes a
// candidate to GROUP_CHUNK groups.
// FILL_GROUPS 0 counts the lights of groups, 1 lists them, in any order: what is made of them is bits.
#version 460
#include "lib/halves.glsl"
#include "generated/gpu_interface.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_WORKGROUP) in;

shared uvec3 cells_of_group[GROUP_CHUNK];

void main()
{
    uint first = gl_WorkGroupID.y * GROUP_CHUNK;
    uint there = min((state.visible + ASSIGN_WORKGROUP - 1u) / ASSIGN_WORKGROUP - first, GROUP_CHUNK);
    uint thread = gl_LocalInvocationID.x;
    if (thread < there)
        cells_of_group[thread] = groups[first + thread].cells;
    barrier();
    uint number = gl_GlobalInvocationID.x;
    uvec3 cells = read_candidate(min(number, state.candidates - 1u)).cells;
    uint met = 0u;
    [[unroll]] for (uint i = 0u; i < GROUP_CHUNK; ++i)
        met |= uint(overlap(cells, cells_of_group[i])) << i;
    if (number >= state.candidates)
        return;
    for (met &= (1u << there) - 1u; met != 0u; met &= met - 1u) {
        uint group = first + uint(findLSB(met));
#if FILL_GROUPS
        uint entry = groups[group].first_packet * ASSIGN_WORKGROUP + atomicAdd(groups[group].listed, 1u);
        group_lights[entry] = number;
#else
        atomicAdd(groups[group].lights, 1u);
#endif
    }
}
