// Prepass of masked geometry.
#version 460
#include "lib/material.glsl"

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 color;
layout(location = 2) flat in uint material_index;

void main()
{
    TextureCoordinates at = texture_coordinates(uv);
    MaterialData material = materials[material_index];
    if (base_color(material, at, color).a < material.alpha_cutoff)
        discard;
}
