// The light list of a sample's visible cluster.
#pragma once

#include "lib/cell_lists.glsl"

// The cluster of what some other camera sees, by its index in the grid; NO_GROUP outside.
uint group_seen(ViewData view, vec2 pixel, float depth)
{
    vec3 local = position_seen(view, pixel, depth);
#if SPACE == SPACE_PERSPECTIVE
    if (local.z >= 0.0)
        return NO_GROUP;
#endif
    vec3 coordinates = cluster_coordinates(local);
    if (any(lessThan(coordinates, vec3(0.0))) || any(greaterThan(coordinates, vec3(grid.dimensions))))
        return NO_GROUP;
    return linear_cluster(cell_of_position(local));
}
