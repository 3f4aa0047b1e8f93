// The mesh around one light, which a workgroup asks tile by tile (Örtegren and Persson section 4.3), without rasterisation.
//
//   light's frame, template ─load_mesh─> vertices in view space ─> triangles ─┬─> eye inside? ──────────────────> range_in_tile
//                                                                            ├─> tiles in which each is seen ──┤
//                                                                            └─> depths in the tile ───────────┘
//
// lib/mesh_of_light.glsl says which lights have it. Their template is MESH_VERTICES of `mesh_vertices` from FIRST_VERTEX on, and
// MESH_TRIANGLES of `mesh_triangles` from FIRST_TRIANGLE on (three 10-bit numbers a word).
#pragma once

#include "lib/mesh_of_light.glsl"
#include "lib/seen_tiles.glsl"
#extension GL_EXT_control_flow_attributes : require

// Triangles whose tiles are asked before any of their depths, a bit each: fewer of coarse meshes, of which more would stay empty.
const uint TRIANGLES_AT_ONCE = MESH_TRIANGLES < 100u ? 16u : 32u;
const uint PADDED_TRIANGLES = (MESH_TRIANGLES + TRIANGLES_AT_ONCE - 1u) / TRIANGLES_AT_ONCE * TRIANGLES_AT_ONCE;

shared vec3 vertices[MESH_VERTICES];
// The tiles in which each triangle is seen, of 16 bits a coordinate; none behind the last triangle.
shared uvec2 triangle_tiles[PADDED_TRIANGLES];
shared uint eye_outside;
shared uint tiles_first[2], tiles_end[2];

Triangle read_triangle(uint triangle)
{
    uint word = mesh_triangles[FIRST_TRIANGLE + triangle];
    Triangle read;
    for (uint corner = 0u; corner < 3u; ++corner)
        read.corners[corner] = vertices[word >> 10u * corner & 0x3FFu];
    return read;
}

// The tiles in which a triangle is seen, among them those of the mesh.
TileRange load_triangle(uint index)
{
    Triangle triangle = read_triangle(index);
    if (!eye_is_behind(triangle))
        atomicOr(eye_outside, 1u);
    TileRange seen = tiles_of_triangle(triangle);
    for (uint axis = 0u; axis < 2u; ++axis) {
        atomicMin(tiles_first[axis], seen.first[axis]);
        atomicMax(tiles_end[axis], seen.end[axis]);
    }
    return seen;
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
        tiles_first = uint[](grid.dimensions.x, grid.dimensions.y);
        tiles_end = uint[](0u, 0u);
    }
    for (uint vertex = thread; vertex < MESH_VERTICES; vertex += ASSIGN_WORKGROUP)
        vertices[vertex] = placed_vertex(frame, mesh_vertices[FIRST_VERTEX + vertex]);
    barrier();
    for (uint index = thread; index < PADDED_TRIANGLES; index += ASSIGN_WORKGROUP) {
        TileRange seen = NO_TILES;
        if (index < MESH_TRIANGLES)
            seen = load_triangle(index);
        triangle_tiles[index] = seen.first | seen.end << 16;
    }
    barrier();
    return true;
}

// The tiles in which the mesh is seen; none where the last is not behind the first.
TileRange tiles_of_mesh()
{
    uvec2 first = uvec2(tiles_first[0], tiles_first[1]);
    return TileRange(first, max(first, uvec2(tiles_end[0], tiles_end[1])));
}

// What is known of the slices of every tile before any triangle is asked.
uint start_of_shell()
{
    return eye_outside == 0u ? RANGE_FROM_THE_EYE : EMPTY_RANGE;
}

// Which of some triangles are seen in a tile, a bit each.
uint seen_triangles(uint first, uvec2 at)
{
    uint seen = 0u;
    [[unroll]] for (uint i = 0u; i < TRIANGLES_AT_ONCE; ++i) {
        uvec2 tiles = triangle_tiles[first + i];
        bool is_seen = all(greaterThanEqual(at, tiles & 0xFFFFu)) && all(lessThan(at, tiles >> 16));
        seen |= (is_seen ? 1u : 0u) << i;
    }
    return seen;
}

// The slices of a tile in which the mesh lies.
uint range_in_tile(uvec2 at)
{
    Tile sides = tile_at(at);
    uint range = start_of_shell();
    for (uint first = 0u; first < MESH_TRIANGLES; first += TRIANGLES_AT_ONCE)
        for (uint seen = seen_triangles(first, at); seen != 0u; seen &= seen - 1u) {
            vec2 depths = depths_in_tile(read_triangle(first + findLSB(seen)), sides);
            if (depths.x <= depths.y)
                range = joined_ranges(range, range_of(depths));
        }
    return range;
}
