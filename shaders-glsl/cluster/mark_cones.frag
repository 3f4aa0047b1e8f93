// Lets the cones of a cluster hold the shading normal of every fragment of one surface kind that shading will see, as
// shade/forward.frag finds it; what is unlit is shaded by no light. The depth test alone decides, as in shading.
#version 460
#include "lib/fragment_surface.glsl"
#include "lib/cluster_space.glsl"
#include "lib/normal_cones.glsl"
#include "lib/visible.glsl"

layout(early_fragment_tests) in;

void main()
{
    TextureCoordinates at = texture_coordinates(uv);
    if (is_background() || material.unlit != 0u)
        return;
    vec3 position = clustering_position(views[push.view], fragment_pixel(), gl_FragCoord.z);
    uint visible = visible_index(linear_cluster(cell_of_position(position)));
    if (visible != NO_CLUSTER)
        include_normal(visible, mat3(grid.clustering_from_world) * shading_normal(at));
}
