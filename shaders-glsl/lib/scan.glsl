// The one prefix sum: what its three dispatches (reduce, block_offsets, apply) share.
//
//   items ──reduce──> block_sums ──block_offsets──> block_sums (exclusive), total ──apply──> exclusive prefix per item
//
// A block is SCAN_BLOCK items; a workgroup of SCAN_GROUP threads takes one block, each thread consecutive items.
#pragma once

#include "generated/gpu_interface.glsl"

const uint SCAN_PER_THREAD = SCAN_BLOCK / SCAN_GROUP;

#if SCAN_ITEMS == SCAN_VISIBILITY
uint scan_length() { return grid.word_count; }
uint scan_item(uint i) { return uint(bitCount(cluster_bits[i])); }
#elif SCAN_ITEMS == SCAN_DIGITS
#include "lib/sort.glsl"
uint scan_length() { return SORT_DIGITS * sort_blocks(); }
uint scan_item(uint i) { return digit_counts[i]; }
#else
uint scan_length() { return state.visible * grid.segment_count; }
uint scan_item(uint i) { return segment_counts[i]; }
#endif

shared uint scan_partial[SCAN_GROUP];

// Exclusive prefix sum over the workgroup, with the total of all threads.
uint group_exclusive_sum(uint value, out uint total)
{
    uint thread = gl_LocalInvocationID.x;
    scan_partial[thread] = value;
    barrier();
    for (uint reach = 1u; reach < SCAN_GROUP; reach <<= 1) {
        uint before = thread >= reach ? scan_partial[thread - reach] : 0u;
        barrier();
        scan_partial[thread] += before;
        barrier();
    }
    total = scan_partial[SCAN_GROUP - 1u];
    uint inclusive = scan_partial[thread];
    barrier();
    return inclusive - value;
}
