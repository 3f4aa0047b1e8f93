// Which lights may meet a visible cluster: those whose range of cells meets a block that holds one. A workgroup takes a
// block of lights, its threads lights that follow each other, so that they are loaded together.
//
// Most lights lie outside what the visible clusters span together, and are told by its planes, for a part of the cost:
// first all of a thread's lights, without any branch.
#version 460
#include "lib/blocks.glsl"
#include "lib/cell_range.glsl"
#include "lib/intersect.glsl"
#include "lib/light_bits.glsl"
#include "lib/light_volume.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Lights of a thread that are tested in one turn: their loads do not wait for each other.
const uint AT_ONCE = 8u;

shared uint words[ASSIGN_WORKGROUP];
shared uint candidates_there;

bool may_meet_visible(LightVolume volume)
{
    CellRange range = cells_near(volume);
    if (is_empty(range))
        return false;
    return may_hold_visible(block_of(uvec3(range.low)), block_of(uvec3(range.high)));
}

// A bit for each of this thread's lights that may meet what the visible clusters span.
uint lights_near(uint first)
{
    CellBounds visible = range_bounds(lowest_visible(), highest_visible());
    uint last = max(grid.light_count, 1u) - 1u;
    uint near = 0u;
    for (uint turn = 0u; turn < 32u; turn += AT_ONCE)
        [[unroll]] for (uint i = 0u; i < AT_ONCE; ++i) {
            uint light = first + (turn + i) * ASSIGN_WORKGROUP;
            bool meets = may_meet_range(visible, volume_of_light(min(light, last)));
            near |= uint(meets && light <= last) << (turn + i);
        }
    return grid.light_count > 0u ? near : 0u;
}

void main()
{
    uint thread = gl_LocalInvocationID.x, block = gl_WorkGroupID.x;
    words[thread] = 0u;
    if (thread == 0u)
        candidates_there = 0u;
    barrier();
    uint first = block * LIGHT_BLOCK + thread;
    for (uint near = lights_near(first); near != 0u; near &= near - 1u) {
        uint place = thread + uint(findLSB(near)) * ASSIGN_WORKGROUP;
        if (may_meet_visible(volume_of_light(block * LIGHT_BLOCK + place)))
            atomicOr(words[place >> 5], 1u << (place & 31u));
    }
    barrier();
    uint word = block * ASSIGN_WORKGROUP + thread;
    if (word < light_words())
        light_bits[word] = words[thread];
    if (words[thread] != 0u)
        atomicAdd(candidates_there, uint(bitCount(words[thread])));
    barrier();
    if (thread == 0u)
        light_bits[block_count(block)] = candidates_there;
}
