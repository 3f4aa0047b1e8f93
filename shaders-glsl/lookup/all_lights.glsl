// Every light, for every fragment: the truth that the other lookups are compared with.
#pragma once

#include "lib/light_cursor.glsl"

// The lights of a sample; false where the sample's cluster is missing, which never happens here.
bool find_lights(ViewData view, vec2 pixel, float depth, out LightCursor cursor)
{
    cursor = LightCursor(0u, grid.light_count);
    return true;
}

uint light_at(uint position)
{
    return position;
}

const uint NO_GROUP = 0xFFFFFFFFu;

// Nothing is grouped.
uint group_of_sample(ViewData view, vec2 pixel, float depth)
{
    return NO_GROUP;
}

uint fragments_of_group(uint group)
{
    return 0u;
}
