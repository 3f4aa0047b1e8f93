// Texture coordinates and vertex colour of the running fragment, as the rasteriser hands them over. TEXTURES decides what there
// is, as in geometry/surface.vert.
#pragma once

#if TEXTURES != 0
layout(location = 0) in vec4 uv;
#else
const vec4 uv = vec4(0.0);
#endif
layout(location = 1) in vec4 color;

// The same at the centre of the pixel, also where fragments run for each sample.
vec4 uv_of_pixel()
{
#if PER_SAMPLE && TEXTURES != 0
    return interpolateAtOffset(uv, vec2(0.0));
#else
    return uv;
#endif
}

vec4 color_of_pixel()
{
#if PER_SAMPLE
    return interpolateAtOffset(color, vec2(0.0));
#else
    return color;
#endif
}
