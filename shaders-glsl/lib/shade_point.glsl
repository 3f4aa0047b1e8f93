// The one shading loop: the sum over the lights that a lookup names.
#pragma once

#extension GL_EXT_control_flow_attributes : require

#include "lib/brdf.glsl"
#include "lib/counters.glsl"
#include "lib/light.glsl"

// Lights that are evaluated in one turn of the loop.
const uint AT_ONCE = LIGHTS_AT_ONCE;

// Evaluates one light; true where it reaches the surface.
bool shade_light(LightData light, Surface surface, inout vec3 radiance)
{
    vec3 offset = light.position - surface.position;
    float distance = length(offset);
    if (distance >= light.r1)
        return false;
    radiance += reflected(surface, offset / max(distance, 1e-6)) * light.tint * attenuation(light, distance);
    return true;
}

vec3 shade_lights(Surface surface, LightCursor cursor)
{
    vec3 radiance = vec3(0.0);
    uint evaluated = 0u, needed = 0u;
    for (uint position = cursor.next; position < cursor.end; position += AT_ONCE) {
        [[unroll]] for (uint i = 0u; i < AT_ONCE; ++i) {
            if (position + i < cursor.end) {
                ++evaluated;
                needed += uint(shade_light(read_light(light_at(position + i)), surface, radiance));
            }
        }
    }
    count(COUNTER_FRAGMENTS_SHADED, 1u);
    count(COUNTER_LIGHTING_COMPUTATIONS, evaluated);
    count(COUNTER_NEEDED_COMPUTATIONS, needed);
#if COUNTERS
    atomicAdd(lights_per_fragment[cursor.end - cursor.next], 1u);
#endif
    return radiance;
}
