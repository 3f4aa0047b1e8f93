// The one shading loop: the sum over the lights that a lookup names.
#pragma once

#extension GL_EXT_control_flow_attributes : require

#include "lib/brdf.glsl"
#include "lib/counters.glsl"
#include "lib/light.glsl"

// Lights that are evaluated in one turn of the loop.
const uint AT_ONCE = LIGHTS_AT_ONCE;

// Evaluates one light; true where it reaches the surface. What is known to be a point has no cone that would be asked.
bool shade_light(uint index, bool may_be_spot, Surface surface, inout vec3 radiance)
{
    LightData light = read_light(index);
    vec3 offset = light.position - surface.position;
    float distance = length(offset);
    if (distance >= light.r1)
        return false;
    vec3 towards_light = offset / max(distance, 1e-6);
    float fading = attenuation(light, distance);
#if SPOTS
    if (may_be_spot) {
        float part = cone_part(read_spot(index), towards_light);
        if (part <= 0.0)
            return false;
        fading *= part;
    }
#endif
    radiance += reflected(surface, towards_light) * light.tint * fading;
    return true;
}

// How many lights were evaluated, and how many of them reach the surface.
struct Evaluated {
    uint lights, needed;
};

#if LISTS == LISTS_LINKED

#if SPOTS
// Whether a node has a spot: its word tells where that has room for the kind, else the light.
bool is_spot(ListNode node)
{
#if NODE_WORDS == 2
    return node.light < KIND_OF_POINT;
#else
    return read_spot(node.light).cosine >= 0.0;
#endif
}
#endif

// Spots, then points, which lists have in this order, so that neither loop branches by kind (Örtegren and Persson section 4.5).
Evaluated shade_all(Surface surface, LightCursor cursor, inout vec3 radiance)
{
    Evaluated evaluated = Evaluated(0u, 0u);
    uint node = cursor.next;
#if SPOTS
    while (node != cursor.end) {
        ListNode spot = list_node(node);
        if (!is_spot(spot))
            break;
        ++evaluated.lights;
        evaluated.needed += uint(shade_light(spot.light, true, surface, radiance));
        node = spot.next;
    }
#endif
    while (node != cursor.end) {
        ListNode point = list_node(node);
        ++evaluated.lights;
        evaluated.needed += uint(shade_light(point.light & LIGHT_OF_NODE, false, surface, radiance));
        node = point.next;
    }
    return evaluated;
}

#else

Evaluated shade_all(Surface surface, LightCursor cursor, inout vec3 radiance)
{
    Evaluated evaluated = Evaluated(0u, 0u);
    for (uint position = cursor.next; position < cursor.end; position += AT_ONCE) {
        [[unroll]] for (uint i = 0u; i < AT_ONCE; ++i) {
            if (position + i < cursor.end) {
                ++evaluated.lights;
                evaluated.needed += uint(shade_light(light_at(position + i), true, surface, radiance));
            }
        }
    }
    return evaluated;
}

#endif

vec3 shade_lights(Surface surface, LightCursor cursor)
{
    vec3 radiance = vec3(0.0);
    Evaluated evaluated = shade_all(surface, cursor, radiance);
    count(COUNTER_FRAGMENTS_SHADED, 1u);
    count(COUNTER_LIGHTING_COMPUTATIONS, evaluated.lights);
    count(COUNTER_NEEDED_COMPUTATIONS, evaluated.needed);
#if COUNTERS
    atomicAdd(lights_per_fragment[evaluated.lights], 1u);
#endif
    return radiance;
}
