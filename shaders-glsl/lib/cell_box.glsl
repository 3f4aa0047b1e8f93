// A cell of an orthographic grid, or what its samples take of it: an axis-aligned box. Its edges are its normals, and each axis has a plane at both
// ends, so half spaces, SAT-E and SAT-P are one test.
#pragma once

#include "lib/measured_bounds.glsl"

struct CellBounds {
    vec3 centre, half_extent;
};

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
    precise CellBounds bounds = CellBounds(0.5 * (low + high), 0.5 * (high - low));
    return bounds;
}

bool within_planes(CellBounds cell, vec4 sphere)
{
    precise vec3 outside = abs(sphere.xyz - cell.centre) - cell.half_extent;
    return max(max(outside.x, outside.y), outside.z) <= sphere.w;
}

// Whether a sphere that passes the planes of a part of a cell fails those of the cell: never.
bool beyond_cell(CellBounds cell, vec4 sphere)
{
    return false;
}

// False only where within_planes is false for every cell of the range that `range` bounds.
bool may_be_within_planes(CellBounds range, vec4 sphere)
{
    vec3 reach = abs(range.centre) + range.half_extent + abs(sphere.xyz);
    return within_planes(range, vec4(sphere.xyz, sphere.w + RANGE_ROUNDING * (max(max(reach.x, reach.y), reach.z) + sphere.w)));
}

// As within_planes, for some point of a box around the centre.
bool within_planes_grown(CellBounds cell, vec4 sphere, vec3 half_extent)
{
    return within_planes(CellBounds(cell.centre, cell.half_extent + half_extent), sphere);
}

bool normals_separate(CellBounds cell, vec4 sphere)
{
    return !within_planes(cell, sphere);
}

bool edges_separate(CellBounds cell, vec4 sphere)
{
    return !within_planes(cell, sphere);
}

bool nearest_point_within(CellBounds cell, vec4 sphere)
{
    precise vec3 outside = max(abs(sphere.xyz - cell.centre) - cell.half_extent, 0.0);
    precise vec2 squares = vec2(dot(outside, outside), sphere.w * sphere.w);
    return squares.x <= squares.y;
}

// One of the two rectangles of equal z that hold the vertices, relative to a centre.
struct CellEnd {
    vec2 low, high;
    float z;
};

CellEnd cell_end(CellBounds cell, vec3 centre, bool far)
{
    precise vec3 middle = cell.centre - centre;
    precise CellEnd end = CellEnd(middle.xy - cell.half_extent.xy, middle.xy + cell.half_extent.xy,
                                  far ? middle.z - cell.half_extent.z : middle.z + cell.half_extent.z);
    return end;
}
