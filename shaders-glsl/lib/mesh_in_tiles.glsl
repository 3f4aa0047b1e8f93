// The mesh around one light, which a workgroup asks tile by tile (Örtegren and Persson section 4.3), without rasterisation.
//
//   light's frame, template ─load_mesh─> vertices in view space ─┬─> eye inside? ─────────────────────> range_in_tile
//                                                                ├─> tiles in which the mesh is seen ─┘
//                                                                └─> depths in the tile ──────────────┘
//
// MESH says of which lights: points (MESH_SPHERE) or spots. Their template is MESH_VERTICES of `mesh_vertices` from FIRST_VERTEX on, and
// MESH_TRIANGLES of `mesh_triangles` from FIRST_TRIANGLE on (three 10-bit numbers a word).
#pragma once

#include "lib/light_mesh.glsl"
#include "lib/shell.glsl"

shared vec3 vertices[MESH_VERTICES];
shared uint eye_outside;

Triangle read_triangle(uint triangle)
{
    uint word = mesh_triangles[FIRST_TRIANGLE + triangle];
    Triangle read;
    for (uint corner = 0u; corner < 3u; ++corner)
        read.corners[corner] = vertices[word >> 10u * corner & 0x3FFu];
    return read;
}

// Takes the mesh of a light to view space; false, and nothing is taken, where the light is of another kind. All threads of a workgroup come
// with the same light.
bool load_mesh(uint light)
{
    uint thread = gl_LocalInvocationIndex;
    MeshFrame frame = light_frames[light];
    if (is_spot(frame) != (MESH == MESH_SPOT))
        return false;
    for (uint vertex = thread; vertex < MESH_VERTICES; vertex += ASSIGN_WORKGROUP)
        vertices[vertex] = placed_vertex(frame, mesh_vertices[FIRST_VERTEX + vertex]);
    if (thread == 0u)
        eye_outside = 0u;
    barrier();
    for (uint triangle = thread; triangle < MESH_TRIANGLES; triangle += ASSIGN_WORKGROUP)
        if (!eye_is_behind(read_triangle(triangle)))
            atomicOr(eye_outside, 1u);
    barrier();
    return true;
}

// The first tile and the one behind the last, along x and y, in which the mesh may be seen: all of them where it reaches beside the eye.
// Tiles that are left out are farther from it than what rounding may take.
struct TileRange {
    uvec2 first, end;
};

TileRange tiles_of_mesh()
{
    vec2 low = vec2(3e38), high = vec2(-3e38);
    bool is_before = true;
    for (uint vertex = 0u; vertex < MESH_VERTICES; ++vertex) {
        vec3 place = vertices[vertex];
        is_before = is_before && place.z < 0.0;
        vec2 tangents = place.xy / -place.z;
        vec2 slack = vec2(8.0 * SHELL_ROUNDING * (1.0 + abs(tangents.x) + abs(tangents.y)));
        low = min(low, tangents - slack);
        high = max(high, tangents + slack);
    }
    const float TILE_ROUNDING = 1e-2;
    vec2 most = vec2(grid.dimensions.xy);
    vec2 first = clamp(floor((low - grid.origin.xy) / grid.cell.xy - TILE_ROUNDING), vec2(0.0), most);
    vec2 end = clamp(ceil((high - grid.origin.xy) / grid.cell.xy + TILE_ROUNDING), vec2(0.0), most);
    return is_before ? TileRange(uvec2(first), uvec2(end)) : TileRange(uvec2(0u), grid.dimensions.xy);
}

// Whether all of the mesh lies beyond one side of a tile, by more than what rounding may have taken from any of its triangles.
bool misses_tile(Tile tile, uint count)
{
    vec4 nearest = vec4(-3e38);
    float size = 0.0;
    for (uint vertex = 0u; vertex < count; ++vertex) {
        nearest = max(nearest, tile_distances(vertices[vertex], tile));
        size = max(size, size_in_tile(vertices[vertex], tile));
    }
    precise float slack = SHELL_ROUNDING * size;
    return min(min(nearest.x, nearest.y), min(nearest.z, nearest.w)) < -slack;
}

// The slices of a tile in which the mesh lies.
uint range_in_tile(uvec2 at)
{
    Tile sides = tile_at(at);
    uint triangles = misses_tile(sides, MESH_VERTICES) ? 0u : MESH_TRIANGLES;
    uint range = eye_outside == 0u ? RANGE_FROM_THE_EYE : EMPTY_RANGE;
    for (uint triangle = 0u; triangle < triangles; ++triangle) {
        vec2 depths = depths_in_tile(read_triangle(triangle), sides);
        if (depths.x <= depths.y)
            range = joined_ranges(range, range_of(depths));
    }
    return range;
}
