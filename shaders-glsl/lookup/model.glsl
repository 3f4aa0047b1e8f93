// The light list of a sample's model. A fragment knows its model, a G-buffer keeps it; for what else looks at pixels,
// measure/pixel_models.frag has put it there.
#pragma once

#include "lib/visible_lists.glsl"

#ifdef VARYINGS
#include "lib/model_of_fragment.glsl"

uint group_of_sample(ViewData view, vec2 pixel, float depth)
{
    return model_of_fragment;
}

#elif defined(GBUFFER)
#include "lib/gbuffer.glsl"

uint group_of_sample(ViewData view, vec2 pixel, float depth)
{
    return stored_model(ivec2(pixel));
}

#else

// The model of a pixel, by the index of its instance; NO_GROUP where nothing is seen.
uint group_of_sample(ViewData view, vec2 pixel, float depth)
{
    uvec2 at = uvec2(pixel);
    return pixels[at.y * view.resolution.x + at.x].cluster_index - 1u;
}

// The same from any camera.
uint group_seen(ViewData view, vec2 pixel, float depth)
{
    return group_of_sample(view, pixel, depth);
}

#endif
