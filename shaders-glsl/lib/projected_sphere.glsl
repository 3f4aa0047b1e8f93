// The rectangle of tangents in which a light is seen, of what it has from the near plane on (Mara and McGuire; see
// geometry/projected_sphere.rs): (least x, least y, greatest x, greatest y).
//
// The slack of the radius covers rounding of places, ROUNDING what is lost between there and here, as an angle.
#pragma once

#include "generated/gpu_interface.glsl"

const float SEEN_ROUNDING = 1e-6;
const float BEYOND_ALL = 3e38;

// The least and the greatest tangent across one axis.
vec2 tangents_across(float across, float depth, float radius)
{
    const vec2 sides = vec2(-1.0, 1.0);
    precise float before = grid.near - depth;
    precise float half_chord = sqrt(max((radius - before) * (radius + before), 0.0));
    precise vec2 ends = (across + sides * half_chord) / grid.near;
    precise float leg = sqrt(max(across * across + (depth - radius) * (depth + radius), 0.0));
    precise vec2 touched = leg * depth - sides * (radius * across);
    precise vec2 touching = (leg * across + sides * (radius * depth)) / touched;
    precise float touch_near = grid.near * (across * across + depth * depth);
    bvec2 touches = greaterThanEqual(leg * touched, vec2(touch_near));
    precise vec2 tangents = mix(ends, touching, bvec2(touches.x && leg > 0.0, touches.y && leg > 0.0));
    precise vec2 widened = tangents + sides * SEEN_ROUNDING * (1.0 + tangents * tangents);
    return widened;
}

// Where all of a light lies before the near plane, a rectangle that meets nothing.
vec4 seen_rectangle(vec4 sphere)
{
    if (sphere.w - sphere.z < grid.near)
        return vec4(BEYOND_ALL, BEYOND_ALL, -BEYOND_ALL, -BEYOND_ALL);
    vec2 x = tangents_across(sphere.x, -sphere.z, sphere.w);
    vec2 y = tangents_across(sphere.y, -sphere.z, sphere.w);
    return vec4(x.x, y.x, x.y, y.y);
}
