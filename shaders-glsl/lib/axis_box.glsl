// Tests of a box along the axes of the clustering camera's space. Its edges are its normals, and each axis has a plane at both
// ends, so half spaces, SAT-E and SAT-P are one test.
#pragma once

struct CellBounds {
    vec3 centre, half_extent;
};

CellBounds axis_box(vec3 low, vec3 high)
{
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
