// All lights into the clustering camera's space, for brute force.
#version 460
#include "lib/light_volume.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint light = gl_GlobalInvocationID.x;
    if (light < grid.light_count)
        light_volumes[light] = volume_of_light(light);
}
