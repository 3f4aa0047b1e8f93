// The nodes of one depth of the light hierarchy (push.step) from their children: nodes of the next depth, or lights.
#version 460
#include "lib/light_tree.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Rounding of the sums in node tests and of the boxes themselves, relative to the coordinates.
const float NODE_SLACK = 4e-6;

struct Hull {
    vec3 low, high;
    float radius;
};

void include(inout Hull hull, vec3 low, vec3 high, float radius)
{
    hull = Hull(min(hull.low, low), max(hull.high, high), max(hull.radius, radius));
}

Hull hull_of_lights(uint first)
{
    Hull hull = Hull(vec3(1e38), vec3(-1e38), 0.0);
    uint items = (grid.sort_passes - 1u & 1u) * grid.light_count;
    for (uint i = first; i < min(first + TREE_WIDTH, state.candidates); ++i) {
        uint number = sort_items[items + i].y;
        LightVolume volume = read_volume(number);
        tree_volumes[i] = volume;
        tree_lights[i] = number;
        include(hull, volume.centre, volume.centre, volume.radius);
    }
    return hull;
}

Hull hull_of_nodes(uint depth, uint first)
{
    Hull hull = Hull(vec3(1e38), vec3(-1e38), 0.0);
    for (uint place = first; place < first + TREE_WIDTH && first_light(depth, place) < state.candidates; ++place) {
        LightNode node = light_node(depth, place);
        include(hull, node.centre - node.half_extent, node.centre + node.half_extent, node.radius);
    }
    return hull;
}

void main()
{
    uint depth = push.step;
    uint place = gl_GlobalInvocationID.x;
    if (first_light(depth, place) >= state.candidates)
        return;
    Hull hull;
    if (depth + 1u == grid.tree_depth)
        hull = hull_of_lights(place * TREE_WIDTH);
    else
        hull = hull_of_nodes(depth + 1u, place * TREE_WIDTH);
    vec3 centre = 0.5 * (hull.low + hull.high);
    vec3 half_extent = 0.5 * (hull.high - hull.low);
    vec3 reach = abs(centre) + half_extent;
    float slack = NODE_SLACK * (max(max(reach.x, reach.y), reach.z) + hull.radius);
    uint node = node_index(depth, place);
    light_nodes[node].centre = centre;
    light_nodes[node].radius = hull.radius + slack;
    light_nodes[node].half_extent = half_extent + slack;
}
