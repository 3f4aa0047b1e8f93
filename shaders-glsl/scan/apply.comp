// Writes each item's exclusive prefix; for the visibility words also the list of visible clusters, by ascending index.
#version 460
#include "lib/scan.glsl"

layout(local_size_x = SCAN_GROUP) in;

#if SCAN_ITEMS == SCAN_VISIBILITY
void emit(uint word, uint rank)
{
    word_ranks[word] = rank;
    for (uint bits = cluster_bits[word]; bits != 0u && rank < grid.visible_capacity; bits &= bits - 1u)
        visible_clusters[rank++] = word * 32u + uint(findLSB(bits));
}
#elif SCAN_ITEMS == SCAN_DIGITS
void emit(uint digit, uint offset)
{
    digit_counts[digit] = offset;
}
#else
void emit(uint segment, uint offset)
{
    list_offsets[segment] = offset;
}
#endif

void main()
{
    uint first = gl_WorkGroupID.x * SCAN_BLOCK + gl_LocalInvocationID.x * SCAN_PER_THREAD;
    uint values[SCAN_PER_THREAD];
    uint sum = 0u;
    for (uint k = 0u; k < SCAN_PER_THREAD; ++k) {
        values[k] = first + k < scan_length() ? scan_item(first + k) : 0u;
        sum += values[k];
    }
    uint total;
    uint prefix = block_sums[gl_WorkGroupID.x] + group_exclusive_sum(sum, total);
    for (uint k = 0u; k < SCAN_PER_THREAD; ++k) {
        if (first + k < scan_length())
            emit(first + k, prefix);
        prefix += values[k];
    }
}
