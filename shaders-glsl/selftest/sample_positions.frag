// Where samples lie in their pixels, by the rasteriser and by the table that clusters are found with: fragments seen, and
// the largest distances, in parts of 65536 of a pixel, of what the driver says and of where fragments run.
#version 460
#include "lib/fragment_position.glsl"

layout(early_fragment_tests) in;

uint distance_from(vec2 position, vec2 table)
{
    vec2 away = abs(position - table);
    return uint(max(away.x, away.y) * 65536.0);
}

void main()
{
    vec2 corner = floor(gl_FragCoord.xy);
    vec2 table = fragment_pixel() - corner;
    atomicAdd(measurements[0], 1u);
    atomicMax(measurements[1], distance_from(gl_SamplePosition, table));
    atomicMax(measurements[2], distance_from(gl_FragCoord.xy - corner, table));
}
