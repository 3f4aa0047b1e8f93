// The light list of a sample's visible cluster, for every lookup by the cells of a grid; each says itself what cell a point of the
// world lies in.
#pragma once

#include "lib/cluster_space.glsl"
#include "lib/visible.glsl"

struct LightCursor {
    uint next, end;
};

LightCursor list_of_visible(uint visible)
{
    return LightCursor(min(list_offsets[visible], grid.index_capacity),
                       min(list_offsets[visible + 1u], grid.index_capacity));
}

// The lights of a sample; false where the sample's cluster is missing.
bool find_lights(ViewData view, vec2 pixel, float depth, out LightCursor cursor)
{
    uint visible = visible_index(cluster_of_sample(view, pixel, depth));
    cursor = LightCursor(0u, 0u);
    if (visible == NO_CLUSTER)
        return false;
    cursor = list_of_visible(visible);
    return true;
}

uint light_at(uint position)
{
    return read_index(position);
}

const uint NO_GROUP = NO_CLUSTER;

// The cluster of a sample, by its index in the grid.
uint group_of_sample(ViewData view, vec2 pixel, float depth)
{
    return cluster_of_sample(view, pixel, depth);
}

// Fragments that were counted in a cluster.
uint fragments_of_group(uint cluster)
{
    uint visible = visible_index(cluster);
    return visible == NO_CLUSTER ? 0u : visible_fragments[visible];
}
