// A material at a point of its surface. Where MATERIAL is white, so is every surface, and of what its own material says
// alpha alone counts.
#pragma once

#include "generated/gpu_interface.glsl"
#include "lib/texture_slots.glsl"
#include "lib/white.glsl"

layout(set = SET_MATERIAL, binding = BASE_COLOR) uniform sampler2D base_color_texture;
layout(set = SET_MATERIAL, binding = METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_texture;
layout(set = SET_MATERIAL, binding = NORMAL) uniform sampler2D normal_texture;
layout(set = SET_MATERIAL, binding = OCCLUSION) uniform sampler2D occlusion_texture;
layout(set = SET_MATERIAL, binding = EMISSIVE) uniform sampler2D emissive_texture;
layout(set = SET_MATERIAL, binding = 5, scalar) uniform Material { MaterialData material; };

// Both sets of texture coordinates of a fragment, and how they change from pixel to pixel.
struct TextureCoordinates {
    vec4 uv, dx, dy;
};

// Derivatives are taken of the interpolated coordinates alone, before any branch: what helper invocations read from
// buffers, such as a material's transform, is nothing on llvmpipe, and every edge would get the coarsest mip level.
TextureCoordinates texture_coordinates(vec4 uv)
{
    return TextureCoordinates(uv, dFdx(uv), dFdy(uv));
}

// One of the five textures: its uv set through its affine transform.
vec4 sample_texture(sampler2D image, uint slot, TextureCoordinates at)
{
    bool second = (material.uv_sets >> slot & 1u) != 0u;
    vec3 row0 = material.uv_rows[2u * slot];
    vec3 row1 = material.uv_rows[2u * slot + 1u];
    mat2 linear = transpose(mat2(row0.xy, row1.xy));
    vec2 uv = linear * (second ? at.uv.zw : at.uv.xy) + vec2(row0.z, row1.z);
    vec2 dx = linear * (second ? at.dx.zw : at.dx.xy);
    vec2 dy = linear * (second ? at.dy.zw : at.dy.xy);
    return textureGrad(image, uv, dx, dy);
}

// A texture that a material lacks is white: only those of TEXTURES are sampled, whose number is most of what shading costs
// where lights are few.
vec4 base_color(TextureCoordinates at, vec4 color)
{
    vec4 base = material.base_color * color;
#if HAS_TEXTURE(BASE_COLOR)
    base *= sample_texture(base_color_texture, BASE_COLOR, at);
#endif
#if MATERIAL == MATERIAL_WHITE
    base.rgb = vec3(1.0);
#endif
    return base;
}

// Metalness, perceptual roughness.
vec2 metallic_roughness(TextureCoordinates at)
{
    vec2 factors = vec2(material.metallic, material.roughness);
#if HAS_TEXTURE(METALLIC_ROUGHNESS)
    factors *= sample_texture(metallic_roughness_texture, METALLIC_ROUGHNESS, at).bg;
#endif
    return factors;
}

// 1 where nothing is occluded.
float occlusion(TextureCoordinates at)
{
#if HAS_TEXTURE(OCCLUSION)
    return mix(1.0, sample_texture(occlusion_texture, OCCLUSION, at).r, material.occlusion_strength);
#else
    return 1.0;
#endif
}

vec3 emissive(TextureCoordinates at)
{
    vec3 radiance = material.emissive;
#if HAS_TEXTURE(EMISSIVE)
    radiance *= sample_texture(emissive_texture, EMISSIVE, at).rgb;
#endif
    return radiance;
}

// A faint even light, so that occlusion maps and places that no light reaches can be seen.
const float AMBIENT = 0.02;

// Radiance of a surface of a linear base colour whatever lights there are. One that is unlit shows its base colour.
vec3 radiance_without_lights(TextureCoordinates at, vec3 base)
{
#if MATERIAL == MATERIAL_WHITE
    vec3 radiance = vec3(WHITE_AMBIENT);
#else
    vec3 radiance = AMBIENT * base * occlusion(at) + emissive(at);
#endif
    return material.unlit != 0u ? base : radiance;
}
