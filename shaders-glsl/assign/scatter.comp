// Scattering, second half: a workgroup tests a packet of the lights of a group against the group's visible clusters.
// WRITE_LISTS 0 counts (pass count_lights), 1 writes (pass assign_lights) where light bits did not fit.
#version 460
#include "lib/counters.glsl"
#include "lib/light_packet.glsl"
#include "lib/list_builder.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

shared uint packet_numbers[ASSIGN_WORKGROUP];

// Puts lights of the packet, a bit each from `first` on, on a list.
void add_lights(uint visible, uint first, uint bits)
{
    for (; bits != 0u; bits &= bits - 1u) {
        uint number = packet_numbers[first + uint(findLSB(bits))];
#if WRITE_LISTS
        add_light(visible, number);
#else
        mark_light(visible, number);
#endif
    }
}

void main()
{
    uint thread = gl_LocalInvocationID.x;
    uint packet = gl_WorkGroupID.y * PACKET_ROW + gl_WorkGroupID.x;
    uint group = 0u, number = 0u, there = 0u;
    if (packet < state.packets) {
        if (state.listed != 0u) {
            group = packet_groups[packet];
            there = min(groups[group].lights - (packet - groups[group].first_packet) * ASSIGN_WORKGROUP, ASSIGN_WORKGROUP);
            number = thread < there ? group_lights[packet * ASSIGN_WORKGROUP + thread] : 0u;
        } else {
            uint packets = (state.candidates + ASSIGN_WORKGROUP - 1u) / ASSIGN_WORKGROUP;
            group = packet / packets;
            uint first = packet % packets * ASSIGN_WORKGROUP;
            there = min(state.candidates - first, ASSIGN_WORKGROUP);
            number = min(first + thread, state.candidates - 1u);
        }
    }
    packet_numbers[thread] = number;
    fill_packet(read_volume(number));
    uint visible = group * ASSIGN_WORKGROUP + thread;
    uint asked = visible < state.visible && holds_samples(visible) ? there : 0u;
    uvec2 met = lights_met(visible, asked);
    if (visible >= state.visible)
        return;
#if !WRITE_LISTS
    count(COUNTER_INTERSECTION_TESTS, asked);
    // No other packet has these pairs: lengths grow by a packet's at once.
    if (any(notEqual(met, uvec2(0u))))
        atomicAdd(list_lengths[visible], uint(bitCount(met.x) + bitCount(met.y)));
    if (state.masked == 0u)
        return;
#endif
    add_lights(visible, 0u, met.x);
    add_lights(visible, 32u, met.y);
}
