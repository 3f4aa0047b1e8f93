// A light's influence volume: a bubble in the light's colour, denser towards its rim.
#version 460

layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 towards_camera;
layout(location = 2) flat in vec3 tint;
layout(location = 0) out vec4 out_color;

void main()
{
    float rim = 1.0 - abs(dot(normalize(normal), normalize(towards_camera)));
    out_color = vec4(tint, 0.08 + 0.4 * rim * rim * rim);
}
