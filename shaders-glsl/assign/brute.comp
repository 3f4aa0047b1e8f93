// Brute-force assignment (Gelderen section 5.3): a thread tests one visible cluster against one segment of the lights.
//
// Lists come out by ascending light: a cluster's segments follow each other, and each thread writes its own in order.
// Threads of a workgroup share the segment, so they read the same light at the same time.
// WRITE_LISTS 0 counts (pass count_lights), 1 writes at the offsets (pass assign_lights).
#version 460
#include "lib/counters.glsl"
#include "lib/intersect.glsl"

layout(local_size_x = ASSIGN_GROUP) in;

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible)
        return;
    uint segment = gl_WorkGroupID.y;
    uint first = segment * grid.segment_size;
    uint end = min(first + grid.segment_size, grid.light_count);
    uint list = visible * grid.segment_count + segment;
    CellBounds cell = cell_bounds(cell_of_linear(visible_clusters[visible]));
#if WRITE_LISTS
    uint offset = list_offsets[list];
    for (uint light = first; light < end; ++light) {
        if (meets(cell, light_spheres[light])) {
            if (offset < grid.index_capacity)
                light_indices[offset] = light;
            ++offset;
        }
    }
#else
    uint lights_met = 0u;
    for (uint light = first; light < end; ++light)
        lights_met += uint(meets(cell, light_spheres[light]));
    segment_counts[list] = lights_met;
#endif
    count(COUNTER_INTERSECTION_TESTS, end > first ? end - first : 0u);
}
