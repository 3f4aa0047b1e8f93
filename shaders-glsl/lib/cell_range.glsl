// Which cells a light can meet: an index range per axis that holds every cell whose test (lib/intersect.glsl) passes.
//
// The range follows from the planes that the test uses and the bounding sphere, not from the sphere alone: HS also accepts
// spheres that miss the cell, and those are in it too. MARGIN covers rounding. What a test without half spaces accepts
// (TEST_BOUNDED 0) may lie anywhere.
#pragma once

#include "lib/cluster_space.glsl"
#include "lib/light_volume.glsl"

struct CellRange {
    ivec3 low, high; // both in the grid; empty where low > high on some axis
};

bool is_empty(CellRange range)
{
    return any(greaterThan(range.low, range.high));
}

const float MARGIN = 0.02;

// Cells between two continuous coordinates of an axis with `count` cells.
ivec2 cells_between(float low, float high, float error, uint count)
{
    float last = float(count);
    return ivec2(max(int(floor(clamp(low - MARGIN - error, -1.0, last + 1.0))), 0),
                 min(int(floor(clamp(high + MARGIN + error, -1.0, last + 1.0))), int(count) - 1));
}

#if !TEST_BOUNDED

CellRange cells_near(LightVolume volume)
{
    return CellRange(ivec3(0), ivec3(grid.dimensions) - 1);
}

#elif SPACE == SPACE_PERSPECTIVE

// Slices between whose planes some of a sphere may lie.
ivec2 slices_near(vec4 sphere)
{
    float depth = -sphere.z;
    vec2 slices = vec2(clamped_slice_coordinate(depth - sphere.w), clamped_slice_coordinate(depth + sphere.w));
    return cells_between(slices.x, slices.y, 1e-4 * grid.scale.z, grid.dimensions.z);
}

#if BOXED

// Columns (or rows) whose boxes, in some slice between two depths, may reach a sphere `across` the axis. A box begins where the lower
// side of its cell is farthest out, at the nearer or at the farther depth, and ends where the upper side is.
ivec2 boxes_across(float across, float radius, vec2 depths, uint axis)
{
    uint count = grid.dimensions[axis];
    if (depths.x <= 0.0)
        return ivec2(0, int(count) - 1);
    vec2 ends = across + vec2(-radius, radius);
    vec2 tangents = ends / vec2(ends.x < 0.0 ? depths.x : depths.y, ends.y < 0.0 ? depths.y : depths.x);
    vec2 cells = (tangents - grid.origin[axis]) * grid.scale[axis];
    float error = 1e-4 * grid.scale[axis] * (1.0 + max(abs(tangents.x), abs(tangents.y)));
    return cells_between(cells.x, cells.y, error, count);
}

CellRange cells_near(LightVolume volume)
{
    vec4 sphere = bounding_sphere(volume);
    ivec2 z = slices_near(sphere);
    uvec2 planes = min(uvec2(z.x, z.y + 1), grid.dimensions.z);
    vec2 depths = vec2(slice_planes[planes.x], slice_planes[planes.y]);
    ivec2 x = boxes_across(sphere.x, sphere.w, depths, 0u);
    ivec2 y = boxes_across(sphere.y, sphere.w, depths, 1u);
    return CellRange(ivec3(x.x, y.x, z.x), ivec3(x.y, y.y, z.y));
}

#else

// Columns (or rows) whose two side planes, moved out by the radius, hold a centre `across` the axis at `depth`.
// Where the sphere stays in front of the apex by its radius, those are the tangents between its two silhouette lines.
ivec2 cells_across(float across, float depth, float radius, uint axis)
{
    uint count = grid.dimensions[axis];
    if (depth < 1.05 * radius)
        return ivec2(0, int(count) - 1);
    float reach = radius * sqrt(across * across + depth * depth - radius * radius);
    vec2 tangents = (across * depth + vec2(-reach, reach)) / (depth * depth - radius * radius);
    vec2 cells = (tangents - grid.origin[axis]) * grid.scale[axis];
    float error = 1e-4 * grid.scale[axis] * (1.0 + max(abs(tangents.x), abs(tangents.y)));
    return cells_between(cells.x, cells.y, error, count);
}

CellRange cells_near(LightVolume volume)
{
    vec4 sphere = bounding_sphere(volume);
    ivec2 x = cells_across(sphere.x, -sphere.z, sphere.w, 0u);
    ivec2 y = cells_across(sphere.y, -sphere.z, sphere.w, 1u);
    ivec2 z = slices_near(sphere);
    return CellRange(ivec3(x.x, y.x, z.x), ivec3(x.y, y.y, z.y));
}

#endif
#else

CellRange cells_near(LightVolume volume)
{
    vec4 sphere = bounding_sphere(volume);
    vec3 low = (sphere.xyz - sphere.w - grid.origin) * grid.scale;
    vec3 high = (sphere.xyz + sphere.w - grid.origin) * grid.scale;
    vec3 error = 1e-5 * (abs(grid.origin) * grid.scale + vec3(grid.dimensions));
    ivec2 x = cells_between(low.x, high.x, error.x, grid.dimensions.x);
    ivec2 y = cells_between(low.y, high.y, error.y, grid.dimensions.y);
    ivec2 z = cells_between(low.z, high.z, error.z, grid.dimensions.z);
    return CellRange(ivec3(x.x, y.x, z.x), ivec3(x.y, y.y, z.y));
}

#endif
