// Where a light list lies: from `next` to `end` one light behind the other, or from node to node. One whose ends are the same is empty.
#pragma once

#include "generated/gpu_interface.glsl"

struct LightCursor {
    uint next, end;
};

#if LISTS == LISTS_LINKED

#include "lib/light_nodes.glsl"

struct ListNode {
    uint light, next;
};

ListNode list_node(uint node)
{
#if NODE_WORDS == 2
    return ListNode(read_index(2u * node), read_index(2u * node + 1u));
#else
    uint word = read_index(node);
    return ListNode(word >> 20, word & NO_NODE);
#endif
}

uint length_of(LightCursor cursor)
{
    uint lights = 0u;
    for (uint node = cursor.next; node != cursor.end; node = list_node(node).next)
        ++lights;
    return lights;
}

#else

uint length_of(LightCursor cursor)
{
    return cursor.end - cursor.next;
}

#endif
