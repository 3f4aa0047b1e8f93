// Lists every cluster of the grid as a visible one, where all get lists.
#version 460
#include "lib/publish_visible.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint cluster = gl_GlobalInvocationID.x;
    uint clusters = grid.dimensions.x * grid.dimensions.y * grid.dimensions.z;
    if (cluster < min(clusters, grid.visible_capacity))
        visible_clusters[cluster] = cluster;
    if (cluster == 0u)
        publish_visible(clusters);
}
