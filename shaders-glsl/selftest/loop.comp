// Turns that a loop makes of those asked for in measurements[0]; each depends on the one before, so that none is left out.
#version 460
#include "generated/gpu_interface.glsl"

layout(local_size_x = 1) in;

void main()
{
    uint wanted = measurements[0], made = 0u, number = 1u;
    for (uint turn = 0u; turn < wanted; ++turn) {
        number = number * 1664525u + 1013904223u;
        made += 1u + (number & measurements[1]);
    }
    measurements[2] = made;
}
