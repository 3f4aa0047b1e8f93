// Triangles of the meshes around lights, an instance a light, over a screen with a pixel a tile (Örtegren and Persson section 4.3).
//
// HARDWARE 1: the triangles themselves, which the device rasterises conservatively. Depth is half of w, so that neither near nor far
//             plane cuts them.
// HARDWARE 0: two triangles over the tiles in which a triangle may be seen, whose pixels then ask; all tiles where it reaches beside the
//             eye.
// lib/mesh_of_light.glsl says of which lights.
#version 460
#include "lib/mesh_of_light.glsl"
#include "lib/seen_tiles.glsl"

layout(location = 0) flat out uint out_light;
layout(location = 1) flat out vec3 out_corners[3];

// Beside the screen.
const vec4 NOWHERE = vec4(2.0, 2.0, 0.0, 1.0);

#if HARDWARE

const uint VERTICES = 3u;

vec4 place_of_vertex(Triangle triangle, uint corner)
{
    vec3 point = triangle.corners[corner];
    vec2 size = grid.cell.xy * vec2(grid.dimensions.xy);
    return vec4(2.0 * (point.xy + grid.origin.xy * point.z) / size + point.z, -0.5 * point.z, -point.z);
}

#else

const uint VERTICES = 6u;

// The place on the screen of corners of tiles, counted from 0.
vec4 place_of_tile(vec2 corner)
{
    return vec4(2.0 * corner / vec2(grid.dimensions.xy) - 1.0, 0.0, 1.0);
}

vec4 place_of_vertex(Triangle triangle, uint corner)
{
    TileRange tiles = joined_tiles(tiles_of(triangle.corners[0]), joined_tiles(tiles_of(triangle.corners[1]), tiles_of(triangle.corners[2])));
    // Corners 0 1 2 and 2 1 3 of the rectangle.
    uint at = corner < 3u ? corner : corner == 3u ? 2u : corner == 4u ? 1u : 3u;
    return place_of_tile(vec2((at & 1u) == 0u ? tiles.first.x : tiles.end.x, (at & 2u) == 0u ? tiles.first.y : tiles.end.y));
}

#endif

void main()
{
    uint light = gl_InstanceIndex, vertex = gl_VertexIndex;
    MeshFrame frame = light_frames[light];
    uint word = mesh_triangles[FIRST_TRIANGLE + vertex / VERTICES];
    Triangle triangle;
    for (uint corner = 0u; corner < 3u; ++corner)
        triangle.corners[corner] = placed_vertex(frame, mesh_vertices[FIRST_VERTEX + (word >> 10u * corner & 0x3FFu)]);
    out_light = light;
    out_corners = triangle.corners;
    gl_Position = has_mesh(frame) ? place_of_vertex(triangle, vertex % VERTICES) : NOWHERE;
}
