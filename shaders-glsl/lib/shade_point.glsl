// The one shading loop: the sum over the lights that a lookup names.
#pragma once

#extension GL_EXT_control_flow_attributes : require

#include "lib/brdf.glsl"
#include "lib/counters.glsl"
#include "lib/light.glsl"

// Lights that are evaluated in one turn of the loop.
const uint AT_ONCE = LIGHTS_AT_ONCE;

// Evaluates one light; true where it reaches the surface.
bool shade_light(uint index, Surface surface, inout vec3 radiance)
{
    LightData light = read_light(index);
    vec3 offset = light.position - surface.position;
    float distance = length(offset);
    if (distance >= light.r1)
        return false;
    vec3 towards_light = offset / max(distance, 1e-6);
    float fading = attenuation(light, distance);
#if SPOTS
    float part = cone_part(read_spot(index), towards_light);
    if (part <= 0.0)
        return false;
    fading *= part;
#endif
    radiance += reflected(surface, towards_light) * light.tint * fading;
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
                needed += uint(shade_light(light_at(position + i), surface, radiance));
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
