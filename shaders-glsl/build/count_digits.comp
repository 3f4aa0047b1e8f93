// Counts the digits of each block of items; the first pass makes the keys.
//
// A key is the light's Morton code in the bounds of the grid, so that the tree's nodes are small.
#version 460
#include "lib/sort.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Spreads ten bits, two zeros after each.
uint spread(uint x)
{
    x = (x | x << 16) & 0x030000FFu;
    x = (x | x << 8) & 0x0300F00Fu;
    x = (x | x << 4) & 0x030C30C3u;
    return (x | x << 2) & 0x09249249u;
}

uint light_key(LightVolume volume)
{
    uvec3 at = uvec3(clamp((volume.centre - grid.bounds_low) * grid.bounds_scale, 0.0, 1023.0));
    uint morton = spread(at.x) | spread(at.y) << 1 | spread(at.z) << 2;
    return morton >> (30u - SORT_BITS * grid.sort_passes);
}

void main()
{
    uint block = gl_GlobalInvocationID.x;
    uint blocks = sort_blocks();
    if (block >= blocks)
        return;
    for (uint digit = 0u; digit < SORT_DIGITS; ++digit)
        digit_counts[digit * blocks + block] = 0u;
    uint end = min((block + 1u) * SORT_BLOCK, state.candidates);
    for (uint i = block * SORT_BLOCK; i < end; ++i) {
        if (push.step == 0u)
            sort_items[sort_source() + i] = uvec2(light_key(read_volume(i)), i);
        ++digit_counts[digit_count(sort_items[sort_source() + i].x, block)];
    }
}
