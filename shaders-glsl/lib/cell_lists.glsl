// The light list of a sample's visible cluster, for every lookup by the cells of a grid.
#pragma once

#include "lib/cluster_space.glsl"
#include "lib/visible_lists.glsl"

// The cluster of a sample, by its index in the grid.
uint group_of_sample(ViewData view, vec2 pixel, float depth)
{
    return cluster_of_sample(view, pixel, depth);
}

// Position of a sample in the clustering camera's space, also of a camera that only looks.
vec3 position_seen(ViewData view, vec2 pixel, float depth)
{
    vec4 world = view.world_from_view * vec4(view_position(view, pixel, depth), 1.0);
    return (grid.clustering_from_world * world).xyz;
}
