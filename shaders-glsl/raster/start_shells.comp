// What shells are before any triangle is drawn: nothing, or from the eye on of lights whose mesh is around it; a workgroup a light.
#version 460
#include "lib/mesh_in_tiles.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint light = gl_WorkGroupID.x;
    if (!load_mesh(light))
        return;
    uint tiles = grid.dimensions.x * grid.dimensions.y;
    for (uint tile = gl_LocalInvocationIndex; tile < tiles; tile += ASSIGN_WORKGROUP)
        shell_ranges[light * tiles + tile] = start_of_shell();
}
