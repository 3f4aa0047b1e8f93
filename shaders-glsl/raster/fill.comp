// Fill (Örtegren and Persson section 4.4): a light to the clusters of a tile between the slices of its shell; a workgroup takes a light (x) and
// a part of the tiles (y). MESH says of which lights: points (MESH_SPHERE) or spots.
// WRITE_LISTS 0 counts, or links where lists are so (stages fill_points, fill_spots), 1 writes (stage write_lists) where light bits did
// not fit.
#version 460
#include "lib/counters.glsl"
#include "lib/fill.glsl"
#include "lib/light_mesh.glsl"
#include "lib/tile_part.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint light = gl_WorkGroupID.x, tiles = grid.dimensions.x * grid.dimensions.y;
    if (light >= state.candidates || is_spot(light_frames[light]) != (MESH == MESH_SPOT))
        return;
    for (uint tile = first_tile(); tile < end_of_tiles(tiles); tile += ASSIGN_WORKGROUP) {
#if !WRITE_LISTS
        count(COUNTER_INTERSECTION_TESTS, 1u);
#endif
        fill_range(tile, shell_ranges[light * tiles + tile], light);
    }
}
