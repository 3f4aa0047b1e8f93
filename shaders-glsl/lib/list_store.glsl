// Where the entries of a list lie, by the store of lists:
//
//   LISTS_OFFSETS  one list behind the other; a prefix sum of the lengths has said where each begins
//   LISTS_FIXED    as many entries for each list, at its cluster's place; its length is kept beside them, so that a reader knows
//                  the end before it has read an entry, and lists that are too long tell by how much
//   LISTS_CAPPED   a range that a counter hands out; where it begins is kept, and its length
#pragma once

#include "lib/counters.glsl"

// Gives the entries, from the first to behind the last, of a list that should have so many lights, and keeps where they lie.
uvec2 keep_list(uint visible, uint lights)
{
#if LISTS == LISTS_OFFSETS
    return uvec2(list_offsets[visible], min(list_offsets[visible + 1u], grid.index_capacity));
#elif LISTS == LISTS_FIXED
    list_lengths[visible] = lights;
    if (lights > grid.list_capacity)
        atomicMax(new_state.longest, lights);
    uint first = visible * grid.list_capacity;
    return uvec2(first, first + min(lights, grid.list_capacity));
#else
    uint kept = min(lights, grid.list_capacity);
    count(COUNTER_LIGHTS_DROPPED, lights - kept);
    uint first = atomicAdd(new_state.index_total, kept);
    list_offsets[visible] = first;
    list_lengths[visible] = kept;
    return uvec2(first, min(first + kept, grid.index_capacity));
#endif
}
