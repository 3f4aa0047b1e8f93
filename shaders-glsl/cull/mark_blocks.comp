// Marks the blocks that hold visible clusters, and finds the range of cells of all; a workgroup takes a group of clusters.
// Those that measured bounds know to be empty are left out.
// For scatter it also makes the group, with the range of its cells.
#version 460
#include "lib/blocks.glsl"
#include "lib/cluster_space.glsl"
#include "lib/halves.glsl"
#include "lib/measured_bounds.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

shared uint lowest[3], highest[3];

void main()
{
    uint thread = gl_LocalInvocationID.x;
    if (thread < 3u) {
        lowest[thread] = 0xFFFFFFFFu;
        highest[thread] = 0u;
    }
    barrier();
    uint visible = gl_GlobalInvocationID.x;
    if (visible < state.visible && holds_samples(visible)) {
        uvec3 cell = cell_of_linear(visible_clusters[visible]);
        mark_block(block_of(cell));
        for (uint axis = 0u; axis < 3u; ++axis) {
            atomicMin(lowest[axis], cell[axis]);
            atomicMax(highest[axis], cell[axis]);
        }
    }
    barrier();
    if (thread > 0u || gl_WorkGroupID.x * ASSIGN_WORKGROUP >= state.visible)
        return;
    uvec3 low = uvec3(lowest[0], lowest[1], lowest[2]), high = uvec3(highest[0], highest[1], highest[2]);
    include_visible(low, high);
#if ASSIGN == ASSIGN_SCATTER
    groups[gl_WorkGroupID.x] = ClusterGroup(pack_cells(low, high), 0u, 0u, 0u);
#endif
}
