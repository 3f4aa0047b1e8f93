// Sphere against cell, one test per grid shape. `sphere` is (centre in the clustering camera's space, radius).
// Every step is `precise`: all ways of assignment get the same answer, to the bit.
#pragma once

#include "lib/cluster_space.glsl"

#if SPACE == SPACE_PERSPECTIVE

// HS (Enhuber section 3.5.2): the centre inside the six planes moved out by the radius.
struct CellBounds {
    // Unit normals in the xz (left, right) and yz (bottom, top) plane, pointing inwards.
    vec2 left, right, bottom, top;
    float z_near, z_far;
};

float slice_depth(uint slice)
{
    precise float depth = -grid.origin.z * exp2(float(slice) * grid.cell.z);
    return depth;
}

CellBounds cell_bounds(uvec3 cell)
{
    precise vec2 low = grid.origin.xy + grid.cell.xy * vec2(cell.xy);
    precise vec2 high = grid.origin.xy + grid.cell.xy * vec2(cell.xy + 1u);
    return CellBounds(normalize(vec2(1.0, low.x)), -normalize(vec2(1.0, high.x)), normalize(vec2(1.0, low.y)),
                      -normalize(vec2(1.0, high.y)), slice_depth(cell.z), slice_depth(cell.z + 1u));
}

bool meets(CellBounds cell, vec4 sphere)
{
    precise vec4 sides = vec4(dot(cell.left, sphere.xz), dot(cell.right, sphere.xz), dot(cell.bottom, sphere.yz), dot(cell.top, sphere.yz));
    precise vec2 ends = vec2(cell.z_near - sphere.z, sphere.z - cell.z_far);
    return min(min(min(sides.x, sides.y), min(sides.z, sides.w)), min(ends.x, ends.y)) >= -sphere.w;
}

// Whether a sphere whose centre lies anywhere in a box may meet the cell; `sphere` has the box's centre.
bool meets_grown(CellBounds cell, vec4 sphere, vec3 half_extent)
{
    vec4 sides = vec4(dot(cell.left, sphere.xz), dot(cell.right, sphere.xz), dot(cell.bottom, sphere.yz), dot(cell.top, sphere.yz));
    sides += vec4(dot(abs(cell.left), half_extent.xz), dot(abs(cell.right), half_extent.xz),
                  dot(abs(cell.bottom), half_extent.yz), dot(abs(cell.top), half_extent.yz));
    vec2 ends = vec2(cell.z_near - sphere.z, sphere.z - cell.z_far) + half_extent.z;
    return min(min(min(sides.x, sides.y), min(sides.z, sides.w)), min(ends.x, ends.y)) >= -sphere.w;
}

#else

// Nearest point of the box: exact.
struct CellBounds {
    vec3 centre, half_extent;
};

CellBounds cell_bounds(uvec3 cell)
{
    precise CellBounds bounds = CellBounds(grid.origin + grid.cell * (vec3(cell) + 0.5), 0.5 * grid.cell);
    return bounds;
}

bool meets(CellBounds cell, vec4 sphere)
{
    precise vec3 outside = max(abs(sphere.xyz - cell.centre) - cell.half_extent, 0.0);
    precise vec2 squares = vec2(dot(outside, outside), sphere.w * sphere.w);
    return squares.x <= squares.y;
}

// Whether a sphere whose centre lies anywhere in a box may meet the cell; `sphere` has the box's centre.
bool meets_grown(CellBounds cell, vec4 sphere, vec3 half_extent)
{
    return meets(CellBounds(cell.centre, cell.half_extent + half_extent), sphere);
}

#endif
