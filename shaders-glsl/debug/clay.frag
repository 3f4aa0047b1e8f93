// Surfaces under a lamp at the camera and a pale sky: what stills show where nothing is shaded. Alpha is the light.
#version 460
#include "lib/cluster_space.glsl"
#include "lib/material.glsl"

layout(early_fragment_tests) in;

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 color;
layout(location = 2) in vec3 normal;

layout(location = 0) out vec4 out_color;

void main()
{
    TextureCoordinates at = texture_coordinates(uv);
    ViewData view = views[push.view];
    vec3 towards_camera = -normalize(view_position(view, gl_FragCoord.xy, gl_FragCoord.z));
    vec3 n = normalize(normal);
    float lamp = abs(dot(n, mat3(view.world_from_view) * towards_camera));
    float light = 0.25 + 0.45 * lamp + 0.3 * (0.5 + 0.5 * n.y);
    out_color = vec4(base_color(at, color).rgb * light, light);
}
