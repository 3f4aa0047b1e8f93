// Lights into the clustering camera's space: (centre, radius). The radius grows by the slack that covers rounding,
// so that a light is never lost at a cell's boundary.
#version 460
#include "generated/gpu_interface.glsl"

layout(local_size_x = ASSIGN_GROUP) in;

void main()
{
    uint light = gl_GlobalInvocationID.x;
    if (light >= grid.light_count)
        return;
    vec3 centre = (grid.clustering_from_world * vec4(lights[light].position, 1.0)).xyz;
    light_spheres[light] = vec4(centre, lights[light].r1 + grid.slack);
}
