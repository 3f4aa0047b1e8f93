// A model: the oriented box of one instance, by its index along x. A range of more than one is bounded by nothing
// (TEST_BOUNDED 0).
#pragma once

#include "lib/measured_bounds.glsl"

struct CellBounds {
    vec3 centre, half_extent;
    vec3 axes[3]; // unit, perpendicular
};

CellBounds range_bounds(uvec3 first, uvec3 last)
{
    ModelBox box = model_boxes[first.x];
    return CellBounds(box.centre, box.half_extent, box.axes);
}

bool nearest_point_within(CellBounds cell, vec4 sphere)
{
    precise vec3 offset = sphere.xyz - cell.centre;
    precise vec3 along = vec3(dot(cell.axes[0], offset), dot(cell.axes[1], offset), dot(cell.axes[2], offset));
    precise vec3 outside = max(abs(along) - cell.half_extent, 0.0);
    precise vec2 squares = vec2(dot(outside, outside), sphere.w * sphere.w);
    return squares.x <= squares.y;
}

// False only where nearest_point_within is false for every sphere of that radius around a point of a box.
bool nearest_point_within_grown(CellBounds cell, vec4 sphere, vec3 half_extent)
{
    vec3 reach = abs(cell.centre) + cell.half_extent + abs(sphere.xyz) + half_extent;
    float rounding = RANGE_ROUNDING * (max(max(reach.x, reach.y), reach.z) + sphere.w);
    return nearest_point_within(cell, vec4(sphere.xyz, sphere.w + length(half_extent) + rounding));
}
