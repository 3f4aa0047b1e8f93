// Sums each block of items.
#version 460
#include "lib/scan.glsl"

layout(local_size_x = SCAN_GROUP) in;

void main()
{
    uint first = gl_WorkGroupID.x * SCAN_BLOCK + gl_LocalInvocationID.x * SCAN_PER_THREAD;
    uint sum = 0u;
    for (uint k = 0u; k < SCAN_PER_THREAD; ++k)
        sum += first + k < scan_length() ? scan_item(first + k) : 0u;
    uint total;
    group_exclusive_sum(sum, total);
    if (gl_LocalInvocationID.x == 0u)
        block_sums[gl_WorkGroupID.x] = total;
}
