// Lights as volumes in the clustering camera's space. The bounding sphere's radius grows by the slack that covers rounding,
// so that a light is never lost at a cell's boundary.
#pragma once

#include "generated/gpu_interface.glsl"

// What single precision may take off a cosine as shading has it, of an axis and a direction that are unit vectors but for rounding.
const float COSINE_ROUNDING = 5e-7;

// The same bits wherever it is called: all ways of assignment test the same numbers.
LightVolume volume_of_light(uint light)
{
    LightData place = read_light(light);
#if SPOTS
    SpotData spot = read_spot(light);
    precise vec3 middle = place.position + spot.along * spot.axis;
    float reach = spot.radius;
#else
    precise vec3 middle = place.position;
    float reach = place.r1;
#endif
    precise vec3 centre = (grid.clustering_from_world * vec4(middle, 1.0)).xyz;
    precise float radius = reach + max(grid.slack, grid.slack_per_radius * reach);
    LightVolume volume;
    volume.centre = centre;
    volume.radius = radius;
    volume.kind = place.kind;
    volume.light = light;
    return volume;
}

// (centre, radius) of the sphere that holds all of the volume.
vec4 bounding_sphere(LightVolume volume)
{
    return vec4(volume.centre, volume.radius);
}
