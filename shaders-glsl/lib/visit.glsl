// What the marking shaders do with the cluster of each fragment: mark it (VISIT_MARK), or, once all are ranked, count the
// fragment (VISIT_COUNT), or let the cluster's bounds hold it (VISIT_BOUNDS).
#pragma once

#if LEAVES
#include "lookup/$LOOKUP.glsl"
#else
#include "lib/cluster_space.glsl"
#include "lib/visible.glsl"
#if VISIT == VISIT_BOUNDS
#include "lib/measured_bounds.glsl"
#endif
#endif

#if LEAVES

// Leaves of an octree are there whatever is seen, so that there is nothing but to count.
void visit_sample(ViewData view, vec2 pixel, float depth)
{
    uint leaf = group_of_sample(view, pixel, depth);
    if (leaf != NO_GROUP)
        atomicAdd(visible_fragments[leaf], 1u);
}

#else

// Visits a cluster that holds a position, in the clustering camera's space.
void visit_cluster(uint cluster, vec3 position)
{
#if VISIT == VISIT_MARK
    mark_cluster(cluster);
#else
    uint visible = visible_index(cluster);
    if (visible == NO_CLUSTER)
        return;
#if VISIT == VISIT_COUNT
    atomicAdd(visible_fragments[visible], 1u);
#else
    include_position(visible, position);
#endif
#endif
}

void visit_sample(ViewData view, vec2 pixel, float depth)
{
    vec3 position = clustering_position(view, pixel, depth);
    visit_cluster(linear_cluster(cell_of_position(position)), position);
}

#endif
