// The alpha test of masked surfaces: the same decision wherever it is made. The prepass makes it once a pixel.
#pragma once

#include "lib/material.glsl"

// Vertices hold alpha in steps of 1/255. Interpolation leaves what all corners of a triangle agree on a rounding step
// off, so that alpha equal to the cut-off fell below it: to the nearest of 256 steps between two, it is exact again.
const float ALPHA_STEPS = 255.0 * 256.0;

// Whether the surface is cut out where it has these texture coordinates and this vertex colour. Takes derivatives: before any
// branch.
bool is_cut_out(vec4 uv, vec4 color)
{
    float vertex_alpha = round(color.a * ALPHA_STEPS) / ALPHA_STEPS;
    return base_color(texture_coordinates(uv), vec4(color.rgb, vertex_alpha)).a < material.alpha_cutoff;
}
