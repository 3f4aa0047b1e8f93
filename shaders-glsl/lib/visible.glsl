// The visible clusters: one bit a cluster while marking; after compaction the place of a cluster among them is its rank, or what
// a counter gave it, or where it stands among those of its tile, which ascend. Where all clusters get lists, each is visible, and its place is its index.
#pragma once

#include "generated/gpu_interface.glsl"

const uint NO_CLUSTER = 0xFFFFFFFFu;

// Marks a cluster visible. Reading first spares most atomics: many samples share a cluster.
void mark_cluster(uint cluster)
{
    uint bit = 1u << (cluster & 31u);
    if ((cluster_bits[cluster >> 5] & bit) == 0u)
        atomicOr(cluster_bits[cluster >> 5], bit);
}

#if COMPACTION == COMPACTION_SORT
// Behind the last of the visible clusters of a cluster's tile.
uint end_of_tile(uint cluster)
{
    uint tile = cluster % (grid.dimensions.x * grid.dimensions.y);
    return min(tile_offsets[tile + 1u], grid.visible_capacity);
}

// Place of the first visible cluster of a cluster's tile that is not nearer than it.
uint first_in_tile(uint cluster)
{
    uint low = tile_offsets[cluster % (grid.dimensions.x * grid.dimensions.y)];
    uint high = end_of_tile(cluster);
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (visible_clusters[middle] < cluster)
            low = middle + 1u;
        else
            high = middle;
    }
    return low;
}

// Where a cluster stands among those of its tile, or NO_CLUSTER where it holds no sample.
uint index_in_tile(uint cluster)
{
    uint place = first_in_tile(cluster);
    return place < end_of_tile(cluster) && visible_clusters[place] == cluster ? place : NO_CLUSTER;
}
#endif

// Index of a cluster among the visible ones, or NO_CLUSTER where it is not marked or did not fit.
uint visible_index(uint cluster)
{
#if CLUSTERS == CLUSTERS_ALL
    return cluster < grid.visible_capacity ? cluster : NO_CLUSTER;
#elif COMPACTION == COMPACTION_SORT
    return index_in_tile(cluster);
#else
    uint word = cluster_bits[cluster >> 5];
    uint bit = 1u << (cluster & 31u);
#if COMPACTION == COMPACTION_ATOMIC
    uint index = cluster_places[cluster];
#else
    uint index = word_ranks[cluster >> 5] + bitCount(word & (bit - 1u));
#endif
    return (word & bit) != 0u && index < grid.visible_capacity ? index : NO_CLUSTER;
#endif
}
