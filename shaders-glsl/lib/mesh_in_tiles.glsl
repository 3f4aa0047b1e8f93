// The mesh around one light, which a workgroup asks tile by tile (Örtegren and Persson section 4.3), without rasterisation.
//
//   light's frame, template ─load_mesh─> vertices in view space ─┬─> eye inside? ─────────────────────> range_in_tile
//                                                                ├─> tiles in which the mesh is seen ─┘
//                                                                └─> depths in the tile ──────────────┘
//
// lib/mesh_of_light.glsl says which lights have it. Their template is MESH_VERTICES of `mesh_vertices` from FIRST_VERTEX on, and
// MESH_TRIANGLES of `mesh_triangles` from FIRST_TRIANGLE on (three 10-bit numbers a word).
#pragma once

#include "lib/mesh_of_light.glsl"
#include "lib/seen_tiles.glsl"
#extension GL_EXT_control_flow_attributes : require

// Vertices and triangles of one turn, meshes have a multiple of the latter: many of fine meshes, as lavapipe ends a shader's loops after 65 535
// turns of all of them, and a thread has one tile after the other.
#if MESH_VERTICES > 42
const uint VERTICES_AT_ONCE = 16u, TRIANGLES_AT_ONCE = 8u;
#else
const uint VERTICES_AT_ONCE = 1u, TRIANGLES_AT_ONCE = 1u;
#endif

shared vec3 vertices[MESH_VERTICES];
shared uint eye_outside, before_eye;
shared uint tiles_first[2], tiles_end[2];

Triangle read_triangle(uint triangle)
{
    uint word = mesh_triangles[FIRST_TRIANGLE + triangle];
    Triangle read;
    for (uint corner = 0u; corner < 3u; ++corner)
        read.corners[corner] = vertices[word >> 10u * corner & 0x3FFu];
    return read;
}

// Takes the mesh of a light to view space; false, and nothing is taken, where the light has another mesh. All threads of a workgroup come
// with the same light.
bool load_mesh(uint light)
{
    uint thread = gl_LocalInvocationIndex;
    MeshFrame frame = light_frames[light];
    if (!has_mesh(frame))
        return false;
    if (thread == 0u) {
        eye_outside = 0u;
        before_eye = 0u;
        tiles_first = uint[](grid.dimensions.x, grid.dimensions.y);
        tiles_end = uint[](0u, 0u);
    }
    barrier();
    for (uint vertex = thread; vertex < MESH_VERTICES; vertex += ASSIGN_WORKGROUP) {
        vertices[vertex] = placed_vertex(frame, mesh_vertices[FIRST_VERTEX + vertex]);
        TileRange seen = tiles_of(vertices[vertex]);
        for (uint axis = 0u; axis < 2u; ++axis) {
            atomicMin(tiles_first[axis], seen.first[axis]);
            atomicMax(tiles_end[axis], seen.end[axis]);
        }
    }
    barrier();
    for (uint index = thread; index < MESH_TRIANGLES; index += ASSIGN_WORKGROUP) {
        Triangle triangle = read_triangle(index);
        if (!eye_is_behind(triangle))
            atomicOr(eye_outside, 1u);
        if (!is_behind_eye(triangle))
            atomicOr(before_eye, 1u);
    }
    barrier();
    return true;
}

TileRange tiles_of_mesh()
{
    if (before_eye == 0u)
        return TileRange(uvec2(0u), uvec2(0u));
    return TileRange(uvec2(tiles_first[0], tiles_first[1]), uvec2(tiles_end[0], tiles_end[1]));
}

// What is known of the slices of every tile before any triangle is asked.
uint start_of_shell()
{
    return eye_outside == 0u ? RANGE_FROM_THE_EYE : EMPTY_RANGE;
}

// Whether all of the mesh lies beyond one side of a tile, by more than what rounding may have taken from any of its triangles.
bool misses_tile(Tile tile, uint count)
{
    vec4 nearest = vec4(-3e38);
    float size = 0.0;
    for (uint first = 0u; first < count; first += VERTICES_AT_ONCE)
        [[unroll]] for (uint i = 0u; i < VERTICES_AT_ONCE; ++i) {
            // The last vertex may come again, which changes nothing.
            vec3 vertex = vertices[min(first + i, count - 1u)];
            nearest = max(nearest, tile_distances(vertex, tile));
            size = max(size, size_in_tile(vertex, tile));
        }
    precise float slack = SHELL_ROUNDING * size;
    return min(min(nearest.x, nearest.y), min(nearest.z, nearest.w)) < -slack;
}

// The slices of a tile in which the mesh lies.
uint range_in_tile(uvec2 at)
{
    Tile sides = tile_at(at);
    uint triangles = misses_tile(sides, MESH_VERTICES) ? 0u : MESH_TRIANGLES;
    uint range = start_of_shell();
    for (uint first = 0u; first < triangles; first += TRIANGLES_AT_ONCE)
        [[unroll]] for (uint i = 0u; i < TRIANGLES_AT_ONCE; ++i) {
            vec2 depths = depths_in_tile(read_triangle(first + i), sides);
            if (depths.x <= depths.y)
                range = joined_ranges(range, range_of(depths));
        }
    return range;
}
