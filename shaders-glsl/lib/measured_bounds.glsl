// What the samples of a visible cluster take of its cell, in numbers that do not depend on their order:
//
//   BOUNDS_CELL   nothing is measured: the cell stands for them
//   BOUNDS_DEPTH  their depths, 2 words: of tiles, whose sides the cell tells
//   BOUNDS_BOX    their box, 6 words: of tangents and depth in perspective grids, else of metres
//
// A word is a float in an order that unsigned numbers have too; of the low ones all bits are turned, so that all start at 0,
// which no sample leaves there, and only grow.
#pragma once

#include "lib/cluster_space.glsl"

#if BOUNDS == BOUNDS_DEPTH
const uint BOUND_AXES = 1u;
#else
const uint BOUND_AXES = 3u;
#endif

uint in_order(float value)
{
    uint bits = floatBitsToUint(value);
    return bits ^ ((bits >> 31) != 0u ? 0xFFFFFFFFu : 0x80000000u);
}

float out_of_order(uint word)
{
    return uintBitsToFloat(word ^ ((word >> 31) != 0u ? 0x80000000u : 0xFFFFFFFFu));
}

uint bounds_at(uint visible)
{
    return visible * 2u * BOUND_AXES;
}

// Reading first spares most atomics.
void raise_bound(uint at, uint word)
{
    if (cluster_bounds[at] < word)
        atomicMax(cluster_bounds[at], word);
}

// Lets the bounds of a visible cluster hold a position in the clustering camera's space.
void include_position(uint visible, vec3 position)
{
#if SPACE == SPACE_PERSPECTIVE
    precise vec3 place = vec3(position.xy / -position.z, -position.z);
#else
    vec3 place = position;
#endif
    uint at = bounds_at(visible);
    for (uint axis = 0u; axis < BOUND_AXES; ++axis) {
        uint word = in_order(place[axis + 3u - BOUND_AXES]);
        raise_bound(at + axis, ~word);
        raise_bound(at + BOUND_AXES + axis, word);
    }
}

// Whether a visible cluster holds a sample, as far as that is known.
bool holds_samples(uint visible)
{
#if BOUNDS == BOUNDS_CELL
    return true;
#else
    return cluster_bounds[bounds_at(visible)] != 0u;
#endif
}

float low_bound(uint visible, uint axis)
{
    return out_of_order(~cluster_bounds[bounds_at(visible) + axis]);
}

float high_bound(uint visible, uint axis)
{
    return out_of_order(cluster_bounds[bounds_at(visible) + BOUND_AXES + axis]);
}
