// The influence volumes of the lights: an instance a light, a sphere of rings and segments each. Of a spot's sector the upper half of
// the rings makes the cap, the lower one the side.
#version 460
#include "lib/light.glsl"
#include "lib/mirror.glsl"

layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec3 out_towards_camera;
layout(location = 2) flat out vec3 out_tint;

// Which corner of its quad each of six vertices is: counter-clockwise seen from outside.
const uvec2 CORNERS[6] = uvec2[](uvec2(0, 0), uvec2(0, 1), uvec2(1, 1), uvec2(0, 0), uvec2(1, 1), uvec2(1, 0));

vec3 on_sphere(float colatitude, float longitude)
{
    return vec3(sin(colatitude) * sin(longitude), cos(colatitude), sin(colatitude) * cos(longitude));
}

#if SPOTS
// A point of the surface of a sector of unit radius, `down` from the middle of its cap (0) to its apex (1), and the normal there.
vec3 on_sector(SpotData spot, float down, float longitude, out vec3 normal)
{
    vec3 helper = abs(spot.axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 across = normalize(cross(helper, spot.axis));
    mat3 frame = mat3(cross(spot.axis, across), spot.axis, across);
    float outer = acos(spot.cosine);
    vec3 ray = frame * on_sphere(outer * min(2.0 * down, 1.0), longitude);
    bool cap = down < 0.5;
    normal = cap ? ray : frame * on_sphere(outer + radians(90.0), longitude);
    return cap ? ray : (2.0 - 2.0 * down) * ray;
}
#endif

void main()
{
    uint quad = gl_VertexIndex / 6;
    uvec2 corner = CORNERS[gl_VertexIndex % 6] + uvec2(quad % SPHERE_SEGMENTS, quad / SPHERE_SEGMENTS);
    float longitude = radians(360.0) * float(corner.x) / float(SPHERE_SEGMENTS);
    float colatitude = radians(180.0) * float(corner.y) / float(SPHERE_RINGS);
    vec3 normal = on_sphere(colatitude, longitude);
    ViewData view = views[push.view];
    LightData light = read_light(gl_InstanceIndex);
    vec3 position = light.position + light.r1 * normal;
#if SPOTS
    SpotData spot = read_spot(gl_InstanceIndex);
    if (spot.cosine >= 0.0)
        position = light.position + light.r1 * on_sector(spot, float(corner.y) / float(SPHERE_RINGS), longitude, normal);
#endif
    out_normal = normal;
    out_towards_camera = view.world_from_view[3].xyz - position;
    out_tint = light.tint;
    gl_Position = view.clip_from_world * vec4(position, 1.0);
    clip_behind_mirror(push.view, position);
}
