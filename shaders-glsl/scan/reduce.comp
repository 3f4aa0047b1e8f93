// Sums each block of items.
#version 460
#include "lib/scan.glsl"

layout(local_size_x = SCAN_WORKGROUP) in;

void main()
{
    uint values[SCAN_PER_THREAD];
    uint total;
    group_exclusive_sum(load_items(gl_GlobalInvocationID.x * SCAN_PER_THREAD, values), total);
    if (gl_LocalInvocationID.x == 0u)
        block_sums[gl_WorkGroupID.x] = total;
}
