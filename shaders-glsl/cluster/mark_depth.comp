// Marks (or what else VISIT says) the cluster of every sample of the depth buffer (Gelderen section 5.2).
//
// Each sample reads its cluster's bit by itself. Leaving out neighbours of the same cluster did not win on lavapipe (mono,
// 1280x720, times over this one's, in turn on two cores with other work): compared in shared memory 1.4 at ortho-1 and 0.7
// to 1.0 at persp-64; four pixels a thread, the last cluster remembered, 1.2 to 1.3 at ortho-1 and 0.8 to 1.3 at persp-64.
#version 460
#include "lib/sample_positions.glsl"
#include "lib/visit.glsl"

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
            visit_sample(view, vec2(pixel) + sample_position(s), depth);
    }
}
