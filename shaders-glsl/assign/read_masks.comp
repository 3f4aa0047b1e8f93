// Reads each list off its bits: WRITE_LISTS 0 its length, 1 its lights, as many as its store takes. Bits that did not fit were not
// set: then lists are empty, but for those by offsets, whose lights are sorted instead.
#version 460
#include "lib/list_builder.glsl"
#include "lib/list_store.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Turns take several of everything: lavapipe ends a shader's loops after 65 535 turns of all of them.
const uint WORDS_AT_ONCE = 4u;
const uint LIGHTS_AT_ONCE = 8u;
// Times four words that a turn may skip where they are empty, as most are. One loop, not two: llvmpipe runs the body of a
// loop once even where no lane enters it, and lists go on without waiting for each other.
const uint SKIPS = 8u;

uint word_of(uint visible, uint word)
{
    return word < state.mask_words ? read_mask(visible * state.mask_words + word) : 0u;
}

uvec4 words_of(uint visible, uint first)
{
    return uvec4(word_of(visible, first), word_of(visible, first + 1u), word_of(visible, first + 2u), word_of(visible, first + 3u));
}

// The lowest bit set among four words, counted through, which is cleared.
uint take_lowest(inout uvec4 words)
{
    uint at = words.x != 0u ? 0u : words.y != 0u ? 1u : words.z != 0u ? 2u : 3u;
    uint bit = uint(findLSB(words[at]));
    words[at] &= words[at] - 1u;
    return at * 32u + bit;
}

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible)
        return;
#if WRITE_LISTS
#if LISTS == LISTS_OFFSETS
    uint lights = 0u; // offsets tell
#else
    uint lights = state.masked != 0u ? list_lengths[visible] : 0u;
#endif
    uvec2 entries = keep_list(visible, lights);
    uint entry = entries.x, end = entries.y;
    uint next = 0u, first = 0u;
    uvec4 words = uvec4(0u);
    while (entry < end && (next < state.mask_words || any(notEqual(words, uvec4(0u))))) {
        [[unroll]] for (uint i = 0u; i < SKIPS; ++i) {
            if (words == uvec4(0u) && next < state.mask_words) {
                words = words_of(visible, next);
                first = next * 32u;
                next += WORDS_AT_ONCE;
            }
        }
        [[unroll]] for (uint i = 0u; i < LIGHTS_AT_ONCE; ++i) {
            if (words != uvec4(0u) && entry < end)
                light_indices[entry++] = light_of_number(first + take_lowest(words));
        }
    }
#else
    uint lights_met = 0u;
    for (uint word = 0u; word < state.mask_words; word += WORDS_AT_ONCE)
        [[unroll]] for (uint i = 0u; i < WORDS_AT_ONCE; ++i)
            lights_met += uint(bitCount(word_of(visible, word + i)));
    list_lengths[visible] = lights_met;
#endif
}
