// A cell of an orthographic grid, or what its samples take of it: an axis-aligned box.
#pragma once

#include "lib/measured_bounds.glsl"
#include "lib/axis_box.glsl"

// What cells from one to another fill together.
CellBounds range_bounds(uvec3 first, uvec3 last)
{
    precise vec3 middle = 0.5 * vec3(first + last + 1u);
    precise CellBounds bounds = CellBounds(grid.origin + grid.cell * middle, 0.5 * (grid.cell * vec3(last - first + 1u)));
    return bounds;
}

// What the samples of a visible cluster take of its cell; nothing of the kind where it holds none.
CellBounds measured_bounds(uint visible, uvec3 cell)
{
    vec3 low = vec3(low_bound(visible, 0u), low_bound(visible, 1u), low_bound(visible, 2u));
    vec3 high = vec3(high_bound(visible, 0u), high_bound(visible, 1u), high_bound(visible, 2u));
    return axis_box(low, high);
}
