// The slices in which each light's mesh lies, tile by tile (Örtegren and Persson section 4.3), without rasterisation: a workgroup takes a
// light (x) and a part of its tiles (y), and each of its threads one tile after the other, with the triangles of the mesh that may be seen there.
#version 460
#include "lib/mesh_in_tiles.glsl"
#include "lib/tile_part.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint light = gl_WorkGroupID.x;
    if (!load_mesh(light))
        return;
    uint tiles = grid.dimensions.x * grid.dimensions.y;
    TileRange seen = tiles_of_mesh();
    for (uint tile = first_tile(); tile < end_of_tiles(tiles); tile += ASSIGN_WORKGROUP) {
        uvec2 at = uvec2(tile % grid.dimensions.x, tile / grid.dimensions.x);
        if (any(lessThan(at, seen.first)) || any(greaterThanEqual(at, seen.end)))
            shell_ranges[light * tiles + tile] = EMPTY_RANGE;
    }
    uvec2 size = seen.end - seen.first;
    for (uint place = first_tile(); place < end_of_tiles(size.x * size.y); place += ASSIGN_WORKGROUP) {
        uvec2 at = seen.first + uvec2(place % size.x, place / size.x);
        shell_ranges[light * tiles + at.y * grid.dimensions.x + at.x] = range_in_tile(at);
    }
}
