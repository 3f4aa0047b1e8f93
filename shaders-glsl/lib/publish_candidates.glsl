// What follows from how many lights may meet a visible cluster.
#pragma once

#include "lib/publish_visible.glsl"
#extension GL_EXT_control_flow_attributes : require

void publish_candidates(uint total)
{
    publish_lists(total, state.visible);
#if ASSIGN == ASSIGN_HIERARCHY
    uint blocks = (total + SORT_BLOCK - 1u) / SORT_BLOCK;
    dispatches[DISPATCH_SORT] = groups_for(blocks, ASSIGN_WORKGROUP);
    dispatches[DISPATCH_SORT_SCAN] = groups_for(blocks * SORT_DIGITS, SCAN_BLOCK);
    uint nodes = total;
    // Unrolled: as a loop, which a single thread enters, this took llvmpipe 1.3 ms.
    [[unroll]] for (uint depth = MAX_TREE_DEPTH - 1u; depth > 0u; --depth) {
        if (depth < grid.tree_depth) {
            nodes = (nodes + TREE_WIDTH - 1u) / TREE_WIDTH;
            dispatches[DISPATCH_NODES + depth - 1u] = groups_for(nodes, ASSIGN_WORKGROUP);
        }
    }
#else
    DispatchSize to_groups = groups_for(total, ASSIGN_WORKGROUP);
    to_groups.y = (dispatches[DISPATCH_LISTS].x + GROUP_CHUNK - 1u) / GROUP_CHUNK;
    dispatches[DISPATCH_GROUPS] = to_groups;
#endif
}
