// Prepass of masked geometry.
#version 460
#include "lib/alpha_test.glsl"
#include "lib/surface_inputs.glsl"

void main()
{
    if (is_cut_out(uv, color))
        discard;
}
