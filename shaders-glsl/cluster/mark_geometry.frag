// Marks the cluster of every fragment that shading will see: transparent geometry always, all geometry with
// marking from geometry. Depth is already laid down, so early tests never write depth for a discarded fragment.
#version 460
#include "lib/cluster_space.glsl"
#include "lib/fragment_position.glsl"
#include "lib/visible.glsl"
#if SURFACE == SURFACE_MASKED
#include "lib/material.glsl"

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 color;
layout(location = 2) flat in uint material_index;
#endif

layout(early_fragment_tests) in;

void main()
{
#if SURFACE == SURFACE_MASKED
    MaterialData material = materials[material_index];
    if (base_color(material, uv, color).a < material.alpha_cutoff)
        discard;
#endif
    mark_cluster(cluster_of_sample(views[push.view], fragment_pixel(), gl_FragCoord.z));
}
