// The light list of a sample's cell in a world grid: outside, that of the nearest cell. It loses no light there as long as the
// centres of all lie in the grid.
#pragma once

#include "lib/cell_lists.glsl"

// The cell of a point of the world, by its index in the grid.
uint group_at(vec3 world)
{
    return linear_cluster(cell_of_position((grid.clustering_from_world * vec4(world, 1.0)).xyz));
}
