// Cook-Torrance: GGX distribution, Smith-Schlick geometry, Fresnel-Schlick; metallic-roughness parameters. Or, where MATERIAL
// says so, one white material.
#pragma once

#include "lib/surface.glsl"
#include "lib/white.glsl"

const float PI = 3.14159265358979;

// Outgoing radiance per incident irradiance times n.l, for unit `to_light`.
vec3 reflected(Surface surface, vec3 to_light)
{
    float n_l = dot(surface.normal, to_light);
    if (n_l <= 0.0)
        return vec3(0.0);
#if MATERIAL == MATERIAL_WHITE
    return vec3((1.0 - WHITE_AMBIENT) * n_l);
#else
    vec3 halfway = normalize(surface.to_viewer + to_light);
    float n_v = max(dot(surface.normal, surface.to_viewer), 1e-4);
    float n_h = clamp(dot(surface.normal, halfway), 0.0, 1.0);
    float v_h = clamp(dot(surface.to_viewer, halfway), 0.0, 1.0);

    float alpha2 = surface.alpha * surface.alpha;
    float denominator = n_h * n_h * (alpha2 - 1.0) + 1.0;
    float distribution = alpha2 / (PI * denominator * denominator);
    float k = 0.5 * surface.alpha;
    // Smith-Schlick divided by 4 n.l n.v, which cancels its numerator.
    float visibility = 0.25 / ((n_v * (1.0 - k) + k) * (n_l * (1.0 - k) + k));
    float grazing = 1.0 - v_h;
    float grazing2 = grazing * grazing;
    vec3 fresnel = surface.f0 + (1.0 - surface.f0) * (grazing2 * grazing2 * grazing);
    return ((1.0 - fresnel) * surface.diffuse / PI + distribution * visibility * fresnel) * n_l;
#endif
}
