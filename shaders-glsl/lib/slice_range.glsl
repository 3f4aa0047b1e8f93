// The slices in which the mesh around a light lies in a tile, as a word (cpu/shell.rs, SliceRange).
#pragma once

// A half of a range of which nothing is known; two halves in a word are a range: the first slice, and how many slices lie behind the
// last in the upper one.
const uint NO_SLICE = 0xFFFFu;
const uint EMPTY_RANGE = 0xFFFFFFFFu;
const uint RANGE_FROM_THE_EYE = 0xFFFF0000u;

uint joined_ranges(uint a, uint b)
{
    return min(a & NO_SLICE, b & NO_SLICE) | min(a >> 16, b >> 16) << 16;
}
