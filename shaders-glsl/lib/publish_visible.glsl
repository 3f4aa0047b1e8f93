// What follows from how many clusters are visible and how many lights may be on their lists: the state, and the sizes of the
// dispatches that build the lists.
#pragma once

#include "generated/gpu_interface.glsl"

DispatchSize groups_for(uint items, uint group_size)
{
    return DispatchSize((items + group_size - 1u) / group_size, 1u, 1u);
}

const DispatchSize NO_DISPATCH = DispatchSize(0u, 1u, 1u);

// What finds the pairs of light and cluster runs once where they are kept as bits, else twice.
void publish_meeting(DispatchSize size, bool masked)
{
    dispatches[DISPATCH_MEET] = size;
    if (masked)
        size = NO_DISPATCH;
    dispatches[DISPATCH_MEET_AGAIN] = size;
}

#if ASSIGN == ASSIGN_RECTANGLES
// Among how many threads what a light goes through is dealt out (assign/rectangles.comp): so many that none has more turns than
// lavapipe lets a shader's loops have, 65 535 of all of them.
uint rectangle_split(uint visible)
{
    const uint MOST_TURNS = 20000u;
    uvec3 cells = grid.dimensions;
#if CLUSTERS == CLUSTERS_ALL
    uint turns = cells.x * cells.y * cells.z;
#elif COMPACTION == COMPACTION_SORT
    // The bisection of a tile's clusters takes up to log2 of its slices.
    uint turns = 16u * cells.x * cells.y;
#else
    uint turns = (cells.x / 32u + 3u) * cells.y * cells.z;
#endif
    // And a turn for each visible cluster: of few, one thread may meet all.
    if (CLUSTERS != CLUSTERS_ALL && visible > MOST_TURNS)
        turns = max(turns, cells.x * cells.y * cells.z);
    return turns / MOST_TURNS + 1u;
}
#endif

// Lists of up to `lights` lights each, for so many visible clusters.
void publish_lists(uint lights, uint visible)
{
    uint words = (lights + 31u) / 32u;
#if ASSIGN == ASSIGN_BRUTE
    words += words & 1u; // whole packets
#endif
    bool masked = words == 0u || visible <= grid.mask_capacity / words;
    new_state.candidates = lights;
    new_state.mask_words = words;
    new_state.masked = uint(masked);
    DispatchSize lists = groups_for(visible, ASSIGN_WORKGROUP);
    dispatches[DISPATCH_LISTS] = lists;
    DispatchSize masked_lists = lists;
    DispatchSize unmasked_lists = DispatchSize(min(visible, LIST_ROW), (visible + LIST_ROW - 1u) / LIST_ROW, 1u);
    if (masked)
        unmasked_lists = NO_DISPATCH;
    else
        masked_lists = NO_DISPATCH;
    dispatches[DISPATCH_MASKED] = masked_lists;
    dispatches[DISPATCH_UNMASKED] = unmasked_lists;
#if ASSIGN == ASSIGN_BRUTE
    publish_meeting(DispatchSize(lists.x, (lights + ASSIGN_WORKGROUP - 1u) / ASSIGN_WORKGROUP, 1u), masked);
#elif ASSIGN == ASSIGN_HIERARCHY
    publish_meeting(DispatchSize(lists.x, TREE_SPLIT, 1u), masked);
#elif ASSIGN == ASSIGN_RECTANGLES
    publish_meeting(DispatchSize((lights + ASSIGN_WORKGROUP - 1u) / ASSIGN_WORKGROUP, rectangle_split(visible), 1u), masked);
#elif ASSIGN == ASSIGN_RASTER || ASSIGN == ASSIGN_RASTER_COUNT
    publish_meeting(DispatchSize(lights, (grid.dimensions.x * grid.dimensions.y + MESH_TILES - 1u) / MESH_TILES, 1u), masked);
#endif
}

// Of `total` clusters that are visible, as many as fit.
void publish_visible(uint total)
{
    new_state.visible_total = total;
    uint visible = min(total, grid.visible_capacity);
    new_state.visible = visible;
    new_state.longest = 0u;
#if LISTS != LISTS_OFFSETS
    new_state.index_total = 0u;
#endif
    dispatches[DISPATCH_LISTS] = groups_for(visible, ASSIGN_WORKGROUP);
    dispatches[DISPATCH_SCAN] = groups_for(visible, SCAN_BLOCK);
#if ASSIGN != ASSIGN_HIERARCHY && ASSIGN != ASSIGN_SCATTER
    publish_lists(grid.light_count, visible);
#endif
}
