// Marks (or what else VISIT says) the cluster of every fragment that shading will see: transparent geometry always, all
// geometry with marking from geometry. The depth test alone decides, as in shading.
#version 460
#include "lib/fragment_position.glsl"
#include "lib/visit.glsl"

layout(early_fragment_tests) in;

void main()
{
    if (is_background())
        return;
    visit_sample(views[push.view], fragment_pixel(), gl_FragCoord.z);
}
