// Assignment by rectangles (Tegelaers section 5.2): a light to the visible clusters among the cells in which it is seen. Its cells
// are dealt out to RECTANGLE_SPLIT threads.
// WRITE_LISTS 0 counts (pass count_rectangles), 1 writes (pass fill_rectangles) where light bits did not fit.
#version 460
#include "lib/counters.glsl"
#include "lib/intersect.glsl"
#include "lib/list_builder.glsl"
#include "lib/visible.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Whether a light that is seen in a cell meets what is measured of it, where that is.
bool meets_measured(uint visible, uint light)
{
#if BOUNDS == BOUNDS_CELL
    return true;
#else
    return holds_samples(visible) && meets(bounds_of_visible(visible), volume_of_light(light));
#endif
}

void main()
{
    uint light = gl_GlobalInvocationID.x;
    if (light >= state.candidates)
        return;
    LightRectangle seen = read_rectangle(light);
    if (any(greaterThan(seen.first, seen.last)))
        return;
    uvec3 size = seen.last - seen.first + 1u;
    uint cells = size.x * size.y * size.z, tests = 0u;
    // Turns take several cells: lavapipe ends a shader's loops after 65 535 turns of all of them.
    for (uint turn = gl_WorkGroupID.y; turn < cells; turn += RECTANGLE_SPLIT * RECTANGLE_CHUNK) {
        [[unroll]] for (uint i = 0u; i < RECTANGLE_CHUNK; ++i) {
            uint place = turn + i * RECTANGLE_SPLIT;
            if (place < cells) {
                uint row = place / size.x;
                uvec3 cell = seen.first + uvec3(place - row * size.x, row % size.y, row / size.y);
                uint visible = visible_index(linear_cluster(cell));
                if (visible != NO_CLUSTER) {
                    ++tests;
                    if (meets_measured(visible, light))
                        add_light(visible, light);
                }
            }
        }
    }
#if !WRITE_LISTS
    count(COUNTER_INTERSECTION_TESTS, tests);
#endif
}
