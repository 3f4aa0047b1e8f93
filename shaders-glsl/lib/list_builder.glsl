// Lists built in any order that still come out by ascending light.
//
// A list is a run of segments, one per range of lights. Few lights: a bit per light, set while counting; the lists
// are read off the bits. Many: segments are counted, filled in any order, and each is then sorted; it is short.
#pragma once

#include "generated/gpu_interface.glsl"

#if WRITE_LISTS

// Puts a light into its segment of a list; the counts run down to zero as the segments fill up.
void add_light(uint visible, uint light)
{
    uint list = visible * grid.segment_count + light / grid.segment_size;
    uint slot = list_offsets[list] + atomicAdd(segment_counts[list], 0xFFFFFFFFu) - 1u;
    if (slot < grid.index_capacity)
        light_indices[slot] = light;
}

#else

void add_light(uint visible, uint light)
{
    uint segment = light / grid.segment_size;
    uint list = visible * grid.segment_count + segment;
    if (grid.mask_words > 0u) {
        uint bit = light - segment * grid.segment_size;
        atomicOr(light_masks[list * grid.mask_words + (bit >> 5)], 1u << (bit & 31u));
    } else {
        atomicAdd(segment_counts[list], 1u);
    }
}

#endif
