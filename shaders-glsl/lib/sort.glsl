// Stable radix sort of (key, candidate), SORT_BITS a pass; the pass is push.step.
//
//   candidates ──> sort_items ──count_digits──> digit_counts ──scan──> offsets ──reorder──> sort_items (other half)
//
// A thread takes SORT_BLOCK consecutive items, in order: stable without any exchange between threads.
#pragma once

#include "generated/gpu_interface.glsl"

uint sort_blocks() { return (state.candidates + SORT_BLOCK - 1u) / SORT_BLOCK; }
uint sort_source() { return (push.step + 1u & 1u) * grid.light_count; }
uint sort_target() { return (push.step & 1u) * grid.light_count; }

// Place of a key's digit in the counts, which are ordered by digit, then by block.
uint digit_count(uint key, uint block)
{
    return (key >> SORT_BITS * push.step & SORT_DIGITS - 1u) * sort_blocks() + block;
}
