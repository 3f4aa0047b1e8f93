// Lists by meshes without shells: a workgroup takes a light (x), and its threads a part (y) of the tiles in which the light's mesh is seen; the light goes
// to the clusters of each between the slices of the mesh at once. (Bevy does so, with the boxes around lights.)
// WRITE_LISTS 0 counts (stages count_points, count_spots), 1 writes (stage write_lists) where light bits did not fit.
#version 460
#include "lib/counters.glsl"
#include "lib/fill.glsl"
#include "lib/mesh_in_tiles.glsl"
#include "lib/tile_part.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint light = gl_WorkGroupID.x;
    if (light >= state.candidates || !load_mesh(light))
        return;
    TileRange seen = tiles_of_mesh();
    uvec2 size = seen.end - seen.first;
    for (uint place = first_tile(); place < end_of_tiles(size.x * size.y); place += ASSIGN_WORKGROUP) {
        uvec2 at = seen.first + uvec2(place % size.x, place / size.x);
#if !WRITE_LISTS
        count(COUNTER_INTERSECTION_TESTS, 1u);
#endif
        fill_range(at.y * grid.dimensions.x + at.x, range_in_tile(at), light);
    }
}
