// The least that light assignment can do: reads the place and reach of every light once, and writes every entry of the
// final lists once. What is written does not matter, but that it follows from what is read.
#version 460
#include "generated/gpu_interface.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint thread = (gl_WorkGroupID.y * PACKET_ROW + gl_WorkGroupID.x) * ASSIGN_WORKGROUP + gl_LocalInvocationID.x;
    uint seen = thread;
    if (thread < grid.light_count) {
        LightData light = read_light(thread);
        seen ^= floatBitsToUint(light.position.x + light.position.y + light.position.z + light.r1);
    }
    // Where there are more lights than entries, the others are read in vain; no compiler can know that.
    if (thread < min(state.index_total, grid.index_capacity) || seen == 0xFFFFFFFFu)
        light_indices[min(thread, grid.index_capacity - 1u)] = seen;
}
