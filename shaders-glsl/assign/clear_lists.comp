// Empties what counting adds to: the length of each list, and its bits where these are set one by one.
#version 460
#include "generated/gpu_interface.glsl"

#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Words that a thread clears in one turn.
const uint AT_ONCE = 8u;

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible < state.visible)
        list_lengths[visible] = 0u;
    if (ASSIGN == ASSIGN_BRUTE || state.masked == 0u)
        return;
    // The rows of a workgroup's lists lie behind each other.
    uint row = ASSIGN_WORKGROUP * state.mask_words;
    uint end = min((gl_WorkGroupID.x + 1u) * row, state.visible * state.mask_words);
    uint first = gl_WorkGroupID.x * row + gl_LocalInvocationID.x;
    for (uint word = first; word < end; word += ASSIGN_WORKGROUP * AT_ONCE)
        [[unroll]] for (uint i = 0u; i < AT_ONCE; ++i)
            if (word + i * ASSIGN_WORKGROUP < end)
                light_masks[word + i * ASSIGN_WORKGROUP] = 0u;
}
