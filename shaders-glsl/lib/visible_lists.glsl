// The light list of a sample's group, for every lookup by groups with lists; each says itself which group a sample is of.
#pragma once

#include "lib/light_cursor.glsl"
#include "lib/visible.glsl"

LightCursor list_of_visible(uint visible)
{
#if LISTS == LISTS_LINKED
    return LightCursor(list_offsets[visible], NO_NODE);
#else
#if LISTS == LISTS_FIXED
    uint first = visible * grid.list_capacity;
    uint end = first + min(list_lengths[visible], grid.list_capacity);
#elif LISTS == LISTS_CAPPED
    uint first = list_offsets[visible];
    uint end = first + list_lengths[visible];
#else
    uint first = list_offsets[visible];
    uint end = list_offsets[visible + 1u];
#endif
    return LightCursor(min(first, grid.index_capacity), min(end, grid.index_capacity));
#endif
}

const uint NO_GROUP = NO_CLUSTER;

// The group of a sample, by its index.
uint group_of_sample(ViewData view, vec2 pixel, float depth);

// The list of a group; false where the group is missing.
bool list_of_group(uint group, out LightCursor cursor)
{
    uint visible = visible_index(group);
    cursor = LightCursor(0u, 0u);
    if (visible == NO_CLUSTER)
        return false;
    cursor = list_of_visible(visible);
    return true;
}

// The lights of a sample; false where the sample's group is missing.
bool find_lights(ViewData view, vec2 pixel, float depth, out LightCursor cursor)
{
    return list_of_group(group_of_sample(view, pixel, depth), cursor);
}

#if LISTS != LISTS_LINKED
uint light_at(uint position)
{
    return read_index(position);
}
#endif

// Fragments that were counted in a group.
uint fragments_of_group(uint group)
{
    uint visible = visible_index(group);
    return visible == NO_CLUSTER ? 0u : visible_fragments[visible];
}
