// The lights of a sample's leaf in an octree without links (Tegelaers section 7.1.4): from depth to depth a branch tells of its
// child whether that is a leaf, and whether it is filled. Every table is a perfect spatial hash (Lefebvre and Hoppe 2006).
#pragma once

#include "lib/light_cursor.glsl"
#include "lib/octree.glsl"
#include "lib/view_position.glsl"

const uint NO_GROUP = NO_LEAF;

// The leaf of a sample, by its slot; NO_GROUP in an empty leaf or outside of the octree, where no light reaches.
uint group_of_sample(ViewData view, vec2 pixel, float depth)
{
    precise vec4 world = view.world_from_view * vec4(view_position(view, pixel, depth), 1.0);
    return leaf_at(world.xyz);
}

// The same of what some other camera sees.
uint group_seen(ViewData view, vec2 pixel, float depth)
{
    return group_of_sample(view, pixel, depth);
}

// The list of a group; false where there is none.
bool list_of_group(uint group, out LightCursor cursor)
{
    cursor = LightCursor(0u, 0u);
    if (group == NO_GROUP)
        return false;
    uvec2 run = read_octree_leaf(group);
    cursor = LightCursor(run.x, run.x + run.y);
    return true;
}

// The lights of a sample. No sample lacks its list: without a leaf it is empty.
bool find_lights(ViewData view, vec2 pixel, float depth, out LightCursor cursor)
{
    list_of_group(group_of_sample(view, pixel, depth), cursor);
    return true;
}

uint light_at(uint position)
{
    return read_octree_index(position);
}

// Fragments that were counted in a group.
uint fragments_of_group(uint group)
{
    return group == NO_GROUP ? 0u : visible_fragments[group];
}
