// Per pixel of the prepass: distance, list length, fragments and index of its cluster (first sample with MSAA).
#version 460
#include "lib/sample_positions.glsl"
#include "lookup/$LOOKUP.glsl"
#include "lib/cluster_space.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

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
        LightCursor cursor;
        find_lights(view, location, depth, cursor);
        result.distance = -view_position(view, location, depth).z;
        result.light_count = length_of(cursor);
        result.cluster_index = group_of_sample(view, location, depth);
        result.fragment_count = fragments_of_group(result.cluster_index);
    }
    pixels[pixel.y * view.resolution.x + pixel.x] = result;
}
