// Assignment from the lights' side: a thread takes one light through the cells that its bounds meet, skips those
// that are not visible by whole words of bits, and tests the rest as brute force does.
// WRITE_LISTS 0 counts (pass count_lights), 1 writes (pass assign_lights).
#version 460
#include "lib/cell_range.glsl"
#include "lib/counters.glsl"
#include "lib/intersect.glsl"
#include "lib/list_builder.glsl"
#include "lib/visible.glsl"

layout(local_size_x = ASSIGN_GROUP) in;

// Bits of `word` from `first` to `last`, both linear clusters.
uint visible_bits(uint word, uint first, uint last)
{
    uint bits = cluster_bits[word];
    if (word == first >> 5)
        bits &= 0xFFFFFFFFu << (first & 31u);
    if (word == last >> 5)
        bits &= 0xFFFFFFFFu >> (31u - (last & 31u));
    return bits;
}

void main()
{
    uint light = gl_GlobalInvocationID.x;
    if (light >= grid.light_count)
        return;
    vec4 sphere = light_spheres[light];
    CellRange range = cells_near(sphere);
    if (is_empty(range))
        return;
    uvec3 low = uvec3(range.low), high = uvec3(range.high);
    uint tests = 0u;
    for (uint z = low.z; z <= high.z; ++z) {
        for (uint y = low.y; y <= high.y; ++y) {
            uint row = linear_cluster(uvec3(0u, y, z));
            for (uint word = (row + low.x) >> 5; word <= (row + high.x) >> 5; ++word) {
                for (uint bits = visible_bits(word, row + low.x, row + high.x); bits != 0u; bits &= bits - 1u) {
                    uint cluster = word * 32u + uint(findLSB(bits));
                    uint visible = visible_index(cluster);
                    ++tests;
                    if (visible != NO_CLUSTER && meets(cell_bounds(uvec3(cluster - row, y, z)), sphere))
                        add_light(visible, light);
                }
            }
        }
    }
    count(COUNTER_INTERSECTION_TESTS, tests);
}
