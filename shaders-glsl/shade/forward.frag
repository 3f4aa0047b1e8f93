// Forward shading of one surface kind through one lookup.
//
// OVERDRAW: 0 where the prepass has laid down depth, or surfaces are transparent: what passes the depth test is seen. 1 where
// depth is laid down here, so that what is shaded may be hidden in the end.
// ALPHA_TEST: 1 for masked surfaces that no prepass has tested.
#version 460
#include "lib/fragment_surface.glsl"
#include "lib/radiance.glsl"
#include "lookup/$LOOKUP.glsl"
#include "lib/shade_point.glsl"

// The counters must not see fragments that fail the depth test. After a prepass, what passes the test for equal depth has
// passed the alpha test there; a second alpha test could decide otherwise in the last bit and leave a hole. Without one, what
// is cut out must leave no depth: it is tested first, but where fragments are counted, which writes none.
#if ALPHA_TEST
#include "lib/alpha_test.glsl"
#endif
#if !ALPHA_TEST || COUNTERS
layout(early_fragment_tests) in;
#endif

layout(location = 0) out vec4 out_color;

void main()
{
    TextureCoordinates at = texture_coordinates(uv);
#if ALPHA_TEST
    if (is_cut_out(uv_of_pixel(), color_of_pixel()))
        discard;
#endif
    if (is_background())
        discard;
    ViewData view = views[view_of_fragment()];
    vec4 base = base_color(at, color);
    LightCursor cursor;
    bool found = find_lights(view, fragment_pixel(), gl_FragCoord.z, cursor);
#if OVERDRAW
    // A group that is missing has an empty list. Once all is drawn, measure/seen.frag tells what is seen, and whether of that any
    // group is missing.
    count(COUNTER_FRAGMENTS_HIDDEN, 1u);
#else
    if (!found) {
        count(COUNTER_FRAGMENTS_SHADED, 1u);
        count(COUNTER_FRAGMENTS_WITHOUT_CLUSTER, 1u);
        out_color = vec4(MISSING_CLUSTER, 1.0);
        return;
    }
#endif
    // What is unlit is shaded by no light. A branch around the loop would leave its lanes parted: llvmpipe then takes five
    // times as long for every light of every surface.
    if (material.unlit != 0u)
        cursor.end = cursor.next;
    vec3 radiance = radiance_without_lights(at, base.rgb);
    radiance += shade_lights(fragment_surface(at, view, base.rgb), cursor);
    out_color = vec4(min(radiance, vec3(MOST_RADIANCE)), TRANSPARENT != 0 ? base.a : 1.0);
}
