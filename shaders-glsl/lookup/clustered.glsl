// The light list of a sample's visible cluster.
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
