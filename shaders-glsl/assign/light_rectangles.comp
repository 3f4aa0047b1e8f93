// The cells in which each light is seen, by its rectangle and its depths (Tegelaers section 5.2): the very ones whose test
// (meets_seen) passes. Each axis is estimated with a cell to spare, and what fails the test at an end is taken off.
#version 460
#include "lib/intersect.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Cells to spare, which rounding of the estimate may cost.
const float SPARE = 1.0;

// The index of an estimate, in a grid with `count` cells along the axis. What is no number becomes some index.
uint index_near(float estimate, uint count)
{
    return uint(clamp(int(clamp(floor(estimate), 0.0, float(count - 1u))), 0, int(count) - 1));
}

// Columns (or rows) between two tangents: the first and the one behind the last.
uvec2 columns_between(float low, float high, uint axis)
{
    uint count = grid.dimensions[axis];
    vec2 estimate = (vec2(low, high) - grid.origin[axis]) * grid.scale[axis];
    uint first = index_near(estimate.x - SPARE, count), end = index_near(estimate.y + SPARE, count) + 1u;
    while (first < end && low > tile_tangents(uvec2(first + 1u))[axis])
        ++first;
    while (first < end && high < tile_tangents(uvec2(end - 1u))[axis])
        --end;
    return uvec2(first, end);
}

// Slices between whose planes some of a sphere may lie.
uvec2 slices_between(vec4 sphere)
{
    uint count = grid.dimensions.z;
    float depth = -sphere.z;
    uint first = index_near(clamped_slice_coordinate(depth - sphere.w) - SPARE, count);
    uint end = index_near(clamped_slice_coordinate(depth + sphere.w) + SPARE, count) + 1u;
    precise float beyond = sphere.z - slice_depth(first + 1u);
    while (first < end && beyond < -sphere.w) {
        ++first;
        beyond = sphere.z - slice_depth(first + 1u);
    }
    precise float before = slice_depth(end - 1u) - sphere.z;
    while (first < end && before < -sphere.w) {
        --end;
        before = slice_depth(max(end, 1u) - 1u) - sphere.z;
    }
    return uvec2(first, end);
}

void main()
{
    uint light = gl_GlobalInvocationID.x;
    if (light >= grid.light_count)
        return;
    vec4 sphere = bounding_sphere(volume_of_light(light));
    vec4 rectangle = seen_rectangle(sphere);
    uvec2 x = columns_between(rectangle.x, rectangle.z, 0u);
    uvec2 y = columns_between(rectangle.y, rectangle.w, 1u);
    uvec2 z = slices_between(sphere);
    bool seen = x.x < x.y && y.x < y.y && z.x < z.y;
    light_rectangles[light].first = seen ? uvec3(x.x, y.x, z.x) : uvec3(1u);
    light_rectangles[light].last = seen ? uvec3(x.y, y.y, z.y) - 1u : uvec3(0u);
}
