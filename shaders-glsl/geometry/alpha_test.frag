// Prepass of masked geometry.
#version 460
#include "lib/material.glsl"

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 color;

void main()
{
    TextureCoordinates at = texture_coordinates(uv);
    if (base_color(at, color).a < material.alpha_cutoff)
        discard;
}
