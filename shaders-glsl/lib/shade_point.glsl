// The one shading loop: the sum over the lights that a lookup names.
#pragma once

#include "lib/brdf.glsl"
#include "lib/counters.glsl"
#include "lib/light.glsl"

vec3 shade_lights(Surface surface, LightCursor cursor)
{
    vec3 radiance = vec3(0.0);
    uint needed = 0u;
    for (uint position = cursor.next; position < cursor.end; ++position) {
        LightData light = lights[light_at(position)];
        vec3 offset = light.position - surface.position;
        float distance = length(offset);
        if (distance >= light.r1)
            continue;
        ++needed;
        radiance += reflected(surface, offset / max(distance, 1e-6)) * light.tint * attenuation(light, distance);
    }
    count(COUNTER_FRAGMENTS_SHADED, 1u);
    count(COUNTER_LIGHTING_COMPUTATIONS, cursor.end - cursor.next);
    count(COUNTER_NEEDED_COMPUTATIONS, needed);
#if COUNTERS
    atomicAdd(lights_per_fragment[cursor.end - cursor.next], 1u);
#endif
    return radiance;
}
