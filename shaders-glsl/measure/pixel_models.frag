// The model that each pixel of the prepass shows in its first sample: of several at one depth the last, which shading leaves too.
// Where there is none, 0 remains, so that the index is one more.
#version 460
#include "generated/gpu_interface.glsl"
#include "lib/model_of_fragment.glsl"

layout(early_fragment_tests) in;

void main()
{
#if SAMPLES > 1
    if (gl_SampleID != 0)
        return;
#endif
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    atomicMax(pixels[pixel.y * views[push.view].resolution.x + pixel.x].cluster_index, model_of_fragment + 1u);
}
