// The slices in which each light's mesh lies, tile by tile (Örtegren and Persson section 4.3), without rasterisation: a workgroup takes a
// light (y) and as many tiles as it has threads (x), and each thread all triangles of the mesh with one tile.
#version 460
#include "lib/mesh_in_tiles.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint light = gl_WorkGroupID.y;
    if (!load_mesh(light))
        return;
    uint tile = gl_GlobalInvocationID.x, tiles = grid.dimensions.x * grid.dimensions.y;
    if (tile >= tiles)
        return;
    uvec2 at = uvec2(tile % grid.dimensions.x, tile / grid.dimensions.x);
    TileRange seen = tiles_of_mesh();
    bool is_seen = all(greaterThanEqual(at, seen.first)) && all(lessThan(at, seen.end));
    shell_ranges[light * tiles + tile] = is_seen ? range_in_tile(at) : EMPTY_RANGE;
}
