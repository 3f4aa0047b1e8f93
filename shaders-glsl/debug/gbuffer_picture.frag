// What the G-buffer holds: the base colour, or, by push.step, the normal.
#version 460
#include "lib/gbuffer.glsl"

layout(early_fragment_tests) in;

layout(location = 0) out vec4 out_color;

void main()
{
    StoredSurface stored = stored_surface(ivec2(gl_FragCoord.xy));
    out_color = vec4(push.step == 0u ? stored.base : 0.5 + 0.5 * stored.normal, 1.0);
}
