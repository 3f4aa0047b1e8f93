// Brute force (Gelderen section 5.3): every visible cluster against every light, in packets of lights and groups of clusters.
// WRITE_LISTS 0 counts (pass count_lights), 1 writes (pass assign_lights) where light bits did not fit.
#version 460
#include "lib/counters.glsl"
#include "lib/light_packet.glsl"
#include "lib/list_builder.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void add_lights(uint visible, uint first, uint bits)
{
    for (; bits != 0u; bits &= bits - 1u)
        add_light(visible, first + uint(findLSB(bits)));
}

void main()
{
    uint packet = gl_WorkGroupID.y;
    uint first = packet * ASSIGN_WORKGROUP;
    uint there = min(grid.light_count - first, ASSIGN_WORKGROUP);
    fill_packet(read_volume(first + min(gl_LocalInvocationID.x, there - 1u)));
    uint visible = gl_GlobalInvocationID.x;
    uint asked = visible < state.visible && holds_samples(visible) ? there : 0u;
    uvec2 met = lights_met(visible, asked);
    if (visible >= state.visible)
        return;
#if !WRITE_LISTS
    count(COUNTER_INTERSECTION_TESTS, asked);
    if (state.masked != 0u) {
        // A packet is two words that no other thread writes.
        uint word = visible * state.mask_words + 2u * packet;
        light_masks[word] = met.x;
        light_masks[word + 1u] = met.y;
        if (any(notEqual(met, uvec2(0u))))
            atomicAdd(list_lengths[visible], uint(bitCount(met.x) + bitCount(met.y)));
        return;
    }
#endif
    add_lights(visible, first, met.x);
    add_lights(visible, first + 32u, met.y);
}
