// A cell of a perspective grid, or what its samples take of it: the piece of a frustum between two tangents in x and in y,
// and two depths.
#pragma once

#include "lib/measured_bounds.glsl"

// Whether some test asks the tangents of a cell beside its planes.
#define HAS_TANGENTS (TEST_SAT_E || TEST_SAT_N || TEST_SAT_P || TEST_SAT_V || TEST_NEAREST || TEST_MM || CONES != CONES_UNASKED)

struct CellBounds {
    // Unit normals in the xz (left, right) and yz (bottom, top) plane, pointing inwards.
    vec2 left, right, bottom, top;
    float z_near, z_far;
#if BOUNDS == BOUNDS_BOX
    // Those of the cell in which the samples lie.
    vec2 outer_left, outer_right, outer_bottom, outer_top;
#endif
#if HAS_TANGENTS
    // Tangents of left and bottom, right and top.
    vec2 low, high;
#endif
};

// z of the plane before a slice, from the table that decides slices. Where nothing is visible yet, a range is no range.
float slice_depth(uint slice)
{
    return -slice_planes[min(slice, grid.dimensions.z)];
}

// Between tangents and between depths (near, far), along z.
CellBounds frustum_piece(vec2 low, vec2 high, vec2 ends)
{
    CellBounds bounds;
    bounds.left = normalize(vec2(1.0, low.x));
    bounds.right = -normalize(vec2(1.0, high.x));
    bounds.bottom = normalize(vec2(1.0, low.y));
    bounds.top = -normalize(vec2(1.0, high.y));
    bounds.z_near = ends.x;
    bounds.z_far = ends.y;
#if HAS_TANGENTS
    bounds.low = low;
    bounds.high = high;
#endif
    return bounds;
}

// Tangents of the left and the lower side of a tile.
vec2 tile_tangents(uvec2 tile)
{
    precise vec2 tangents = grid.origin.xy + grid.cell.xy * vec2(tile);
    return tangents;
}

// What cells from one to another fill together.
CellBounds range_bounds(uvec3 first, uvec3 last)
{
    vec2 low = tile_tangents(first.xy), high = tile_tangents(last.xy + 1u);
    return frustum_piece(low, high, vec2(slice_depth(first.z), slice_depth(last.z + 1u)));
}

// What the samples of a visible cluster take of its cell; nothing of the kind where it holds none.
CellBounds measured_bounds(uint visible, uvec3 cell)
{
    CellBounds whole = range_bounds(cell, cell);
    vec2 ends = -vec2(low_bound(visible, BOUND_AXES - 1u), high_bound(visible, BOUND_AXES - 1u));
#if BOUNDS == BOUNDS_BOX
    vec2 low = vec2(low_bound(visible, 0u), low_bound(visible, 1u));
    vec2 high = vec2(high_bound(visible, 0u), high_bound(visible, 1u));
    CellBounds bounds = frustum_piece(low, high, ends);
    bounds.outer_left = whole.left;
    bounds.outer_right = whole.right;
    bounds.outer_bottom = whole.bottom;
    bounds.outer_top = whole.top;
    return bounds;
#else
    whole.z_near = ends.x;
    whole.z_far = ends.y;
    return whole;
#endif
}

// Whether a sphere that passes the planes of a part of a cell fails the sides of the cell: of two planes through the apex the
// outer one is not always nearer to what lies behind both (see may_be_within_planes).
bool beyond_cell(CellBounds cell, vec4 sphere)
{
#if BOUNDS == BOUNDS_BOX
    precise vec4 sides = vec4(dot(cell.outer_left, sphere.xz), dot(cell.outer_right, sphere.xz),
                              dot(cell.outer_bottom, sphere.yz), dot(cell.outer_top, sphere.yz));
    return -sphere.z < 1.05 * sphere.w && min(min(sides.x, sides.y), min(sides.z, sides.w)) < -sphere.w;
#else
    return false;
#endif
}

// Distances from the side planes: left, right, bottom, top; positive inside.
vec4 side_distances(CellBounds cell, vec3 point)
{
    precise vec4 sides = vec4(dot(cell.left, point.xz), dot(cell.right, point.xz), dot(cell.bottom, point.yz), dot(cell.top, point.yz));
    return sides;
}

