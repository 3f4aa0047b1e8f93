// Lists built in any order that still come out by ascending light.
//
// Lights are numbered in ascending order: by themselves (brute force, rectangles, meshes), or as candidates. Where `state.masked`, a list is
// a row of bits, one a number, set while counting, and read off afterwards: no pair is tested twice. Bits of too many
// clusters times lights do not fit: then lights are counted, written in any order, and each list is sorted.
#pragma once

#include "generated/gpu_interface.glsl"

// The light behind a number.
uint light_of_number(uint number)
{
#if ASSIGN == ASSIGN_HIERARCHY || ASSIGN == ASSIGN_SCATTER
    return read_candidate(number).light;
#else
    return number;
#endif
}

#if LISTS == LISTS_LINKED

#include "lib/light_nodes.glsl"

// Makes a node of a light, which becomes the first of its list; nodes that the pool has no room for are counted alone.
void link_light(uint visible, uint light, bool is_spot)
{
    uint node = atomicAdd(new_state.index_total, 1u);
    if (node >= grid.index_capacity)
        return;
    uint next = atomicExchange(list_offsets[visible], node);
#if NODE_WORDS == 2
    light_indices[2u * node] = light | (is_spot ? 0u : KIND_OF_POINT);
    light_indices[2u * node + 1u] = next;
#else
    light_indices[node] = light << 20 | next;
#endif
}

#elif WRITE_LISTS

// Puts a light into its list; the lengths run down to zero as lists fill up.
void add_light(uint visible, uint number)
{
    uint entry = list_offsets[visible] + atomicAdd(list_lengths[visible], 0xFFFFFFFFu) - 1u;
    if (entry < grid.index_capacity)
        light_indices[entry] = number;
}

#else

// Sets the bit of a light on a list.
void mark_light(uint visible, uint number)
{
    atomicOr(light_masks[visible * state.mask_words + (number >> 5)], 1u << (number & 31u));
}

void add_light(uint visible, uint number)
{
    if (state.masked != 0u)
        mark_light(visible, number);
    else
        atomicAdd(list_lengths[visible], 1u);
}

#endif
