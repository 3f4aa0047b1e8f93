// The visible clusters: one bit a cluster while marking; after compaction the place of a cluster among them is its rank, or what
// a counter gave it. Where all clusters get lists, each is visible, and its place is its index.
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

// Index of a cluster among the visible ones, or NO_CLUSTER where it is not marked or did not fit.
uint visible_index(uint cluster)
{
#if CLUSTERS == CLUSTERS_ALL
    return cluster < grid.visible_capacity ? cluster : NO_CLUSTER;
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
