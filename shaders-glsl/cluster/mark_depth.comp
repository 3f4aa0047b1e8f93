// Marks (or counts, see visit_cluster) the cluster of every sample of the depth buffer (Gelderen section 5.2).
#version 460
#include "lib/cluster_space.glsl"
#include "lib/sample_positions.glsl"
#include "lib/visible.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    ViewData view = views[push.view];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view.resolution)))
        return;
    for (int s = 0; s < SAMPLES; ++s) {
        float depth = stored_depth(ivec2(pixel), s);
        if (depth > 0.0)
            visit_cluster(cluster_of_sample(view, vec2(pixel) + sample_position(s), depth));
    }
}