bool within_planes(CellBounds cell, vec4 sphere)
{
    vec4 sides = side_distances(cell, sphere.xyz);
    precise vec2 ends = vec2(cell.z_near - sphere.z, sphere.z - cell.z_far);
    return min(min(min(sides.x, sides.y), min(sides.z, sides.w)), min(ends.x, ends.y)) >= -sphere.w;
}

// False only where within_planes is false for every cell of the range that `range` bounds. Of two planes through the apex
// the outer one is not always nearer to what lies behind both, but it is to a centre in front of the apex by the radius.
bool may_be_within_planes(CellBounds range, vec4 sphere)
{
    float radius = sphere.w + RANGE_ROUNDING * (abs(sphere.x) + abs(sphere.y) + abs(sphere.z) + sphere.w);
    vec4 sides = side_distances(range, sphere.xyz);
    vec2 ends = vec2(range.z_near - sphere.z, sphere.z - range.z_far);
    float across = -sphere.z < 1.05 * radius ? 0.0 : min(min(sides.x, sides.y), min(sides.z, sides.w));
    return min(across, min(ends.x, ends.y)) >= -radius;
}

// As within_planes, for some point of a box around the centre.
bool within_planes_grown(CellBounds cell, vec4 sphere, vec3 half_extent)
{
    vec4 sides = side_distances(cell, sphere.xyz);
    sides += vec4(dot(abs(cell.left), half_extent.xz), dot(abs(cell.right), half_extent.xz),
                  dot(abs(cell.bottom), half_extent.yz), dot(abs(cell.top), half_extent.yz));
    vec2 ends = vec2(cell.z_near - sphere.z, sphere.z - cell.z_far) + half_extent.z;
    return min(min(min(sides.x, sides.y), min(sides.z, sides.w)), min(ends.x, ends.y)) >= -sphere.w;
}

#if TEST_MM
// Whether the cell meets the rectangle in which a sphere is seen, between its depths. What is no number, of a light beyond all that
// single precision holds, meets.
bool meets_seen(CellBounds cell, vec4 sphere, vec4 rectangle)
{
    precise vec2 ends = vec2(cell.z_near - sphere.z, sphere.z - cell.z_far);
    bvec2 below = lessThan(rectangle.zw, cell.low), above = greaterThan(rectangle.xy, cell.high);
    return !(below.x || below.y || above.x || above.y || min(ends.x, ends.y) < -sphere.w);
}
#endif

#if TEST_SAT_P || TEST_SAT_E
// Rounding of a projection, in parts of the farthest corner's distance.
const float PROJECTION_ROUNDING = 4e-7;

// What rounding may take off the projections of the cell's corners, metres.
float projection_slack(CellBounds cell)
{
    vec2 widest = max(abs(cell.low), abs(cell.high));
    return -cell.z_far * (1.0 + widest.x + widest.y) * PROJECTION_ROUNDING;
}
#endif

#if TEST_SAT_P
// SAT-P beyond half spaces: the sphere lies past the corner that is farthest from a side plane. The near and the far
// plane are each other's farthest.
bool normals_separate(CellBounds cell, vec4 sphere)
{
    precise vec2 across = -cell.z_far * (cell.high - cell.low);
    // A normal's first component is the cosine that turns a width into a distance.
    precise vec4 farthest = vec4(across.x * cell.left.x, -across.x * cell.right.x, across.y * cell.bottom.x, -across.y * cell.top.x);
    precise vec4 beyond = side_distances(cell, sphere.xyz) - farthest;
    return max(max(beyond.x, beyond.y), max(beyond.z, beyond.w)) > sphere.w + projection_slack(cell);
}
#endif

