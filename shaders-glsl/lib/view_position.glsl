// Where a sample of a view lies, from what the depth buffer holds of it. Every step is `precise`: whoever asks finds the same bits.
#pragma once

#include "generated/gpu_interface.glsl"

// View-space position of a sample. `pixel` counts from the top left, in pixels; `depth` is reversed (1 near, 0 far).
vec3 view_position(ViewData view, vec2 pixel, float depth)
{
    precise float distance = view.near * view.far / (clamp(depth, 0.0, 1.0) * (view.far - view.near) + view.near);
    precise vec2 screen = pixel / vec2(view.resolution);
    precise vec2 tangent = view.tangent_min + view.tangent_extent * vec2(screen.x, 1.0 - screen.y);
    precise vec3 position = vec3(tangent * distance, -distance);
    return position;
}

// The same in the world.
vec3 world_position(ViewData view, vec2 pixel, float depth)
{
    return (view.world_from_view * vec4(view_position(view, pixel, depth), 1.0)).xyz;
}
