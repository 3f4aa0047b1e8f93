// The light hierarchy: lights in Morton order under an implicit tree of TREE_WIDTH-wide nodes.
//
// Depth d has TREE_WIDTH^d places, one behind the other in `light_nodes`; the lights are the places at depth
// grid.tree_depth. Node p of a depth covers the lights from p * TREE_WIDTH^(tree_depth - d); places beyond the last
// light are void.
#pragma once

#include "lib/intersect.glsl"

uint tree_shift()
{
    return uint(findMSB(TREE_WIDTH));
}

uint first_light(uint depth, uint place)
{
    return place << (tree_shift() * (grid.tree_depth - depth));
}

uint node_index(uint depth, uint place)
{
    return ((1u << (tree_shift() * depth)) - 1u) / (TREE_WIDTH - 1u) + place;
}

LightNode light_node(uint depth, uint place)
{
    return read_node(node_index(depth, place));
}

// Whether some light under the node may meet the cell. Never false where the test of one of them is true.
bool may_meet(CellBounds cell, LightNode node)
{
    return meets_grown(cell, vec4(node.centre, node.radius), node.half_extent);
}