#if TEST_SAT_E
// Lowest and highest projection, to `axis`, of the corners whose tangents are low or high.
vec2 projected_corners(CellBounds cell, vec3 axis)
{
    precise vec2 first = axis.xy * cell.low;
    precise vec2 second = axis.xy * cell.high;
    precise vec2 lows = min(first, second);
    precise vec2 highs = max(first, second);
    // At depth 1; corners scale with their depth.
    precise vec2 unit = vec2(lows.x + lows.y, highs.x + highs.y) - axis.z;
    precise vec2 near = -cell.z_near * unit;
    precise vec2 far = -cell.z_far * unit;
    return vec2(min(near.x, far.x), max(near.y, far.y));
}

bool edge_separates(CellBounds cell, vec4 sphere, vec3 edge)
{
    precise vec2 corners = projected_corners(cell, edge);
    precise float centre = dot(edge, sphere.xyz);
    precise vec2 beyond = vec2(corners.x - centre, centre - corners.y);
    precise float reach = (sphere.w + projection_slack(cell)) * sqrt(dot(edge, edge));
    return max(beyond.x, beyond.y) > reach;
}

// SAT-E: the edges along x and y, and the four that meet in the apex.
bool edges_separate(CellBounds cell, vec4 sphere)
{
    return edge_separates(cell, sphere, vec3(1.0, 0.0, 0.0)) || edge_separates(cell, sphere, vec3(0.0, 1.0, 0.0)) ||
           edge_separates(cell, sphere, vec3(cell.low.x, cell.low.y, -1.0)) ||
           edge_separates(cell, sphere, vec3(cell.high.x, cell.low.y, -1.0)) ||
           edge_separates(cell, sphere, vec3(cell.low.x, cell.high.y, -1.0)) ||
           edge_separates(cell, sphere, vec3(cell.high.x, cell.high.y, -1.0));
}
#endif

#if TEST_NEAREST
// Three steps were the most among random cells and spheres of all shapes. A pair that is still open after so many
// touches, within rounding, and is taken.
const uint MOST_STEPS = 8u;
// Rounding of squared distances, in parts of them.
const float SQUARE_ROUNDING = 1e-6;

// Whether the nearest point lies in the sphere. A slice of the cell at some depth is a rectangle, whose nearest point is
// the centre clamped, so what is left is to find the depth: the squared distance is convex in it and made of parabolas,
// and Newton's method jumps from the bottom of one to the next. As its curvature is nowhere below that of depth alone,
// half the slope, squared, bounds how much lower the least can be: most pairs are decided at the first depth.
bool nearest_point_within(CellBounds cell, vec4 sphere)
{
    precise float square_radius = sphere.w * sphere.w * (1.0 + SQUARE_ROUNDING);
    precise float depth = clamp(-sphere.z, -cell.z_near, -cell.z_far);
    for (uint steps = 0u; steps < MOST_STEPS; ++steps) {
        precise vec2 below = max(cell.low * depth - sphere.xy, 0.0);
        precise vec2 above = max(sphere.xy - cell.high * depth, 0.0);
        precise float along = depth + sphere.z;
        precise float square = dot(below, below) + dot(above, above) + along * along;
        if (square <= square_radius)
            return true;
        precise float half_slope = along + dot(cell.low, below) - dot(cell.high, above);
        bool at_end = half_slope >= 0.0 ? depth <= -cell.z_near : depth >= -cell.z_far;
        precise float least = square * (1.0 - SQUARE_ROUNDING) - half_slope * half_slope;
        if (at_end || least > square_radius)
            return false;
        vec2 steep = mix(mix(vec2(0.0), cell.high, greaterThan(above, vec2(0.0))), cell.low, greaterThan(below, vec2(0.0)));
        precise float next = depth - half_slope / (1.0 + dot(steep, steep));
        depth = clamp(next, -cell.z_near, -cell.z_far);
    }
    return true;
}
#endif

#if TEST_SAT_N || TEST_SAT_V
// One of the two rectangles of equal z that hold the vertices, relative to a centre.
struct CellEnd {
    vec2 low, high;
    float z;
};

CellEnd cell_end(CellBounds cell, vec3 centre, bool far)
{
    precise float z = far ? cell.z_far : cell.z_near;
    precise CellEnd end = CellEnd(-z * cell.low - centre.xy, -z * cell.high - centre.xy, z - centre.z);
    return end;
}
#endif
