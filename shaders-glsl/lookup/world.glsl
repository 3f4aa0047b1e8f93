// The light list of a sample's cell in a world grid: outside, that of the nearest cell. It loses no light there as long as the
// centres of all lie in the grid.
#pragma once

#include "lib/cell_lists.glsl"

// The cell of what some other camera sees, by its index in the grid.
uint group_seen(ViewData view, vec2 pixel, float depth)
{
    return linear_cluster(cell_of_position(position_seen(view, pixel, depth)));
}
