// Reads each list off its bits: WRITE_LISTS 0 its length, 1 its lights.
#version 460
#include "lib/list_builder.glsl"

layout(local_size_x = ASSIGN_GROUP) in;

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible)
        return;
    uint first = visible * state.mask_words;
#if WRITE_LISTS
    uint slot = list_offsets[visible];
    uint end = min(list_offsets[visible + 1u], grid.index_capacity);
    for (uint word = 0u; slot < end; ++word)
        for (uint bits = light_masks[first + word]; bits != 0u && slot < end; bits &= bits - 1u)
            light_indices[slot++] = light_of_number(word * 32u + uint(findLSB(bits)));
#else
    uint lights_met = 0u;
    for (uint word = first; word < first + state.mask_words; ++word)
        lights_met += uint(bitCount(light_masks[word]));
    list_lengths[visible] = lights_met;
#endif
}
