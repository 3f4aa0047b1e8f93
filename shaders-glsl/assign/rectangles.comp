// Assignment by rectangles (Tegelaers section 5.2): a light to the visible clusters among the cells in which it is seen, which are
// found as their places are kept:
//
//   all clusters have lists  cell by cell
//   a bit a cluster          row by row of the grid, by the bits of its words
//   tiles are sorted         tile by tile, from the first of its clusters that is deep enough
//
// What is gone through is dealt out to as many threads as the dispatch is high.
// WRITE_LISTS 0 counts (pass count_rectangles), 1 writes (pass fill_rectangles) where light bits did not fit.
#version 460
#include "lib/counters.glsl"
#include "lib/intersect.glsl"
#include "lib/list_builder.glsl"
#include "lib/visible.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

uint tests = 0u;

// Puts a light on the list of a cluster in which it is seen, where it meets what is measured of that.
void take_light(uint visible, uint light)
{
    if (visible == NO_CLUSTER)
        return;
    ++tests;
#if BOUNDS != BOUNDS_CELL || CONES != CONES_UNASKED
    if (!holds_samples(visible) || !meets(visible, bounds_of_visible(visible), volume_of_light(light)))
        return;
#endif
    add_light(visible, light);
}

#if CLUSTERS == CLUSTERS_ALL

void go_through(LightRectangle seen, uint light)
{
    uvec3 size = seen.last - seen.first + 1u;
    for (uint place = gl_WorkGroupID.y; place < size.x * size.y * size.z; place += gl_NumWorkGroups.y) {
        uint row = place / size.x, layer = row / size.y;
        uvec3 cell = seen.first + uvec3(place - row * size.x, row - layer * size.y, layer);
        take_light(visible_index(linear_cluster(cell)), light);
    }
}

#elif COMPACTION == COMPACTION_SORT

void go_through(LightRectangle seen, uint light)
{
    uvec2 size = seen.last.xy - seen.first.xy + 1u;
    for (uint place = gl_WorkGroupID.y; place < size.x * size.y; place += gl_NumWorkGroups.y) {
        uint row = place / size.x;
        uvec2 tile = seen.first.xy + uvec2(place - row * size.x, row);
        uint last = linear_cluster(uvec3(tile, seen.last.z));
        uint visible = first_in_tile(linear_cluster(uvec3(tile, seen.first.z)));
        uint end = end_of_tile(last);
        for (; visible < end && visible_clusters[visible] <= last; ++visible)
            take_light(visible, light);
    }
}

#else

void go_through(LightRectangle seen, uint light)
{
    uvec3 size = seen.last - seen.first + 1u;
    for (uint row = gl_WorkGroupID.y; row < size.y * size.z; row += gl_NumWorkGroups.y) {
        uint layer = row / size.y;
        uint first = linear_cluster(seen.first + uvec3(0u, row - layer * size.y, layer));
        uint last = first + size.x - 1u;
        for (uint word = first >> 5; word <= last >> 5; ++word) {
            uint bits = cluster_bits[word];
            bits &= word == first >> 5 ? 0xFFFFFFFFu << (first & 31u) : 0xFFFFFFFFu;
            bits &= word == last >> 5 ? 0xFFFFFFFFu >> (31u - (last & 31u)) : 0xFFFFFFFFu;
            for (; bits != 0u; bits &= bits - 1u)
                take_light(visible_index(word * 32u + uint(findLSB(bits))), light);
        }
    }
}

#endif

void main()
{
    uint light = gl_GlobalInvocationID.x;
    if (light >= state.candidates)
        return;
    LightRectangle seen = read_rectangle(light);
    if (all(lessThanEqual(seen.first, seen.last)))
        go_through(seen, light);
#if !WRITE_LISTS
    count(COUNTER_INTERSECTION_TESTS, tests);
#endif
}
