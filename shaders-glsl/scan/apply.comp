// Hands each item's exclusive prefix on.
#version 460
#include "lib/scan.glsl"

layout(local_size_x = SCAN_WORKGROUP) in;

void main()
{
    uint first = gl_GlobalInvocationID.x * SCAN_PER_THREAD;
    uint values[SCAN_PER_THREAD];
    uint total;
    uint prefix = group_exclusive_sum(load_items(first, values), total);
    emit_items(first, values, saturating_sum(block_sums[gl_WorkGroupID.x], prefix));
}
