// Sorts each list by light, a workgroup a list. What was written are the numbers of lights, which ascend as the lights do.
//
// A list of no more lights than threads: each light goes where as many stand before it as have smaller numbers. A longer one: a bitonic
// network whose every exchange puts the smaller number first, so that what lies beyond the list's end never has to move.
#version 460
#include "lib/list_builder.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Exchanges that a thread makes in one turn: lavapipe ends a shader's loops after 65 535 turns of all of them.
const uint AT_ONCE = 16u;

void exchange(uint first, uint size, uint low, uint high)
{
    if (high >= size)
        return;
    uint a = light_indices[first + low], b = light_indices[first + high];
    light_indices[first + low] = min(a, b);
    light_indices[first + high] = max(a, b);
}

// Exchanges within blocks of twice `half_block`: the first with the last and so on inwards (`inwards`), or the first of
// one half with the first of the other and so on.
void exchange_all(uint first, uint size, uint half_block, bool inwards)
{
    uint pairs = (size + 2u * half_block - 1u) / (2u * half_block) * half_block;
    for (uint turn = gl_LocalInvocationID.x; turn < pairs; turn += ASSIGN_WORKGROUP * AT_ONCE) {
        [[unroll]] for (uint i = 0u; i < AT_ONCE; ++i) {
            uint pair = turn + i * ASSIGN_WORKGROUP;
            uint block = pair / half_block * 2u * half_block, at = pair % half_block;
            if (pair < pairs)
                exchange(first, size, block + at, block + (inwards ? 2u * half_block - 1u - at : half_block + at));
        }
    }
    memoryBarrierBuffer();
    barrier();
}

// Of a list with a light a thread at most.
void sort_by_ranks(uint first, uint size)
{
    uint place = gl_LocalInvocationID.x;
    uint number = place < size ? light_indices[first + place] : 0u;
    uint smaller = 0u;
    for (uint i = 0u; i < size; ++i)
        smaller += light_indices[first + i] < number ? 1u : 0u;
    memoryBarrierBuffer();
    barrier();
    if (place < size)
        light_indices[first + smaller] = light_of_number(number);
}

void sort_by_exchanges(uint first, uint size)
{
    for (uint half_sorted = 1u; half_sorted < size; half_sorted *= 2u) {
        exchange_all(first, size, half_sorted, true);
        for (uint half_block = half_sorted / 2u; half_block > 0u; half_block /= 2u)
            exchange_all(first, size, half_block, false);
    }
    for (uint i = gl_LocalInvocationID.x; i < size; i += ASSIGN_WORKGROUP)
        light_indices[first + i] = light_of_number(light_indices[first + i]);
}

void main()
{
    uint visible = gl_WorkGroupID.y * LIST_ROW + gl_WorkGroupID.x;
    if (visible >= state.visible)
        return;
    uint first = min(list_offsets[visible], grid.index_capacity);
    uint size = min(list_offsets[visible + 1u], grid.index_capacity) - first;
    if (size <= ASSIGN_WORKGROUP)
        sort_by_ranks(first, size);
    else
        sort_by_exchanges(first, size);
}
