// A world-space line as a quad of even width on the screen: an instance a line, six vertices each.
#version 460
#include "generated/gpu_interface.glsl"

layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec3 tint;
layout(location = 0) flat out vec3 out_tint;

// (End of the line, side) of each corner.
const vec2 CORNERS[6] = vec2[](vec2(0, -1), vec2(1, -1), vec2(1, 1), vec2(0, -1), vec2(1, 1), vec2(0, 1));
// Height of the picture over the width of a line, which is never below LEAST_WIDTH pixels.
const float HEIGHT_PER_WIDTH = 360.0;
const float LEAST_WIDTH = 1.5;

void main()
{
    ViewData view = views[push.view];
    vec4 a = view.clip_from_world * vec4(from, 1.0);
    vec4 b = view.clip_from_world * vec4(to, 1.0);
    out_tint = tint;
    // What lies behind the near plane has no place on the screen: cut there before the division.
    if (max(a.w, b.w) <= view.near) {
        gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
        return;
    }
    if (a.w < view.near)
        a = mix(a, b, (view.near - a.w) / (b.w - a.w));
    if (b.w < view.near)
        b = mix(b, a, (view.near - b.w) / (a.w - b.w));
    vec2 pixels_per_unit = 0.5 * vec2(view.resolution);
    vec2 along = (b.xy / b.w - a.xy / a.w) * pixels_per_unit;
    vec2 across = dot(along, along) > 0.0 ? normalize(vec2(-along.y, along.x)) : vec2(1.0, 0.0);
    float half_width = 0.5 * max(LEAST_WIDTH, float(view.resolution.y) / HEIGHT_PER_WIDTH);
    vec2 corner = CORNERS[gl_VertexIndex];
    vec4 place = corner.x == 0.0 ? a : b;
    place.xy += corner.y * half_width * across / pixels_per_unit * place.w;
    gl_Position = place;
}
