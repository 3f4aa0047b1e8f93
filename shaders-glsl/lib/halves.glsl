// Two cell indices of an axis in one word: the lowest and the highest. What 16 bits do not hold becomes their largest
// number in both, so that ranges that overlap still do.
#pragma once

const uint MOST_IN_HALF = 0xFFFFu;

uint pack_range(uint low, uint high)
{
    return min(low, MOST_IN_HALF) | min(high, MOST_IN_HALF) << 16;
}

// Packs a range of cells, a word for each axis.
uvec3 pack_cells(uvec3 low, uvec3 high)
{
    return uvec3(pack_range(low.x, high.x), pack_range(low.y, high.y), pack_range(low.z, high.z));
}

// Whether two ranges of cells overlap.
bool overlap(uvec3 a, uvec3 b)
{
    bvec3 below = lessThanEqual(a & MOST_IN_HALF, b >> 16), above = lessThanEqual(b & MOST_IN_HALF, a >> 16);
    return all(below) && all(above);
}
