// Forward shading of one surface kind through one lookup.
#version 460
#include "lib/fragment_position.glsl"
#include "lib/material.glsl"
#include "lookup/$LOOKUP.glsl"
#include "lib/cluster_space.glsl"
#include "lib/shade_point.glsl"

// Depth is laid down by the prepass, and the counters must not see hidden fragments. What passes the test for equal
// depth has passed the alpha test there; a second alpha test could decide otherwise in the last bit and leave a hole.
layout(early_fragment_tests) in;

#if TEXTURES != 0
layout(location = 0) in vec4 uv;
#else
const vec4 uv = vec4(0.0);
#endif
layout(location = 1) in vec4 color;
layout(location = 2) in vec3 normal;
#if HAS_TEXTURE(NORMAL)
layout(location = 3) in vec4 tangent;
#endif
#if VIEWS
layout(location = 4) flat in uint view_index;
#endif

layout(location = 0) out vec4 out_color;

// A faint even light, so that occlusion maps and places that no light reaches can be seen.
const float AMBIENT = 0.02;
// Shown where a fragment's cluster is missing (Gelderen figure 5.1).
const vec3 MISSING_CLUSTER = vec3(1.0, 0.0, 1.0);

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

Surface surface_at(TextureCoordinates at, ViewData view, vec3 base)
{
    vec3 position = (view.world_from_view * vec4(view_position(view, fragment_pixel(), gl_FragCoord.z), 1.0)).xyz;
    vec2 factors = metallic_roughness(at);
    float metallic = clamp(factors.x, 0.0, 1.0);
    float roughness = clamp(factors.y, 0.05, 1.0);
    return Surface(position, shading_normal(at), normalize(view.world_from_view[3].xyz - position),
                   base * (1.0 - metallic), mix(vec3(0.04), base, metallic), roughness * roughness);
}

void main()
{
    TextureCoordinates at = texture_coordinates(uv);
    if (is_background())
        discard;
    ViewData view = views[view_of_fragment()];
    vec4 base = base_color(at, color);
    LightCursor cursor;
    if (!find_lights(view, fragment_pixel(), gl_FragCoord.z, cursor)) {
        count(COUNTER_FRAGMENTS_SHADED, 1u);
        count(COUNTER_FRAGMENTS_WITHOUT_CLUSTER, 1u);
        out_color = vec4(MISSING_CLUSTER, 1.0);
        return;
    }
    // What is unlit is shaded by no light. A branch around the loop would leave its lanes parted: llvmpipe then takes five
    // times as long for every light of every surface.
    bool unlit = material.unlit != 0u;
    if (unlit)
        cursor.end = cursor.next;
    vec3 radiance = AMBIENT * base.rgb * occlusion(at) + emissive(at);
    radiance += shade_lights(surface_at(at, view, base.rgb), cursor);
    if (unlit)
        radiance = base.rgb;
    // Half floats end at 65504; a light grazed at R0 may exceed that.
    out_color = vec4(min(radiance, vec3(65504.0)), TRANSPARENT != 0 ? base.a : 1.0);
}
