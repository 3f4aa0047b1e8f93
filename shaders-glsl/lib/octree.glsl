// The octree over the lights: from a place in the world to the slot of the filled leaf that holds it.
#pragma once

#include "generated/gpu_interface.glsl"

const uint NO_LEAF = 0xFFFFFFFFu;

// The slot of a key: (p mod m + offset[p mod r]) mod m.
uint hashed_slot(HashData table, uvec3 key)
{
    uvec3 at = key % table.offset_side;
    uvec3 offset = read_octree_offset(table.offsets + at.x + table.offset_side * (at.y + table.offset_side * at.z)).xyz;
    uvec3 slot = (key % table.side + offset) % table.side;
    return table.slots + slot.x + table.side * (slot.y + table.side * slot.z);
}

// The slot of the filled leaf that holds a place, world space; NO_LEAF where no light reaches. Outside of the octree it is not asked:
// a hash would answer there as well.
//
// The descent ends by what it finds, not by the octree's depth: where a loop or a branch hangs on a uniform alone, lavapipe compiles
// the shader anew for each draw (a hundred times as long, measured). The bound is for damaged tables.
uint leaf_at(vec3 position)
{
    precise vec3 coordinates = (position - octree.origin) * octree.scale;
    bool descends = all(greaterThanEqual(coordinates, vec3(0.0))) && all(lessThan(coordinates, vec3(octree.cells)));
    // Cells of all depths come from the one at the deepest, so that they agree.
    uvec3 deepest = uvec3(coordinates);
    uint below = octree.depth - octree.start_depth;
    uint leaf = NO_LEAF;
    for (uint i = 0u; i < OCTREE_LAYERS && descends; ++i) {
        OctreeLayer layer = octree.layers[i];
        --below;
        uvec3 child = deepest >> below;
        uint branch = read_octree_node(hashed_slot(layer.branches, child >> 1));
        uvec3 side = child & 1u;
        uint bit = side.x + 2u * side.y + 4u * side.z;
        descends = (branch >> bit & 1u) == 0u;
        if ((branch >> (8u + bit) & 1u) != 0u)
            leaf = hashed_slot(layer.leaves, child);
    }
    return leaf;
}
