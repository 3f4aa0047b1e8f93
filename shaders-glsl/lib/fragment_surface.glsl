// The surface of the running fragment, from what the rasteriser hands over and its material. TEXTURES and VIEWS decide what
// that is, as in geometry/surface.vert.
#pragma once

#include "lib/fragment_position.glsl"
#include "lib/material.glsl"
#include "lib/surface.glsl"
#include "lib/surface_inputs.glsl"
#include "lib/view_position.glsl"

layout(location = 2) in vec3 normal;
#if HAS_TEXTURE(NORMAL)
layout(location = 3) in vec4 tangent;
#endif
#if VIEWS
layout(location = 4) flat in uint view_index;
#endif

// The view that the fragment is of. Where it is pushed, all fragments read the same memory at once.
uint view_of_fragment()
{
#if VIEWS
    return view_index;
#else
    return push.view;
#endif
}

vec3 shading_normal(TextureCoordinates at)
{
    float facing = gl_FrontFacing ? 1.0 : -1.0;
    vec3 n = normalize(normal);
#if HAS_TEXTURE(NORMAL)
    vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
    vec3 mapped = sample_texture(normal_texture, NORMAL, at).xyz * 2.0 - 1.0;
    mapped.xy *= material.normal_scale;
    if (dot(t, t) >= 1e-12) {
        t = normalize(t);
        vec3 b = cross(n, t) * sign(tangent.w);
        n = normalize(t * mapped.x + b * mapped.y + n * mapped.z);
    }
#endif
    return facing * n;
}

Surface fragment_surface(TextureCoordinates at, ViewData view, vec3 base)
{
    vec3 position = world_position(view, fragment_pixel(), gl_FragCoord.z);
    return surface_seen(position, view.world_from_view[3].xyz, shading_normal(at), base, metallic_roughness(at));
}
