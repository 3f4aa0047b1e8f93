// What the prefix sum sums (scan_length, scan_item), what becomes of each item's exclusive prefix (emit), and of the total
// (publish), by SCAN_ITEMS.
#pragma once

#include "lib/publish_visible.glsl"

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

void publish(uint total) { publish_visible(total); }

#elif SCAN_ITEMS == SCAN_TILES

uint scan_length() { return grid.dimensions.x * grid.dimensions.y; }
uint scan_item(uint tile) { return tile_counts[tile]; }

// Lists the visible clusters of a tile by ascending slice.
void emit(uint tile, uint offset)
{
    tile_offsets[tile] = offset;
    uint end = min(offset + tile_counts[tile], grid.visible_capacity);
    uint slices = tile * grid.dimensions.z;
    for (uint place = offset; place < end; ++place)
        visible_clusters[place] = tile + scan_length() * tile_slices[slices + place - offset];
}

void publish(uint total)
{
    tile_offsets[scan_length()] = total;
    publish_visible(total);
}

#elif SCAN_ITEMS == SCAN_DIGITS

#include "lib/sort.glsl"

uint scan_length() { return SORT_DIGITS * sort_blocks(); }
uint scan_item(uint i) { return digit_counts[i]; }
void emit(uint digit, uint offset) { digit_counts[digit] = offset; }
void publish(uint total) {}

#elif SCAN_ITEMS == SCAN_GROUPS

uint scan_length() { return (state.visible + ASSIGN_WORKGROUP - 1u) / ASSIGN_WORKGROUP; }
uint scan_item(uint group) { return (groups[group].lights + ASSIGN_WORKGROUP - 1u) / ASSIGN_WORKGROUP; }

// Gives a group its packets.
void emit(uint group, uint first)
{
    groups[group].first_packet = first;
    uint end = min(first + scan_item(group), grid.group_capacity / ASSIGN_WORKGROUP);
    for (uint packet = first; packet < end; ++packet)
        packet_groups[packet] = group;
}

void publish(uint total)
{
    bool listed = total <= grid.group_capacity / ASSIGN_WORKGROUP;
    if (!listed)
        total = scan_length() * ((state.candidates + ASSIGN_WORKGROUP - 1u) / ASSIGN_WORKGROUP);
    new_state.packets = total;
    new_state.listed = uint(listed);
    publish_meeting(DispatchSize(min(total, PACKET_ROW), (total + PACKET_ROW - 1u) / PACKET_ROW, 1u), state.masked != 0u);
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
