// Assignment by the light hierarchy: a thread takes one visible cluster down some of the tree's subtrees.
//
// Nodes are tested conservatively, lights by the test of brute force on the same numbers: the lists are the same.
// The walk is depth-first and keeps no stack, for a place names its parent. The subtrees at TREE_CUT are dealt out
// to the threads of a cluster in turn.
// WRITE_LISTS 0 counts (pass count_lights), 1 writes (pass assign_lights) where light bits did not fit.
#version 460
#include "lib/counters.glsl"
#include "lib/light_tree.glsl"
#include "lib/list_builder.glsl"

#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_WORKGROUP) in;

const uint TREE_CUT = 2u;

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible || !holds_samples(visible))
        return;
    CellBounds cell = bounds_of_visible(visible);
    uint lights_there = state.candidates;
    uint cut = min(TREE_CUT, grid.tree_depth - 1u);
    uint root = gl_WorkGroupID.y;
    uint depth = cut, place = root, tests = 0u;
    while (first_light(depth, place) < lights_there) {
        ++tests;
        bool hit = may_meet(cell, light_node(depth, place));
        if (hit && depth + 1u < grid.tree_depth) {
            ++depth;
            place *= TREE_WIDTH;
            continue;
        }
        if (hit) {
            uint first = place * TREE_WIDTH;
            uint end = min(first + TREE_WIDTH, lights_there);
            // A leaf is no loop: lavapipe ends a shader's loops after 65 535 turns of all of them.
            [[unroll]] for (uint i = 0u; i < TREE_WIDTH; ++i)
                if (first + i < end && meets(visible, cell, read_tree_volume(first + i)))
                    add_light(visible, tree_lights[first + i]);
            tests += end - first;
        }
        ++place;
        while (depth > cut && place % TREE_WIDTH == 0u) {
            --depth;
            place /= TREE_WIDTH;
        }
        if (depth == cut) {
            root += TREE_SPLIT;
            place = root;
        }
    }
#if !WRITE_LISTS
    count(COUNTER_INTERSECTION_TESTS, tests);
#endif
}
