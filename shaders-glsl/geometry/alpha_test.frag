// Prepass of masked geometry.
#version 460
#include "lib/material.glsl"

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 color;

// Vertices hold alpha in steps of 1/255. Interpolation leaves what all corners of a triangle agree on a rounding step
// off, so that alpha equal to the cut-off fell below it: to the nearest of 256 steps between two, it is exact again.
const float ALPHA_STEPS = 255.0 * 256.0;

float vertex_alpha()
{
    return round(color.a * ALPHA_STEPS) / ALPHA_STEPS;
}

void main()
{
    TextureCoordinates at = texture_coordinates(uv);
    if (base_color(at, vec4(color.rgb, vertex_alpha())).a < material.alpha_cutoff)
        discard;
}
