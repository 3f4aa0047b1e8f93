// The slices in which each light's mesh lies, tile by tile (Örtegren and Persson section 4.3), without rasterisation: a workgroup takes
// a light (y) and as many tiles as it has threads (x), and each thread all triangles of the mesh with one tile.
//
//   light's frame, template ─> vertices in view space ─> eye inside? ─> depths in the tile ─> slices ─> shell_ranges
//
// MESH says of which lights: points (MESH_SPHERE) or spots. Their template is MESH_VERTICES of `mesh_vertices` from FIRST_VERTEX on, and
// MESH_TRIANGLES of `mesh_triangles` from FIRST_TRIANGLE on (three 10-bit numbers a word).
#version 460
#include "lib/light_mesh.glsl"
#include "lib/shell.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

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

void main()
{
    uint light = gl_WorkGroupID.y, thread = gl_LocalInvocationIndex;
    MeshFrame frame = light_frames[light];
    bool is_spot = frame.tip != vec3(0.0);
    if (is_spot != (MESH == MESH_SPOT))
        return;
    for (uint vertex = thread; vertex < MESH_VERTICES; vertex += ASSIGN_WORKGROUP)
        vertices[vertex] = placed_vertex(frame, mesh_vertices[FIRST_VERTEX + vertex]);
    if (thread == 0u)
        eye_outside = 0u;
    barrier();
    uint triangles = MESH_TRIANGLES;
    for (uint triangle = thread; triangle < triangles; triangle += ASSIGN_WORKGROUP)
        if (!eye_is_behind(read_triangle(triangle)))
            atomicOr(eye_outside, 1u);
    barrier();
    uint tile = gl_GlobalInvocationID.x, tiles = grid.dimensions.x * grid.dimensions.y;
    if (tile >= tiles)
        return;
    Tile sides = tile_at(uvec2(tile % grid.dimensions.x, tile / grid.dimensions.x));
    if (misses_tile(sides, MESH_VERTICES))
        triangles = 0u;
    uint range = eye_outside == 0u ? RANGE_FROM_THE_EYE : EMPTY_RANGE;
    for (uint triangle = 0u; triangle < triangles; ++triangle) {
        vec2 depths = depths_in_tile(read_triangle(triangle), sides);
        if (depths.x <= depths.y)
            range = joined_ranges(range, range_of(depths));
    }
    shell_ranges[light * tiles + tile] = range;
}
