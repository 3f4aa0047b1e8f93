// The influence volumes of the lights: an instance a light, a sphere of rings and segments each.
#version 460
#include "lib/light.glsl"
#include "lib/mirror.glsl"

layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec3 out_towards_camera;
layout(location = 2) flat out vec3 out_tint;

// Which corner of its quad each of six vertices is: counter-clockwise seen from outside.
const uvec2 CORNERS[6] = uvec2[](uvec2(0, 0), uvec2(0, 1), uvec2(1, 1), uvec2(0, 0), uvec2(1, 1), uvec2(1, 0));

void main()
{
    uint quad = gl_VertexIndex / 6;
    uvec2 corner = CORNERS[gl_VertexIndex % 6] + uvec2(quad % SPHERE_SEGMENTS, quad / SPHERE_SEGMENTS);
    float longitude = radians(360.0) * float(corner.x) / float(SPHERE_SEGMENTS);
    float colatitude = radians(180.0) * float(corner.y) / float(SPHERE_RINGS);
    vec3 normal = vec3(sin(colatitude) * sin(longitude), cos(colatitude), sin(colatitude) * cos(longitude));
    ViewData view = views[push.view];
    LightData light = read_light(gl_InstanceIndex);
    vec3 position = light.position + light.r1 * normal;
    out_normal = normal;
    out_towards_camera = view.world_from_view[3].xyz - position;
    out_tint = light.tint;
    gl_Position = view.clip_from_world * vec4(position, 1.0);
    clip_behind_mirror(push.view, position);
}
