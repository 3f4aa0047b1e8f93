// Where in its pixel a sample lies, and reading the stored depth of one.
#pragma once

#include "generated/gpu_interface.glsl"

#if SAMPLES == 1

layout(set = SET_TARGETS, binding = 0) uniform texture2D depth_image;

vec2 sample_position(int index) { return vec2(0.5); }
float stored_depth(ivec2 pixel, int index) { return texelFetch(depth_image, pixel, 0).r; }

#else

layout(set = SET_TARGETS, binding = 0) uniform texture2DMS depth_image;

// The standard locations of four samples (Vulkan specification, table of standard sample locations).
const vec2 SAMPLE_POSITIONS[4] = vec2[](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));

vec2 sample_position(int index) { return SAMPLE_POSITIONS[index]; }
float stored_depth(ivec2 pixel, int index) { return texelFetch(depth_image, pixel, index).r; }

#endif
