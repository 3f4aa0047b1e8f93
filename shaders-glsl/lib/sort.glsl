// Stable radix sort of (key, light), SORT_BITS a pass; the pass is push.step.
//
//   light_spheres ──> sort_items ──count_digits──> digit_counts ──scan──> offsets ──reorder──> sort_items (other half)
//
// A thread takes SORT_BLOCK consecutive items, in order: stable without any exchange between threads. The first pass
// drops the lights that can meet no cell; the later ones see state.tree_lights items.
#pragma once

#include "generated/gpu_interface.glsl"

// Key of a light that can meet no cell.
const uint KEY_NONE = 0xFFFFFFFFu;

uint sort_length() { return push.step == 0u ? grid.light_count : state.tree_lights; }
uint sort_blocks() { return (sort_length() + SORT_BLOCK - 1u) / SORT_BLOCK; }
uint sort_source() { return (push.step + 1u & 1u) * grid.light_count; }
uint sort_target() { return (push.step & 1u) * grid.light_count; }

// Place of a key's digit in the counts, which are ordered by digit, then by block.
uint digit_count(uint key, uint block)
{
    return (key >> SORT_BITS * push.step & SORT_DIGITS - 1u) * sort_blocks() + block;
}
