// Compaction by a counter (Enhuber section 3.2, Ortiz): a thread takes a cluster, and where it is visible the next place, whichever
// that is. A reader asks the cluster's bit first, so that places of clusters that are not visible need no clearing.
#version 460
#include "generated/gpu_interface.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint cluster = gl_GlobalInvocationID.x;
    uint clusters = grid.dimensions.x * grid.dimensions.y * grid.dimensions.z;
    if (cluster >= clusters || (cluster_bits[cluster >> 5] & 1u << (cluster & 31u)) == 0u)
        return;
    uint place = atomicAdd(new_state.visible_total, 1u);
    cluster_places[cluster] = place;
    if (place < grid.visible_capacity)
        visible_clusters[place] = cluster;
}
