// Per pixel of the prepass: distance, and list length, fragments and index of its cluster where that is marked.
//
// WORLD_LOOKUP 0: the camera is one of the clustering's own views, so the cluster is the one that shading finds.
// WORLD_LOOKUP 1: the camera only looks; the cluster is found by world position, and there may be none.
#version 460
#include "lib/sample_positions.glsl"
#include "lookup/$LOOKUP.glsl"
#include "lib/cluster_space.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uint group_at(ViewData view, vec2 location, float depth)
{
#if WORLD_LOOKUP
    return group_seen(view, location, depth);
#else
    return group_of_sample(view, location, depth);
#endif
}

void main()
{
    ViewData view = views[push.view];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, view.resolution)))
        return;
    float depth = stored_depth(ivec2(pixel), 0);
    vec2 location = vec2(pixel) + sample_position(0);
    PixelData result = PixelData(uintBitsToFloat(0x7F800000u), 0u, 0u, NO_GROUP);
    if (depth > 0.0) {
        result.distance = -view_position(view, location, depth).z;
        uint group = group_at(view, location, depth);
        LightCursor cursor;
        if (group != NO_GROUP && list_of_group(group, cursor)) {
            result.light_count = length_of(cursor);
            result.fragment_count = fragments_of_group(group);
            result.cluster_index = group;
        }
    }
    pixels[pixel.y * view.resolution.x + pixel.x] = result;
}
