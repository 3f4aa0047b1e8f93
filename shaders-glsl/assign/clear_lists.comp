// Empties what counting fills in any order: the bits of each segment of a list, or its length.
#version 460
#include "generated/gpu_interface.glsl"

layout(local_size_x = ASSIGN_GROUP) in;

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible)
        return;
    uint list = visible * grid.segment_count + gl_WorkGroupID.y;
    segment_counts[list] = 0u;
    for (uint word = 0u; word < grid.mask_words; ++word)
        light_masks[list * grid.mask_words + word] = 0u;
}
