// Point and spot lights and their attenuation (Gelderen appendix A, Tegelaers section 3.1). ATTENUATION is the position in the table of the host's enum.
#pragma once

#include "generated/gpu_interface.glsl"

layout(constant_id = 0) const uint ATTENUATION = ATTENUATION_PHY_RED_2;

// a(d) as the table has it, for R0 <= d <= R1.
float table_attenuation(LightData light, float d)
{
    float inverse_square = light.intensity / (d * d);
    float x = d / light.r1;
    switch (ATTENUATION) {
    case ATTENUATION_PHY: return inverse_square;
    case ATTENUATION_RED: return inverse_square - light.cutoff;
    case ATTENUATION_SMO: return inverse_square + light.cutoff * (2.0 * x - 3.0);
    case ATTENUATION_PHY_RED_1: return inverse_square - light.cutoff * x;
    case ATTENUATION_PHY_RED_2: return inverse_square - light.cutoff * x * x;
    case ATTENUATION_PHY_SMO_1: return inverse_square + light.cutoff * x * (2.0 * x - 3.0);
    case ATTENUATION_PHY_SMO_2: return inverse_square + light.cutoff * x * x * (2.0 * x - 3.0);
    case ATTENUATION_LIN: return light.intensity * (1.0 - x);
    case ATTENUATION_TEGELAERS: return (1.0 - x) * (1.0 - x);
    default: return light.intensity;
    }
}

// Beyond R1 there is no light, nor is there less than none where an R1 of the light's own reaches past sqrt(I/I0).
float attenuation(LightData light, float distance)
{
    return distance < light.r1 ? max(table_attenuation(light, min(max(distance, light.r0), light.r1)), 0.0) : 0.0;
}

#if SPOTS
// The part of a light that goes through its cone towards a point from which the light lies in direction `towards_light`, a unit
// vector (KHR_lights_punctual).
float cone_part(SpotData spot, vec3 towards_light)
{
    float part = clamp(spot.offset - spot.scale * dot(spot.axis, towards_light), 0.0, 1.0);
    return part * part;
}
#endif
