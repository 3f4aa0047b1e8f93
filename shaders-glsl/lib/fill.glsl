// A light to the clusters of a tile between its slices (Örtegren and Persson section 4.4): linked to their lists, or counted, or written.
#pragma once

#include "lib/cluster_space.glsl"
#include "lib/list_builder.glsl"
#include "lib/slice_range.glsl"
#include "lib/visible.glsl"

void fill_range(uvec2 tile, uint range, uint light)
{
    uint first = range & NO_SLICE, behind = range >> 16;
    if (first == NO_SLICE || behind == NO_SLICE)
        return;
    for (uint slice = first; slice + behind < grid.dimensions.z; ++slice) {
        uint visible = visible_index(linear_cluster(uvec3(tile, slice)));
        if (visible == NO_CLUSTER)
            continue;
#if LISTS == LISTS_LINKED
        link_light(visible, light, MESH == MESH_SPOT);
#else
        add_light(visible, light);
#endif
    }
}
