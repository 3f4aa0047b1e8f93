// Fragment counts of the visible clusters, in list order, for reading back.
#version 460
#include "generated/gpu_interface.glsl"

layout(local_size_x = ASSIGN_GROUP) in;

void main()
{
    // The assignment's dispatch has a row per segment of lights; one is enough here.
    uint visible = gl_GlobalInvocationID.x;
    if (gl_WorkGroupID.y == 0u && visible < state.visible)
        visible_fragments[visible] = fragment_counts[visible_clusters[visible]];
}
