// Triangles of the meshes around lights, an instance a light, over a screen with a pixel a tile (Örtegren and Persson section 4.3).
//
// HARDWARE 1: the triangles themselves, which the device rasterises conservatively. Depth is half of w, so that neither near nor far
//             plane cuts them.
// HARDWARE 0: triangles that are grown until they have the centre of each tile that they touch; where they cannot be, as they are seen
//             from the side or reach beside the eye, triangles around all tiles in which they may be seen. Pixels then ask.
// LAYERS 1:   each light into a layer of its own, counted from the first light of the batch, which is pushed.
// lib/mesh_of_light.glsl says of which lights.
#version 460
#if LAYERS
#extension GL_ARB_shader_viewport_layer_array : require
#endif
#include "lib/mesh_of_light.glsl"
#include "lib/seen_tiles.glsl"

layout(location = 0) flat out uint out_light;
layout(location = 1) flat out vec3 out_corners[3];

// Beside the screen.
const vec4 NOWHERE = vec4(2.0, 2.0, 0.0, 1.0);

#if HARDWARE

vec4 place_of_vertex(Triangle triangle, uint corner)
{
    vec3 point = triangle.corners[corner];
    vec2 size = grid.cell.xy * vec2(grid.dimensions.xy);
    return vec4(2.0 * (point.xy + grid.origin.xy * point.z) / size + point.z, -0.5 * point.z, -point.z);
}

#else

// How far edges are moved out, tiles: half a tile, and more than what rounding of coordinates, the rasteriser's too, takes.
const float GROWTH = 0.5 + 1.0 / 16.0;
// Farther from the screen than so many tiles, or with a smaller sine between edges, a triangle is not grown, for its corners would be
// too inaccurate.
const float MOST_TILES = 4096.0, LEAST_SINE = 0.0625;

// The place on the screen of a point that is counted in tiles from 0.
vec4 place_in_tiles(vec2 point)
{
    return vec4(2.0 * point / vec2(grid.dimensions.xy) - 1.0, 0.0, 1.0);
}

// A corner of a triangle around all pixels that a rectangle of tiles has.
vec2 around(TileRange tiles, uint corner)
{
    vec2 size = vec2(tiles.end - tiles.first);
    return vec2(tiles.first) + (corner == 1u ? vec2(2.0 * size.x, 0.0) : corner == 2u ? vec2(0.0, 2.0 * size.y) : vec2(0.0));
}

float cross_product(vec2 a, vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

// How far out an edge is moved along its normal, of any length, so that the centres of all pixels that it touches lie within.
float growth_along(vec2 normal)
{
    return GROWTH * (abs(normal.x) + abs(normal.y));
}

// Whether corners can be moved along with their edges.
bool can_grow(vec2 corners[3])
{
    vec2 edges[3] = vec2[](corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]);
    for (uint corner = 0u; corner < 3u; ++corner) {
        vec2 before = edges[(corner + 2u) % 3u], behind = edges[corner];
        bool is_near = max(abs(corners[corner].x), abs(corners[corner].y)) < MOST_TILES;
        if (!is_near || !(abs(cross_product(before, behind)) > LEAST_SINE * length(before) * length(behind)))
            return false;
    }
    return true;
}

// Where the edges before and behind a corner meet once they are moved out (Hasselgren, Akenine-Moller and Ohlsson, GPU Gems 2, chapter 42).
vec2 grown(vec2 corners[3], uint corner)
{
    vec2 at = corners[corner];
    vec2 before = at - corners[(corner + 2u) % 3u], behind = corners[(corner + 1u) % 3u] - at;
    float turn = sign(cross_product(before, behind));
    vec2 normals[2] = vec2[](turn * vec2(before.y, -before.x), turn * vec2(behind.y, -behind.x));
    vec2 moved = vec2(growth_along(normals[0]), growth_along(normals[1]));
    return at + vec2(moved.x * normals[1].y - moved.y * normals[0].y, moved.y * normals[0].x - moved.x * normals[1].x) /
                    cross_product(normals[0], normals[1]);
}

vec4 place_of_vertex(Triangle triangle, uint corner)
{
    bool is_ahead = true;
    vec2 corners[3];
    for (uint i = 0u; i < 3u; ++i) {
        vec3 point = triangle.corners[i];
        is_ahead = is_ahead && point.z < -1e-3;
        corners[i] = (point.xy / -point.z - grid.origin.xy) / grid.cell.xy;
    }
    if (is_ahead && can_grow(corners))
        return place_in_tiles(grown(corners, corner));
    return place_in_tiles(around(tiles_of_triangle(triangle), corner));
}

#endif

void main()
{
    uint light = gl_InstanceIndex, vertex = gl_VertexIndex;
    MeshFrame frame = light_frames[light];
    uint word = mesh_triangles[FIRST_TRIANGLE + vertex / 3u];
    Triangle triangle;
    for (uint corner = 0u; corner < 3u; ++corner)
        triangle.corners[corner] = placed_vertex(frame, mesh_vertices[FIRST_VERTEX + (word >> 10u * corner & 0x3FFu)]);
    out_light = light;
    out_corners = triangle.corners;
#if LAYERS
    gl_Layer = int(light - push.step);
#endif
    gl_Position = has_mesh(frame) && !is_unseen(triangle) ? place_of_vertex(triangle, vertex % 3u) : NOWHERE;
}
