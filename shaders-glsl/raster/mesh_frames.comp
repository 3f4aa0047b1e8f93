// The mesh around each light into the clustering camera's space, grown by the slack that covers rounding: that of a sphere about its
// centre, that of a spot about an apex moved back, so that its sides move out as far.
#version 460
#include "lib/light_volume.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

// What single precision may take of a template's sizes.
const float SIZE_ROUNDING = 2e-6;

vec3 turned(vec3 direction)
{
    return mat3(grid.clustering_from_world) * direction;
}

void main()
{
    uint light = gl_GlobalInvocationID.x;
    if (light >= grid.light_count)
        return;
    MeshFrame mesh = mesh_frames[light];
    LightData place = read_light(light);
    float slack = max(grid.slack, grid.slack_per_radius * place.r1);
    float back = 0.0;
    vec3 origin = mesh.origin;
#if SPOTS
    SpotData spot = read_spot(light);
    if (spot.cosine >= 0.0) {
        float sine = sqrt((1.0 - spot.cosine) * (1.0 + spot.cosine));
        slack += COSINE_ROUNDING * place.r1 / sine;
        back = slack / sine;
        origin -= back * spot.axis;
    }
#endif
    float growth = (1.0 + SIZE_ROUNDING) * (place.r1 + slack + back) / place.r1;
    light_frames[light] = MeshFrame((grid.clustering_from_world * vec4(origin, 1.0)).xyz, growth * turned(mesh.x),
                                    growth * turned(mesh.y), growth * turned(mesh.z), growth * turned(mesh.tip));
}
