// How much the depth of a view jumps from pixel to pixel: between each pixel and those right of it and below it, where both show
// something (in their first samples with MSAA), by how many octaves their distances differ.
#version 460
#include "lib/sample_positions.glsl"
#include "lib/view_position.glsl"
#include "lib/counters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// log2 of a normal number in parts of 65536, rounded down. It is found by squaring what is left, in integers: log2 itself
// may differ from device to device.
int log2_parts(float number)
{
    uint bits = floatBitsToUint(number);
    int result = int(bits >> 23) - 127;
    // 1 to 2, with 31 bits behind the point.
    uint rest = (bits | 0x800000u) << 8;
    for (uint bit = 0u; bit < 16u; ++bit) {
        uint high, low;
        umulExtended(rest, rest, high, low);
        uint doubles = high >> 31;
        result = 2 * result + int(doubles);
        rest = doubles == 1u ? high : high << 1 | low >> 31;
    }
    return result;
}

// Along the view's -Z, metres; 0 where nothing is seen.
float distance_of(ViewData view, uvec2 pixel)
{
    if (any(greaterThanEqual(pixel, view.resolution)))
        return 0.0;
    float depth = stored_depth(ivec2(pixel), 0);
    return depth > 0.0 ? -view_position(view, vec2(pixel) + sample_position(0), depth).z : 0.0;
}

void main()
{
    ViewData view = views[push.view];
    uvec2 pixel = gl_GlobalInvocationID.xy;
    float here = distance_of(view, pixel);
    if (here <= 0.0)
        return;
    int own = log2_parts(here);
    uint steps = 0u;
    uint pairs = 0u;
    for (uint axis = 0u; axis < 2u; ++axis) {
        float next = distance_of(view, pixel + uvec2(1u - axis, axis));
        if (next > 0.0) {
            steps += uint(abs(log2_parts(next) - own));
            ++pairs;
        }
    }
    count(COUNTER_DEPTH_STEPS, steps);
    count(COUNTER_DEPTH_PAIRS, pairs);
}
