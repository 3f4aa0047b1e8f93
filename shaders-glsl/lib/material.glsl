// A material at a point of its surface.
#pragma once

#include "generated/gpu_interface.glsl"

layout(set = SET_MATERIAL, binding = 0) uniform sampler2D base_color_texture;
layout(set = SET_MATERIAL, binding = 1) uniform sampler2D metallic_roughness_texture;
layout(set = SET_MATERIAL, binding = 2) uniform sampler2D normal_texture;
layout(set = SET_MATERIAL, binding = 3) uniform sampler2D occlusion_texture;
layout(set = SET_MATERIAL, binding = 4) uniform sampler2D emissive_texture;

// Coordinates of one of the five textures: its uv set through its affine transform.
vec2 texture_uv(MaterialData material, uint slot, vec4 uv)
{
    vec3 source = vec3((material.uv_slots >> slot & 1u) == 0u ? uv.xy : uv.zw, 1.0);
    return vec2(dot(material.uv_rows[2u * slot], source), dot(material.uv_rows[2u * slot + 1u], source));
}

vec4 base_color(MaterialData material, vec4 uv, vec4 color)
{
    return material.base_color * color * texture(base_color_texture, texture_uv(material, 0u, uv));
}
