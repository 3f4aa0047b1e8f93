// Brute force in one pass, to lists whose places need no lengths (Enhuber section 3.2, Ortiz): a thread takes a visible cluster
// through all lights, packet by packet, so that its list ascends without being sorted.
//
//   LISTS_FIXED   lights go straight to the entries of the list; those beyond are counted
//   LISTS_CAPPED  lights stay with the thread, up to KEPT_LIGHTS of them, until a range is reserved for all at once
#version 460
#include "lib/light_packet.glsl"
#include "lib/list_store.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Lights that a turn takes: few, for llvmpipe goes through a turn for a packet of which nothing is met too. Lavapipe ends a
// shader's loops after 65 535 turns of all of them, which bounds how many lights the host lets through.
const uint AT_ONCE = 2u;

#if LISTS == LISTS_CAPPED
uint kept_lights[KEPT_LIGHTS];
#endif

// The lowest bit set among two words, counted through, which is cleared.
uint take_lowest(inout uvec2 words)
{
    uint at = words.x != 0u ? 0u : 1u;
    uint bit = uint(findLSB(words[at]));
    words[at] &= words[at] - 1u;
    return at * 32u + bit;
}

void take_light(uint visible, uint place, uint light)
{
    if (place >= grid.list_capacity)
        return;
#if LISTS == LISTS_FIXED
    light_indices[visible * grid.list_capacity + place] = light;
#else
    kept_lights[place] = light;
#endif
}

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    bool tested = visible < state.visible && holds_samples(visible);
    CellBounds cell = cell_of_thread(visible);
    uint found = 0u;
    for (uint first = 0u; first < grid.light_count; first += ASSIGN_WORKGROUP) {
        uint there = min(grid.light_count - first, ASSIGN_WORKGROUP);
        fill_packet(read_volume(first + min(gl_LocalInvocationID.x, there - 1u)));
        uvec2 met = lights_passing(cell, tested ? there : 0u);
        while (met != uvec2(0u)) {
            [[unroll]] for (uint i = 0u; i < AT_ONCE; ++i) {
                if (met != uvec2(0u)) {
                    uint place = take_lowest(met);
                    if (!is_left_out(visible, cell, packet_volume(place)))
                        take_light(visible, found++, first + place);
                }
            }
        }
        barrier();
    }
    if (visible >= state.visible)
        return;
    count(COUNTER_INTERSECTION_TESTS, tested ? grid.light_count : 0u);
    uvec2 entries = keep_list(visible, found);
#if LISTS == LISTS_CAPPED
    for (uint entry = entries.x; entry < entries.y; ++entry)
        light_indices[entry] = kept_lights[entry - entries.x];
#endif
}
