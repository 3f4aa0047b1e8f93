// Reads each list off its bits: WRITE_LISTS 0 its length, 1 its lights.
#version 460
#include "lib/list_builder.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_GROUP) in;

// Lights that are read in one turn: some drivers end loops after 2^16 turns.
const uint AT_ONCE = 8u;

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible)
        return;
    uint first = visible * state.mask_words;
#if WRITE_LISTS
    uint slot = list_offsets[visible];
    uint end = min(list_offsets[visible + 1u], grid.index_capacity);
    for (uint word = 0u; slot < end; ++word) {
        for (uint bits = light_masks[first + word]; bits != 0u;) {
            [[unroll]] for (uint i = 0u; i < AT_ONCE; ++i) {
                if (bits != 0u && slot < end)
                    light_indices[slot++] = light_of_number(word * 32u + uint(findLSB(bits)));
                bits &= bits - 1u;
            }
        }
    }
#else
    uint lights_met = 0u;
    for (uint word = first; word < first + state.mask_words; ++word)
        lights_met += uint(bitCount(light_masks[word]));
    list_lengths[visible] = lights_met;
#endif
}
