// Lights as spheres in the clustering camera's space: (centre, radius). The radius grows by the slack that covers rounding,
// so that a light is never lost at a cell's boundary.
#pragma once

#include "generated/gpu_interface.glsl"

// The same bits wherever it is called: all ways of assignment test the same numbers.
vec4 sphere_of_light(uint light)
{
    LightData place = read_light(light);
    precise vec3 centre = (grid.clustering_from_world * vec4(place.position, 1.0)).xyz;
    precise float radius = place.r1 + max(grid.slack, grid.slack_per_radius * place.r1);
    return vec4(centre, radius);
}
