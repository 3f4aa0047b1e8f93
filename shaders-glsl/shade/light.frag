// Deferred shading of what the G-buffer holds, through one lookup: what lights add to what surfaces radiate without any.
#version 460
#include "lib/fragment_position.glsl"
#include "lib/gbuffer.glsl"
#include "lib/radiance.glsl"
#include "lib/surface.glsl"
#include "lib/view_position.glsl"
#include "lookup/$LOOKUP.glsl"
#include "lib/shade_point.glsl"

// Where nothing is seen there is nothing to shade, nor to count.
layout(early_fragment_tests) in;

layout(location = 0) out vec4 out_color;

void main()
{
    ViewData view = views[push.view];
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = stored_depth(pixel, own_sample());
    LightCursor cursor;
    if (!find_lights(view, fragment_pixel(), depth, cursor)) {
        count(COUNTER_FRAGMENTS_SHADED, 1u);
        count(COUNTER_FRAGMENTS_WITHOUT_CLUSTER, 1u);
        out_color = vec4(MISSING_CLUSTER, 0.0);
        return;
    }
    StoredSurface stored = stored_surface(pixel);
    // As in shade/forward.frag, what is unlit walks an empty list.
    if (stored.roughness == 0.0)
        cursor.end = cursor.next;
    vec3 position = world_position(view, fragment_pixel(), depth);
    Surface surface = surface_seen(position, view.world_from_view[3].xyz, stored.normal, stored.base,
                                   vec2(stored.metallic, stored.roughness));
    out_color = vec4(min(shade_lights(surface, cursor), vec3(MOST_PART)), 0.0);
}
