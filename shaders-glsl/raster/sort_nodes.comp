// Links the nodes of each list anew, spots by ascending light, then points by ascending light: a thread a list. Runs that are sorted
// are merged two by two, once those of one node, then those of two, and so on, so that links are all that is written.
#version 460
#include "lib/light_mesh.glsl"
#include "lib/light_nodes.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Steps of one turn: lavapipe ends a shader's loops after 65 535 turns of all of them.
const uint AT_ONCE = 16u;

// What nodes are sorted by.
uint key_of(uint node)
{
#if NODE_WORDS == 2
    return light_indices[2u * node];
#else
    uint light = light_indices[node] >> 20;
    return is_spot(light_frames[light]) ? light : light | KIND_OF_POINT;
#endif
}

uint next_of(uint node)
{
#if NODE_WORDS == 2
    return light_indices[2u * node + 1u];
#else
    return light_indices[node] & NO_NODE;
#endif
}

void link(uint node, uint next)
{
#if NODE_WORDS == 2
    light_indices[2u * node + 1u] = next;
#else
    light_indices[node] = light_indices[node] & ~NO_NODE | next;
#endif
}

// A run of so many nodes, or of those up to the end of the list.
struct Run {
    uint first, nodes;
};

bool is_empty(Run run)
{
    return run.nodes == 0u || run.first == NO_NODE;
}

// The node so many behind another.
uint node_behind(uint node, uint steps)
{
    for (uint step = 0u; step < steps && node != NO_NODE; step += AT_ONCE)
        [[unroll]] for (uint i = 0u; i < AT_ONCE; ++i)
            if (step + i < steps && node != NO_NODE)
                node = next_of(node);
    return node;
}

// Takes the first node off the run that has the smaller one.
uint take_first(inout Run left, inout Run right)
{
    bool from_left = !is_empty(left) && (is_empty(right) || key_of(left.first) < key_of(right.first));
    uint node = from_left ? left.first : right.first, next = next_of(node);
    if (from_left)
        left = Run(next, left.nodes - 1u);
    else
        right = Run(next, right.nodes - 1u);
    return node;
}

void main()
{
    uint visible = gl_GlobalInvocationID.x;
    if (visible >= state.visible)
        return;
    uint head = list_offsets[visible], merged = 2u;
    for (uint size = 1u; merged > 1u; size *= 2u) {
        uint rest = head, last = NO_NODE;
        head = NO_NODE;
        merged = 0u;
        while (rest != NO_NODE) {
            ++merged;
            Run left = Run(rest, size), right = Run(node_behind(rest, size), size);
            // The left run ends where the right one begins.
            while (!is_empty(left) || !is_empty(right)) {
                [[unroll]] for (uint i = 0u; i < AT_ONCE; ++i) {
                    if (!is_empty(left) || !is_empty(right)) {
                        uint node = take_first(left, right);
                        if (last == NO_NODE)
                            head = node;
                        else
                            link(last, node);
                        last = node;
                    }
                }
            }
            rest = right.first;
        }
        if (last != NO_NODE)
            link(last, NO_NODE);
    }
    list_offsets[visible] = head;
}
