// Marks (or what else VISIT says) the cluster, or model, of every fragment that shading will see: transparent geometry always, all
// geometry with marking from geometry. The depth test alone decides, as in shading.
#version 460
#include "lib/fragment_position.glsl"
#include "lib/visit.glsl"

layout(early_fragment_tests) in;

#if MODELS
#include "lib/model_of_fragment.glsl"
#endif

void main()
{
    if (is_background())
        return;
#if MODELS
    visit_cluster(model_of_fragment, vec3(0.0));
#else
    visit_sample(views[push.view], fragment_pixel(), gl_FragCoord.z);
#endif
}
