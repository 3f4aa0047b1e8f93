// What shells are before any triangle is drawn: nothing, or from the eye on of lights whose mesh is around it; a workgroup a light.
// LAYERS 1: after all are drawn, that joined to what they left in layers.
#version 460
#include "lib/mesh_in_tiles.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

#if LAYERS

// A half of a range from 8 bits of a texel, whose greatest number stands for nothing.
uint half_of_texel(uint bits)
{
    return bits == 0xFFu ? NO_SLICE : bits;
}

uint range_at(uint place)
{
    uint texel = shell_texels[place / 2u] >> 16u * (place % 2u);
    uint drawn = half_of_texel(texel & 0xFFu) | half_of_texel(texel >> 8 & 0xFFu) << 16;
    return joined_ranges(start_of_shell(), drawn);
}

#else

uint range_at(uint place)
{
    return start_of_shell();
}

#endif

void main()
{
    uint light = gl_WorkGroupID.x;
    if (!load_mesh(light))
        return;
    uint tiles = grid.dimensions.x * grid.dimensions.y;
    for (uint tile = gl_LocalInvocationIndex; tile < tiles; tile += ASSIGN_WORKGROUP) {
        uint place = light * tiles + tile;
        shell_ranges[place] = range_at(place);
    }
}
