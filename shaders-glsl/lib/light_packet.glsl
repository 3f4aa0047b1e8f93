// A packet of ASSIGN_WORKGROUP lights against a group of as many visible clusters, a thread each.
//
// The lights lie in shared memory, read by all threads at once, and the tests stand one behind the other without any
// branch around them: processors with scalar loads, and those that imitate a GPU, then load a light once for all. Of a volume
// its bounding sphere alone lies there: the whole struct, of which spheres use no more, costs brute force 5 % on lavapipe.
#pragma once

#include "lib/intersect.glsl"
#extension GL_EXT_control_flow_attributes : require

// Whether tests ask more of a light than its bounding sphere.
#define ASKS_LIGHTS (CONES != CONES_UNASKED || NORMAL_CONES)

shared vec4 packet_spheres[ASSIGN_WORKGROUP];
#if ASKS_LIGHTS
// (kind, light) of each, which tell cones, and where spots stand.
shared uvec2 packet_kinds[ASSIGN_WORKGROUP];
#endif
#if TEST_MM
// The rectangles in which they are seen, once for all clusters.
shared vec4 packet_rectangles[ASSIGN_WORKGROUP];
#endif

// Puts this thread's light into the packet.
void fill_packet(LightVolume volume)
{
    packet_spheres[gl_LocalInvocationID.x] = bounding_sphere(volume);
#if ASKS_LIGHTS
    packet_kinds[gl_LocalInvocationID.x] = uvec2(volume.kind, volume.light);
#endif
#if TEST_MM
    packet_rectangles[gl_LocalInvocationID.x] = seen_rectangle(bounding_sphere(volume));
#endif
    barrier();
}

// A volume of the packet, as far as tests ask it.
LightVolume packet_volume(uint i)
{
    LightVolume volume;
    volume.centre = packet_spheres[i].xyz;
    volume.radius = packet_spheres[i].w;
#if ASKS_LIGHTS
    volume.kind = packet_kinds[i].x;
    volume.light = packet_kinds[i].y;
#endif
    return volume;
}

bool packet_light_meets(CellBounds cell, uint i)
{
#if TEST_MM
    return meets_seen(cell, packet_spheres[i], packet_rectangles[i]);
#else
    return sphere_meets(cell, packet_spheres[i]);
#endif
}

// What is tested of a thread's visible cluster; beyond all of these, of the last one.
CellBounds cell_of_thread(uint visible)
{
    return bounds_of_visible(min(visible, max(state.visible, 1u) - 1u));
}

// A bit for each of the first `count` lights of the packet that meets a cell, but for those that are left out all the same.
uvec2 lights_passing(CellBounds cell, uint count)
{
    uvec2 met = uvec2(0u);
    [[unroll]] for (uint i = 0u; i < 32u; ++i)
        met.x |= uint(packet_light_meets(cell, i)) << i;
    [[unroll]] for (uint i = 0u; i < 32u; ++i)
        met.y |= uint(packet_light_meets(cell, 32u + i)) << i;
    uint there = min(count, 32u), beyond = max(count, 32u) - 32u;
    return met & uvec2(there == 32u ? 0xFFFFFFFFu : (1u << there) - 1u, beyond == 32u ? 0xFFFFFFFFu : (1u << beyond) - 1u);
}

// A bit for each of the first `count` lights of the packet that meets a visible cluster.
uvec2 lights_met(uint visible, uint count)
{
    CellBounds cell = cell_of_thread(visible);
    uvec2 met = lights_passing(cell, count);
#if LEAVES_OUT
    for (uint part = 0u; part < 2u; ++part)
        for (uint bits = met[part]; bits != 0u; bits &= bits - 1u)
            if (is_left_out(visible, cell, packet_volume(32u * part + uint(findLSB(bits)))))
                met[part] &= ~(bits & (0u - bits));
#endif
    return met;
}
