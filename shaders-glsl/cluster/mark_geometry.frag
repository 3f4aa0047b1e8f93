// Marks (or counts, see visit_cluster) the cluster, or model, of every fragment that shading will see: transparent geometry always, all geometry with
// marking from geometry. The depth test alone decides, as in shading.
#version 460
#include "lib/cluster_space.glsl"
#include "lib/fragment_position.glsl"
#include "lib/visible.glsl"

layout(early_fragment_tests) in;

#if MODELS
#include "lib/model_of_fragment.glsl"
#endif

uint group_of_fragment()
{
#if MODELS
    return model_of_fragment;
#else
    return cluster_of_sample(views[push.view], fragment_pixel(), gl_FragCoord.z);
#endif
}

void main()
{
    if (is_background())
        return;
    visit_cluster(group_of_fragment());
}
