// Keeps what deferred shading needs of one surface kind, and puts what the surface radiates without any light into the picture.
//
// OVERDRAW: 0 where the prepass has laid down depth, 1 where it is laid down here.
// ALPHA_TEST: 1 for masked surfaces that no prepass has tested.
// MODELS: 1 where groups are models.
#version 460
#include "lib/fragment_surface.glsl"
#include "lib/octahedron.glsl"
#include "lib/radiance.glsl"

#if ALPHA_TEST
#include "lib/alpha_test.glsl"
#else
layout(early_fragment_tests) in;
#endif

layout(location = 0) out vec4 out_radiance;
layout(location = 1) out vec4 out_base_color; // kept in sRGB; alpha is metalness
layout(location = 2) out vec2 out_normal;
layout(location = 3) out float out_roughness; // 0 where the surface is unlit
#if MODELS
#include "lib/model_of_fragment.glsl"
layout(location = 4) out uint out_model;
#endif

void main()
{
    TextureCoordinates at = texture_coordinates(uv);
#if ALPHA_TEST
    if (is_cut_out(uv_of_pixel(), color_of_pixel()))
        discard;
#endif
    if (is_background())
        discard;
    vec3 base = base_color(at, color).rgb;
    vec2 factors = metallic_roughness(at);
    out_radiance = vec4(min(radiance_without_lights(at, base), vec3(MOST_PART)), 1.0);
    out_base_color = vec4(base, factors.x);
    out_normal = to_octahedron(shading_normal(at));
    // No surface is smoother (lib/surface.glsl).
    out_roughness = material.unlit != 0u ? 0.0 : clamp(factors.y, LEAST_ROUGHNESS, 1.0);
#if MODELS
    out_model = model_of_fragment;
#endif
}
