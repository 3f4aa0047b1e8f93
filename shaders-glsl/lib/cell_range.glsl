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
    float depth = -sphere.z;
    vec2 ends = vec2(depth - sphere.w, depth + sphere.w) / grid.origin.z;
    vec2 slices = vec2(clamped_slice_coordinate(ends.x), clamped_slice_coordinate(ends.y));
    ivec2 x = cells_across(sphere.x, depth, sphere.w, 0u);
    ivec2 y = cells_across(sphere.y, depth, sphere.w, 1u);
    ivec2 z = cells_between(slices.x, slices.y, 1e-4 * grid.scale.z, grid.dimensions.z);
    return CellRange(ivec3(x.x, y.x, z.x), ivec3(x.y, y.y, z.y));
}

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
