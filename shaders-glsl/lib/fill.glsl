// A light to the clusters of a tile between its slices (Örtegren and Persson section 4.4): linked to their lists, or counted, or written.
#pragma once

#include "lib/list_builder.glsl"
#include "lib/slice_range.glsl"
#include "lib/visible.glsl"

// By the number of the tile, x + X y of X tiles side by side; clusters are numbered on from slice to slice.
void fill_range(uint tile, uint range, uint light)
{
    uint first = range & NO_SLICE, behind = range >> 16;
    if (first == NO_SLICE || behind == NO_SLICE)
        return;
    uint tiles = grid.dimensions.x * grid.dimensions.y;
    for (uint slice = first; slice + behind < grid.dimensions.z; ++slice) {
        uint visible = visible_index(tile + tiles * slice);
        if (visible == NO_CLUSTER)
            continue;
#if LISTS == LISTS_LINKED
        link_light(visible, light, MESH == MESH_SPOT);
#else
        add_light(visible, light);
#endif
    }
}
