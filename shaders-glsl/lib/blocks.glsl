// Blocks of clusters: BLOCK_COLUMNS by BLOCK_COLUMNS columns at most, a word each, with a bit for each of up to 32 blocks
// along z. A block's bit tells whether it holds a visible cluster. Behind the columns lie coarser ones, two by two of them
// joined, down to a single one: any range of cells is looked up in four words.
#pragma once

#include "generated/gpu_interface.glsl"

// Levels of columns; level k has (BLOCK_COLUMNS >> k)^2.
const uint BLOCK_LEVELS = 5u;

// Word of a column of a level, `block` counted in blocks of level 0.
uint block_column(uvec2 block, uint level)
{
    // The levels before it: n^2 + (n/2)^2 + ... down to 2 n_level.
    uint side = BLOCK_COLUMNS >> level;
    uint before = 4u * (BLOCK_COLUMNS * BLOCK_COLUMNS - side * side) / 3u;
    return before + (block.x >> level) + side * (block.y >> level);
}

// Behind all columns: the highest visible cell, and the lowest with all bits turned, so that both start at 0 and only grow.
void include_visible(uvec3 low, uvec3 high)
{
    for (uint axis = 0u; axis < 3u; ++axis) {
        atomicMax(block_bits[BLOCK_EXTREMES + axis], high[axis]);
        atomicMax(block_bits[BLOCK_EXTREMES + 3u + axis], ~low[axis]);
    }
}

uvec3 highest_visible()
{
    return uvec3(block_bits[BLOCK_EXTREMES], block_bits[BLOCK_EXTREMES + 1u], block_bits[BLOCK_EXTREMES + 2u]);
}

uvec3 lowest_visible()
{
    return ~uvec3(block_bits[BLOCK_EXTREMES + 3u], block_bits[BLOCK_EXTREMES + 4u], block_bits[BLOCK_EXTREMES + 5u]);
}

// The block of a cell: cell / block size, by a product, for processors divide integers slowly. Half a cell keeps rounding
// away from where blocks meet.
uvec3 block_of(uvec3 cell)
{
    return uvec3((vec3(cell) + 0.5) * grid.block_scale);
}

void mark_block(uvec3 block)
{
    uint bit = 1u << block.z;
    for (uint level = 0u; level < BLOCK_LEVELS; ++level) {
        uint column = block_column(block.xy, level);
        if ((block_bits[column] & bit) == 0u)
            atomicOr(block_bits[column], bit);
    }
}

uint blocks_of(uvec2 block, uint level)
{
    return read_block(block_column(block, level));
}

// Whether some block between two holds a visible cluster; true also where one near them does.
bool may_hold_visible(uvec3 low, uvec3 high)
{
    uint span = max(high.x - low.x, high.y - low.y);
    // The finest level at which the range is at most two columns wide.
    uint level = span < 2u ? 0u : uint(findMSB(span - 1u)) + 1u;
    uint columns = blocks_of(low.xy, level) | blocks_of(uvec2(high.x, low.y), level) |
                   blocks_of(uvec2(low.x, high.y), level) | blocks_of(high.xy, level);
    return (columns & 0xFFFFFFFFu << low.z & 0xFFFFFFFFu >> (31u - high.z)) != 0u;
}
