// The slices of a tile, which a pixel is, in which a triangle of a light's mesh lies, joined to those of the mesh's others in any order
// (Örtegren and Persson section 4.3). Pixels that the triangle does not touch have no depths of it.
//
// LAYERS 0: in a buffer. 1: in the light's layer of an image, of which each component keeps the least.
#version 460
#include "lib/shell.glsl"

layout(location = 0) flat in uint in_light;
layout(location = 1) flat in vec3 in_corners[3];

#if LAYERS

// The slices as parts of 255, all of which stand for none; blending joins those of the mesh's triangles.
layout(location = 0) out vec2 out_slices;

float part_of_half(uint slices)
{
    return slices == NO_SLICE ? 1.0 : float(slices) / 255.0;
}

void join(uvec2 at, uint range)
{
    out_slices = vec2(part_of_half(range & NO_SLICE), part_of_half(range >> 16));
}

#else

void join(uvec2 at, uint range)
{
    uint place = (in_light * grid.dimensions.y + at.y) * grid.dimensions.x + at.x;
    uint there = shell_ranges[place], joined = joined_ranges(there, range);
    // Others may join theirs meanwhile.
    while (joined != there) {
        uint found = atomicCompSwap(shell_ranges[place], there, joined);
        if (found == there)
            return;
        there = found;
        joined = joined_ranges(there, range);
    }
}

#endif

void main()
{
    uvec2 at = uvec2(gl_FragCoord.xy);
    vec2 depths = depths_in_tile(Triangle(in_corners), tile_at(at));
    if (depths.x > depths.y)
        discard;
    join(at, range_of(depths));
}
