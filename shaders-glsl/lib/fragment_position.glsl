// The pixel coordinates of the running fragment, as marking from depth sees them: the centre of the pixel, or the
// location of the sample where fragments run per sample.
#pragma once

#include "lib/sample_positions.glsl"

vec2 fragment_pixel()
{
#if PER_SAMPLE
    return floor(gl_FragCoord.xy) + sample_position(gl_SampleID);
#else
    return floor(gl_FragCoord.xy) + 0.5;
#endif
}
