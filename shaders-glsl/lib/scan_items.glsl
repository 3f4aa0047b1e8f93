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
void publish_meeting(DispatchSize size, bool masked)
{
    dispatches[DISPATCH_MEET] = size;
    if (masked)
        size = NO_DISPATCH;
    dispatches[DISPATCH_MEET_AGAIN] = size;
}

// Lists of up to `lights` lights each, for so many visible clusters.
void publish_lists(uint lights, uint visible)
{
    uint words = (lights + 31u) / 32u;
#if ASSIGN == ASSIGN_BRUTE
    words += words & 1u; // whole tiles
#endif
    bool masked = words == 0u || visible <= grid.mask_capacity / words;
    new_state.candidates = lights;
    new_state.mask_words = words;
    new_state.masked = uint(masked);
    DispatchSize lists = groups_for(visible, ASSIGN_GROUP);
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
    publish_meeting(DispatchSize(lists.x, (lights + ASSIGN_GROUP - 1u) / ASSIGN_GROUP, 1u), masked);
#elif ASSIGN == ASSIGN_HIERARCHY
    publish_meeting(DispatchSize(lists.x, TREE_SPLIT, 1u), masked);
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
    new_state.visible_total = total;
    uint visible = min(total, grid.visible_capacity);
    new_state.visible = visible;
    dispatches[DISPATCH_LISTS] = groups_for(visible, ASSIGN_GROUP);
    dispatches[DISPATCH_SCAN] = groups_for(visible, SCAN_BLOCK);
#if ASSIGN == ASSIGN_BRUTE
    publish_lists(grid.light_count, visible);
#endif
}

#elif SCAN_ITEMS == SCAN_LIGHTS

uint scan_length() { return (grid.light_count + 31u) / 32u; }
uint scan_item(uint i) { return uint(bitCount(light_bits[i])); }

// Ranks the words: the candidates before each lie behind the bits.
void emit(uint word, uint rank) { light_bits[scan_length() + word] = rank; }

void publish(uint total)
{
    publish_lists(total, state.visible);
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
    new_state.tiles = total;
    new_state.listed = uint(listed);
    publish_meeting(DispatchSize(min(total, TILE_ROW), (total + TILE_ROW - 1u) / TILE_ROW, 1u), state.masked != 0u);
    if (!listed)
        dispatches[DISPATCH_GROUPS] = NO_DISPATCH;
}

#else

uint scan_length() { return state.visible; }
uint scan_item(uint visible) { return list_lengths[visible]; }
void emit(uint visible, uint offset) { list_offsets[visible] = offset; }

void publish(uint total)
{
    new_state.index_total = total;
    list_offsets[state.visible] = total;
}

#endif
