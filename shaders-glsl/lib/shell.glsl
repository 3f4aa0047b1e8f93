// What of a triangle of a light's mesh lies in a tile: step for step as cpu/shell.rs, which tells why, so that both get the same bits.
#pragma once

#include "lib/cluster_space.glsl"
#include "lib/slice_range.glsl"

// What rounding may cost of a sum or a product, in parts of the coordinates that are in it.
const float SHELL_ROUNDING = 1e-6;

// Tangents of the sides of a tile.
struct Tile {
    vec2 low, high;
};

struct Triangle {
    vec3 corners[3];
};

// (least, greatest) of no depths.
const vec2 NO_DEPTHS = vec2(3e38, -3e38);

float size_of(vec3 vector)
{
    precise float size = abs(vector.x) + abs(vector.y) + abs(vector.z);
    return size;
}

// As written out, so that it turns its sign, and nothing else, where the two change places.
vec3 cross_product(vec3 a, vec3 b)
{
    precise vec3 product = vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
    return product;
}

// Whether the eye lies on the inner side of a triangle, or as near to its plane as rounding may have it. It is in a mesh where it
// is behind all of its triangles.
bool eye_is_behind(Triangle triangle)
{
    vec3 a = triangle.corners[0];
    precise vec3 ab = triangle.corners[1] - a;
    precise vec3 ac = triangle.corners[2] - a;
    precise float slack = SHELL_ROUNDING * size_of(ab) * size_of(ac) * size_of(a);
    vec3 normal = cross_product(ab, ac);
    precise float outside = normal.x * a.x + normal.y * a.y + normal.z * a.z;
    return outside >= -slack;
}

// Distances from the sides of a tile, inwards: left, right, bottom, top; each in parts of the length of its normal.
vec4 tile_distances(vec3 point, Tile tile)
{
    float depth = -point.z;
    precise vec4 distances = vec4(point.x - tile.low.x * depth, tile.high.x * depth - point.x,
                                  point.y - tile.low.y * depth, tile.high.y * depth - point.y);
    return distances;
}

// A size that no term of a point's distances exceeds.
float size_in_tile(vec3 point, Tile tile)
{
    vec2 widest = max(abs(tile.low), abs(tile.high));
    precise float size = size_of(point) * (1.0 + max(widest.x, widest.y));
    return size;
}

float least_of(vec4 numbers)
{
    return min(min(numbers.x, numbers.y), min(numbers.z, numbers.w));
}

vec2 with_depth(vec2 found, float depth)
{
    return vec2(min(found.x, depth), max(found.y, depth));
}

float between(vec2 ends, float along)
{
    precise float at = ends.x + along * (ends.y - ends.x);
    return at;
}

// Takes the depths at which an edge leads through sides of the tile, between the two other sides.
vec2 through_sides(vec4 from, vec4 to, vec2 depths, float slack, vec2 found)
{
    for (uint side = 0u; side < 4u; ++side) {
        if ((from[side] < 0.0) == (to[side] < 0.0))
            continue;
        precise float along = from[side] / (from[side] - to[side]);
        uint other = side < 2u ? 2u : 0u;
        bool is_between = between(vec2(from[other], to[other]), along) >= -slack &&
                          between(vec2(from[other + 1u], to[other + 1u]), along) >= -slack;
        if (is_between)
            found = with_depth(found, between(depths, along));
    }
    return found;
}

// Takes the depths at which the edges of the tile lead through the triangle.
vec2 through_triangle(Triangle triangle, Tile tile, vec2 found)
{
    vec3 a = triangle.corners[0], b = triangle.corners[1], c = triangle.corners[2];
    vec3 normals[3] = vec3[](cross_product(b, c), cross_product(c, a), cross_product(a, b));
    for (uint corner = 0u; corner < 4u; ++corner) {
        float x = (corner & 1u) == 0u ? tile.low.x : tile.high.x;
        float y = (corner & 2u) == 0u ? tile.low.y : tile.high.y;
        precise float of_a = x * normals[0].x + y * normals[0].y - normals[0].z;
        precise float of_b = x * normals[1].x + y * normals[1].y - normals[1].z;
        precise float of_c = x * normals[2].x + y * normals[2].y - normals[2].z;
        bool inside = min(min(of_a, of_b), of_c) >= 0.0 || max(max(of_a, of_b), of_c) <= 0.0;
        precise float sum = of_a + of_b + of_c;
        precise float depth = -(of_a * a.z + of_b * b.z + of_c * c.z) / sum;
        if (inside && sum != 0.0 && depth > 0.0)
            found = with_depth(found, depth);
    }
    return found;
}

// Least and greatest depth of what of a triangle lies in a tile, metres; NO_DEPTHS where nothing does.
vec2 depths_in_tile(Triangle triangle, Tile tile)
{
    vec4 sides[3];
    for (uint corner = 0u; corner < 3u; ++corner)
        sides[corner] = tile_distances(triangle.corners[corner], tile);
    vec3 sizes = vec3(size_in_tile(triangle.corners[0], tile), size_in_tile(triangle.corners[1], tile),
                      size_in_tile(triangle.corners[2], tile));
    precise float slack = SHELL_ROUNDING * max(max(sizes.x, sizes.y), sizes.z);
    vec2 found = NO_DEPTHS;
    vec4 nearest = max(max(sides[0], sides[1]), sides[2]);
    if (least_of(nearest) < -slack)
        return found;
    for (uint corner = 0u; corner < 3u; ++corner) {
        if (least_of(sides[corner]) >= -slack)
            found = with_depth(found, -triangle.corners[corner].z);
    }
    for (uint from = 0u; from < 3u; ++from) {
        uint to = (from + 1u) % 3u;
        vec2 depths = vec2(-triangle.corners[from].z, -triangle.corners[to].z);
        found = through_sides(sides[from], sides[to], depths, slack, found);
    }
    return through_triangle(triangle, tile, found);
}

Tile tile_at(uvec2 at)
{
    precise vec2 low = grid.origin.xy + grid.cell.xy * vec2(at);
    precise vec2 high = grid.origin.xy + grid.cell.xy * vec2(at + 1u);
    return Tile(low, high);
}

uint slice_at(float depth)
{
    return slice_of(depth, clamped_slice_coordinate(depth));
}

// The slices between the least and the greatest depth that a triangle has in a tile.
uint range_of(vec2 depths)
{
    bool begins_before_far = depths.x <= slice_planes[grid.dimensions.z];
    bool ends_in_front = depths.y >= slice_planes[0];
    uint first = begins_before_far ? slice_at(depths.x) : NO_SLICE;
    uint behind = ends_in_front ? grid.dimensions.z - 1u - slice_at(depths.y) : NO_SLICE;
    return first | behind << 16;
}
