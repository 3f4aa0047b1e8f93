// Reading the G-buffer (see shade/gbuffer.frag) of a pixel's sample.
#pragma once

#include "generated/gpu_interface.glsl"
#include "lib/octahedron.glsl"

#if SAMPLES == 1
#define TARGET_TEXTURE texture2D
#define TARGET_UINT_TEXTURE utexture2D
#else
#define TARGET_TEXTURE texture2DMS
#define TARGET_UINT_TEXTURE utexture2DMS
#endif

layout(set = SET_TARGETS, binding = TARGET_BASE_COLOR) uniform TARGET_TEXTURE base_color_image;
layout(set = SET_TARGETS, binding = TARGET_NORMAL) uniform TARGET_TEXTURE normal_image;
layout(set = SET_TARGETS, binding = TARGET_ROUGHNESS) uniform TARGET_TEXTURE roughness_image;
layout(set = SET_TARGETS, binding = TARGET_MODEL) uniform TARGET_UINT_TEXTURE model_image;

// What is kept of a surface.
struct StoredSurface {
    vec3 base;       // linear base colour
    float metallic;
    vec3 normal;     // world, unit
    float roughness; // perceptual; 0 where the surface is unlit
};

// The sample that the running fragment is for. With one sample a pixel it is the level of a mip map, the only one.
int own_sample()
{
#if SAMPLES == 1
    return 0;
#else
    return gl_SampleID;
#endif
}

StoredSurface stored_surface(ivec2 pixel)
{
    vec4 base = texelFetch(base_color_image, pixel, own_sample());
    vec2 normal = texelFetch(normal_image, pixel, own_sample()).rg;
    float roughness = texelFetch(roughness_image, pixel, own_sample()).r;
    return StoredSurface(base.rgb, base.a, from_octahedron(normal), roughness);
}

// The index of the model that is seen, where groups are models.
uint stored_model(ivec2 pixel)
{
    return texelFetch(model_image, pixel, own_sample()).r;
}
