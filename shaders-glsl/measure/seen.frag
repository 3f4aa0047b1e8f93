// With overdraw, once all is drawn: the fragments that are seen in the end, which shading has counted among those that may be
// hidden, and those of them whose group is missing.
#version 460
#include "lib/counters.glsl"
#include "lib/fragment_position.glsl"
#include "lookup/$LOOKUP.glsl"
#if ALPHA_TEST
#include "lib/alpha_test.glsl"
#include "lib/surface_inputs.glsl"
#endif

layout(early_fragment_tests) in;

void main()
{
#if ALPHA_TEST
    if (is_cut_out(uv_of_pixel(), color_of_pixel()))
        return;
#endif
    if (is_background())
        return;
    LightCursor cursor;
    bool found = find_lights(views[push.view], fragment_pixel(), gl_FragCoord.z, cursor);
    count_off(COUNTER_FRAGMENTS_HIDDEN, 1u);
    count(COUNTER_FRAGMENTS_WITHOUT_CLUSTER, uint(!found));
}
