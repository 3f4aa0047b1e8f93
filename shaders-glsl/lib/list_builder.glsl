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
#if ASSIGN == ASSIGN_BRUTE || ASSIGN == ASSIGN_RECTANGLES || ASSIGN == ASSIGN_RASTER
    return number;
#else
    return read_candidate(number).light;
#endif
}

#if WRITE_LISTS

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
