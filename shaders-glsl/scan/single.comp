// The whole prefix sum in one workgroup, block after block: fewer dispatches where blocks are few.
#version 460
#include "lib/scan.glsl"

layout(local_size_x = SCAN_WORKGROUP) in;

void main()
{
    uint carried = 0u;
    uint blocks = scan_blocks();
    for (uint block = 0u; block < blocks; ++block) {
        uint first = (block * SCAN_WORKGROUP + gl_LocalInvocationID.x) * SCAN_PER_THREAD;
        uint values[SCAN_PER_THREAD];
        uint total;
        uint prefix = group_exclusive_sum(load_items(first, values), total);
        emit_items(first, values, saturating_sum(carried, prefix));
        carried = saturating_sum(carried, total);
    }
    if (gl_LocalInvocationID.x == 0u)
        publish(carried);
}
