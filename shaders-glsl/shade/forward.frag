// Forward shading of one surface kind through one lookup.
#version 460
#include "lib/fragment_surface.glsl"
#include "lookup/$LOOKUP.glsl"
#include "lib/shade_point.glsl"

// Depth is laid down by the prepass, and the counters must not see hidden fragments. What passes the test for equal
// depth has passed the alpha test there; a second alpha test could decide otherwise in the last bit and leave a hole.
layout(early_fragment_tests) in;

layout(location = 0) out vec4 out_color;

// A faint even light, so that occlusion maps and places that no light reaches can be seen.
const float AMBIENT = 0.02;
// Shown where a fragment's cluster is missing (Gelderen figure 5.1).
const vec3 MISSING_CLUSTER = vec3(1.0, 0.0, 1.0);

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
    radiance += shade_lights(fragment_surface(at, view, base.rgb), cursor);
    if (unlit)
        radiance = base.rgb;
    // Half floats end at 65504; a light grazed at R0 may exceed that.
    out_color = vec4(min(radiance, vec3(65504.0)), TRANSPARENT != 0 ? base.a : 1.0);
}
