// What the prefix sum sums (scan_length, scan_item), what becomes of each item's exclusive prefix (emit), and of the total
// (publish), by SCAN_ITEMS.
#pragma once

#include "generated/gpu_interface.glsl"

DispatchSize groups_for(uint items, uint group_size)
{
    return DispatchSize((items + group_size - 1u) / group_size, 1u, 1u);
}

const DispatchSize NO_DISPATCH = DispatchSize(0u, 1u, 1u);

// What finds the pairs of light and cluster runs once where they are kept as bits, else twice.
void publish_meeting(DispatchSize size)
{
    dispatches[DISPATCH_MEET] = size;
    if (state.masked != 0u)
        size = NO_DISPATCH;
    dispatches[DISPATCH_MEET_AGAIN] = size;
}

// Lists of up to `lights` lights each, for all visible clusters.
void publish_lists(uint lights)
{
    uint words = (lights + 31u) / 32u;
#if ASSIGN == ASSIGN_BRUTE
    words += words & 1u; // whole tiles
#endif
    bool masked = words == 0u || state.visible <= grid.mask_capacity / words;
    state.candidates = lights;
    state.mask_words = words;
    state.masked = uint(masked);
    DispatchSize lists = groups_for(state.visible, ASSIGN_GROUP);
    dispatches[DISPATCH_LISTS] = lists;
    DispatchSize masked_lists = lists;
    DispatchSize unmasked_lists = DispatchSize(min(state.visible, LIST_ROW), (state.visible + LIST_ROW - 1u) / LIST_ROW, 1u);
    if (masked)
        unmasked_lists = NO_DISPATCH;
    else
        masked_lists = NO_DISPATCH;
    dispatches[DISPATCH_MASKED] = masked_lists;
    dispatches[DISPATCH_UNMASKED] = unmasked_lists;
#if ASSIGN == ASSIGN_BRUTE
    publish_meeting(DispatchSize(lists.x, (lights + ASSIGN_GROUP - 1u) / ASSIGN_GROUP, 1u));
#elif ASSIGN == ASSIGN_HIERARCHY
    publish_meeting(DispatchSize(lists.x, TREE_SPLIT, 1u));
#endif
}

#if SCAN_ITEMS == SCAN_VISIBILITY

uint scan_length() { return grid.word_count; }
uint scan_item(uint i) { return uint(bitCount(cluster_bits[i])); }

// Lists the visible clusters by ascending index.
void emit(uint word, uint rank)
{
    word_ranks[word] = rank;
    for (uint bits = cluster_bits[word]; bits != 0u && rank < grid.visible_capacity; bits &= bits - 1u)
        visible_clusters[rank++] = word * 32u + uint(findLSB(bits));
}

void publish(uint total)
{
    state.visible_total = total;
    state.visible = min(total, grid.visible_capacity);
    dispatches[DISPATCH_LISTS] = groups_for(state.visible, ASSIGN_GROUP);
    dispatches[DISPATCH_SCAN] = groups_for(state.visible, SCAN_BLOCK);
#if ASSIGN == ASSIGN_BRUTE
    publish_lists(grid.light_count);
#endif
}

#elif SCAN_ITEMS == SCAN_LIGHTS

#include "lib/cell_range.glsl"
#include "lib/halves.glsl"

uint scan_length() { return (grid.light_count + 31u) / 32u; }
uint scan_item(uint i) { return uint(bitCount(light_bits[i])); }

// Lists the candidates by ascending light.
void emit(uint word, uint rank)
{
    for (uint bits = light_bits[word]; bits != 0u; bits &= bits - 1u) {
        uint light = word * 32u + uint(findLSB(bits));
        CellRange range = cells_near(light_spheres[light]);
        uvec3 cells;
        for (uint axis = 0u; axis < 3u; ++axis)
            cells[axis] = pack_range(uint(range.low[axis]), uint(range.high[axis]));
        candidates[rank++] = Candidate(light, cells);
    }
}

void publish(uint total)
{
    publish_lists(total);
#if ASSIGN == ASSIGN_HIERARCHY
    uint blocks = (total + SORT_BLOCK - 1u) / SORT_BLOCK;
    dispatches[DISPATCH_SORT] = groups_for(blocks, ASSIGN_GROUP);
    dispatches[DISPATCH_SORT_SCAN] = groups_for(blocks * SORT_DIGITS, SCAN_BLOCK);
    uint nodes = total;
    for (uint depth = grid.tree_depth - 1u; depth > 0u; --depth) {
        nodes = (nodes + TREE_WIDTH - 1u) / TREE_WIDTH;
        dispatches[DISPATCH_NODES + depth - 1u] = groups_for(nodes, ASSIGN_GROUP);
    }
#else
    DispatchSize to_groups = groups_for(total, ASSIGN_GROUP);
    to_groups.y = (dispatches[DISPATCH_LISTS].x + GROUP_CHUNK - 1u) / GROUP_CHUNK;
    dispatches[DISPATCH_GROUPS] = to_groups;
#endif
}

#elif SCAN_ITEMS == SCAN_DIGITS

#include "lib/sort.glsl"

uint scan_length() { return SORT_DIGITS * sort_blocks(); }
uint scan_item(uint i) { return digit_counts[i]; }
void emit(uint digit, uint offset) { digit_counts[digit] = offset; }
void publish(uint total) {}

#elif SCAN_ITEMS == SCAN_GROUPS

uint scan_length() { return (state.visible + ASSIGN_GROUP - 1u) / ASSIGN_GROUP; }
uint scan_item(uint group) { return (groups[group].lights + ASSIGN_GROUP - 1u) / ASSIGN_GROUP; }

// Gives a group its tiles.
void emit(uint group, uint first)
{
    groups[group].first_tile = first;
    uint end = min(first + scan_item(group), grid.group_capacity / ASSIGN_GROUP);
    for (uint tile = first; tile < end; ++tile)
        tile_groups[tile] = group;
}

void publish(uint total)
{
    bool listed = total <= grid.group_capacity / ASSIGN_GROUP;
    if (!listed)
        total = scan_length() * ((state.candidates + ASSIGN_GROUP - 1u) / ASSIGN_GROUP);
    state.tiles = total;
    state.listed = uint(listed);
    publish_meeting(DispatchSize(min(total, TILE_ROW), (total + TILE_ROW - 1u) / TILE_ROW, 1u));
    if (!listed)
        dispatches[DISPATCH_GROUPS] = NO_DISPATCH;
}

#else

uint scan_length() { return state.visible; }
uint scan_item(uint visible) { return list_lengths[visible]; }
void emit(uint visible, uint offset) { list_offsets[visible] = offset; }

void publish(uint total)
{
    state.index_total = total;
    list_offsets[state.visible] = total;
}

#endif
