// A surface as the shading loop takes it, whatever hands it over: the rasteriser (lib/fragment_surface.glsl), or images
// that hold what it is made from.
#pragma once

struct Surface {
    vec3 position;  // world
    vec3 normal;    // world, unit, on the viewer's side
    vec3 to_viewer; // world, unit
    vec3 diffuse;   // base colour of the dielectric part
    vec3 f0;        // reflectance at normal incidence
    float alpha;    // squared perceptual roughness
};

// No surface is smoother.
const float LEAST_ROUGHNESS = 0.05;

// The surface at `position` seen from `eye`, both in the world, of a linear base colour; `factors` are metalness and
// perceptual roughness.
Surface surface_seen(vec3 position, vec3 eye, vec3 normal, vec3 base, vec2 factors)
{
    float metallic = clamp(factors.x, 0.0, 1.0);
    float roughness = clamp(factors.y, LEAST_ROUGHNESS, 1.0);
    return Surface(position, normal, normalize(eye - position), base * (1.0 - metallic),
                   mix(vec3(0.04), base, metallic), roughness * roughness);
}
