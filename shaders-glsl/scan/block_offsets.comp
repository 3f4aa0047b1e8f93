// Turns block sums into block offsets in place, with one workgroup, and publishes the total with what depends on it.
#version 460
#include "lib/scan.glsl"

layout(local_size_x = SCAN_GROUP) in;

#if SCAN_ITEMS == SCAN_VISIBILITY
void publish(uint total)
{
    uint visible = min(total, grid.visible_capacity);
    state.visible_total = total;
    state.visible = visible;
    dispatches[DISPATCH_ASSIGN] = DispatchSize((visible + ASSIGN_GROUP - 1u) / ASSIGN_GROUP, grid.segment_count, 1u);
    dispatches[DISPATCH_SCAN] = DispatchSize((visible * grid.segment_count + SCAN_BLOCK - 1u) / SCAN_BLOCK, 1u, 1u);
}
#elif SCAN_ITEMS == SCAN_DIGITS
DispatchSize groups(uint items, uint group_size)
{
    return DispatchSize((items + group_size - 1u) / group_size, 1u, 1u);
}

// After the first pass it is known how many lights the tree holds, and so how much is left to do.
void publish(uint total)
{
    if (push.step > 0u)
        return;
    state.tree_lights = total;
    uint blocks = (total + SORT_BLOCK - 1u) / SORT_BLOCK;
    dispatches[DISPATCH_SORT] = groups(blocks, ASSIGN_GROUP);
    dispatches[DISPATCH_SORT_SCAN] = groups(blocks * SORT_DIGITS, SCAN_BLOCK);
    uint nodes = total;
    for (uint depth = grid.tree_depth - 1u; depth > 0u; --depth) {
        nodes = (nodes + TREE_WIDTH - 1u) / TREE_WIDTH;
        dispatches[DISPATCH_NODES + depth - 1u] = groups(nodes, ASSIGN_GROUP);
    }
}
#else
void publish(uint total)
{
    state.index_total = total;
    list_offsets[scan_length()] = total;
}
#endif

void main()
{
    uint blocks = (scan_length() + SCAN_BLOCK - 1u) / SCAN_BLOCK;
    uint carried = 0u;
    bool too_many = false;
    for (uint first = 0u; first < blocks; first += SCAN_GROUP) {
        uint block = first + gl_LocalInvocationID.x;
        uint total;
        uint before = group_exclusive_sum(block < blocks ? block_sums[block] : 0u, total);
        if (block < blocks)
            block_sums[block] = carried + before;
        too_many = too_many || carried + total < carried;
        carried += total;
    }
    // A total beyond 32 bits must not wrap to one that seems to fit.
    if (gl_LocalInvocationID.x == 0u)
        publish(too_many ? 0xFFFFFFFFu : carried);
}
