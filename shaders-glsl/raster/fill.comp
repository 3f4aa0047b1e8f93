// Fill (Örtegren and Persson section 4.4): a light to the clusters of a tile between the slices of its shell; a workgroup takes a light (y)
// and as many tiles as it has threads (x).
// WRITE_LISTS 0 counts (stage fill_clusters), 1 writes (stage write_lists) where light bits did not fit.
#version 460
#include "lib/cluster_space.glsl"
#include "lib/counters.glsl"
#include "lib/list_builder.glsl"
#include "lib/slice_range.glsl"
#include "lib/visible.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint tile = gl_GlobalInvocationID.x, light = gl_WorkGroupID.y, tiles = grid.dimensions.x * grid.dimensions.y;
    if (tile >= tiles || light >= state.candidates)
        return;
#if !WRITE_LISTS
    count(COUNTER_INTERSECTION_TESTS, 1u);
#endif
    uint range = shell_ranges[light * tiles + tile];
    uint first = range & NO_SLICE, behind = range >> 16;
    if (first == NO_SLICE || behind == NO_SLICE)
        return;
    uvec2 column = uvec2(tile % grid.dimensions.x, tile / grid.dimensions.x);
    for (uint slice = first; slice + behind < grid.dimensions.z; ++slice) {
        uint visible = visible_index(linear_cluster(uvec3(column, slice)));
        if (visible != NO_CLUSTER)
            add_light(visible, light);
    }
}
