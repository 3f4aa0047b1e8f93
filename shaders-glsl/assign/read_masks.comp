// Reads each segment of a list off its bits: WRITE_LISTS 0 its length, 1 its lights.
#version 460
#include "generated/gpu_interface.glsl"

layout(local_size_x = ASSIGN_GROUP) in;

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible)
        return;
    uint list = visible * grid.segment_count + gl_WorkGroupID.y;
    uint first = list * grid.mask_words;
#if WRITE_LISTS
    uint slot = list_offsets[list];
    for (uint word = 0u; word < grid.mask_words; ++word) {
        uint light = gl_WorkGroupID.y * grid.segment_size + 32u * word;
        for (uint bits = light_masks[first + word]; bits != 0u && slot < grid.index_capacity; bits &= bits - 1u)
            light_indices[slot++] = light + uint(findLSB(bits));
    }
#else
    uint lights_met = 0u;
    for (uint word = 0u; word < grid.mask_words; ++word)
        lights_met += uint(bitCount(light_masks[first + word]));
    segment_counts[list] = lights_met;
#endif
}
