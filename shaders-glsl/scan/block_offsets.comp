// Turns block sums into block offsets in place, with one workgroup, and publishes the total with what depends on it.
#version 460
#include "lib/scan.glsl"

layout(local_size_x = SCAN_WORKGROUP) in;

void main()
{
    uint carried = 0u;
    for (uint first = 0u; first < scan_blocks(); first += SCAN_WORKGROUP) {
        uint block = first + gl_LocalInvocationID.x;
        uint total;
        uint before = group_exclusive_sum(block < scan_blocks() ? block_sums[block] : 0u, total);
        if (block < scan_blocks())
            block_sums[block] = saturating_sum(carried, before);
        carried = saturating_sum(carried, total);
    }
    if (gl_LocalInvocationID.x == 0u)
        publish(carried);
}
