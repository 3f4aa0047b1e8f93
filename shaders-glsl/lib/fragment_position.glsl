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

// Whether the fragment lies on the far plane, at the depth that the buffer is cleared to: a test for equal depth
// passes there, yet marking from depth takes it for background. Such fragments are background everywhere. A fragment
// of several samples has a depth of its own only at its centre, which none of them need have; its marks come from
// geometry, far plane included.
bool is_background()
{
#if SAMPLES == 1 || PER_SAMPLE
    return gl_FragCoord.z <= 0.0;
#else
    return false;
#endif
}
