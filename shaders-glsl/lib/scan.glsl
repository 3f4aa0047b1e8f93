// The one prefix sum: what its three dispatches (reduce, block_offsets, apply) share, and the one (single) that does all
// where there are few blocks.
//
//   items ──reduce──> block_sums ──block_offsets──> block_sums (exclusive), total ──apply──> exclusive prefix per item
//
// A block is SCAN_BLOCK items; a workgroup of SCAN_WORKGROUP threads takes one block, each thread consecutive items. What the
// items are, and what becomes of prefixes and total, is in lib/scan_items.glsl.
#pragma once

#include "lib/scan_items.glsl"

const uint SCAN_PER_THREAD = SCAN_BLOCK / SCAN_WORKGROUP;

uint scan_blocks()
{
    return (scan_length() + SCAN_BLOCK - 1u) / SCAN_BLOCK;
}

// A sum that is all ones once it is more than 32 bits hold: it must not wrap to one that seems to fit, and prefixes must not
// descend.
uint saturating_sum(uint a, uint b)
{
    return a + b < a ? 0xFFFFFFFFu : a + b;
}

shared uint scan_partial[SCAN_WORKGROUP];

// Exclusive prefix sum over the workgroup, with the total of all threads.
uint group_exclusive_sum(uint value, out uint total)
{
    uint thread = gl_LocalInvocationID.x;
    scan_partial[thread] = value;
    barrier();
    for (uint reach = 1u; reach < SCAN_WORKGROUP; reach <<= 1) {
        uint before = thread >= reach ? scan_partial[thread - reach] : 0u;
        barrier();
        scan_partial[thread] = saturating_sum(scan_partial[thread], before);
        barrier();
    }
    total = scan_partial[SCAN_WORKGROUP - 1u];
    uint exclusive = thread > 0u ? scan_partial[thread - 1u] : 0u;
    barrier();
    return exclusive;
}

// The items of one thread of a block, 0 beyond the last; with their sum.
uint load_items(uint first, out uint values[SCAN_PER_THREAD])
{
    uint sum = 0u;
    for (uint k = 0u; k < SCAN_PER_THREAD; ++k) {
        values[k] = first + k < scan_length() ? scan_item(first + k) : 0u;
        sum = saturating_sum(sum, values[k]);
    }
    return sum;
}

void emit_items(uint first, uint values[SCAN_PER_THREAD], uint prefix)
{
    for (uint k = 0u; k < SCAN_PER_THREAD; ++k) {
        if (first + k < scan_length())
            emit(first + k, prefix);
        prefix = saturating_sum(prefix, values[k]);
    }
}
