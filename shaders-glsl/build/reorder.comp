// Moves each item to its place by the digit of this pass; equal digits keep their order.
#version 460
#include "lib/sort.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint block = gl_GlobalInvocationID.x;
    if (block >= sort_blocks())
        return;
    uint end = min((block + 1u) * SORT_BLOCK, state.candidates);
    for (uint i = block * SORT_BLOCK; i < end; ++i) {
        uvec2 item = sort_items[sort_source() + i];
        sort_items[sort_target() + digit_counts[digit_count(item.x, block)]++] = item;
    }
}
