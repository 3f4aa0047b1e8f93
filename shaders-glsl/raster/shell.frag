// The slices of a tile, which a pixel is, in which a triangle of a light's mesh lies, joined to those of the mesh's others in any order
// (Örtegren and Persson section 4.3). Pixels that the triangle does not touch have no depths of it.
#version 460
#include "lib/shell.glsl"

layout(location = 0) flat in uint in_light;
layout(location = 1) flat in vec3 in_corners[3];

void join(uint place, uint range)
{
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

void main()
{
    uvec2 at = uvec2(gl_FragCoord.xy);
    vec2 depths = depths_in_tile(Triangle(in_corners), tile_at(at));
    if (depths.x <= depths.y)
        join((in_light * grid.dimensions.y + at.y) * grid.dimensions.x + at.x, range_of(depths));
}
