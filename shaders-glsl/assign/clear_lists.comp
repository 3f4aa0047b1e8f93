// Empties what counting adds to: the length of each list, and its bits where these are set one by one; or lists that are linked.
#version 460
#include "lib/light_nodes.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible)
        return;
#if LISTS == LISTS_LINKED
    list_offsets[visible] = NO_NODE;
#else
    list_lengths[visible] = 0u;
    if (ASSIGN == ASSIGN_BRUTE || state.masked == 0u)
        return;
    uint first = visible * state.mask_words;
    for (uint word = first; word < first + state.mask_words; ++word)
        light_masks[word] = 0u;
#endif
}
