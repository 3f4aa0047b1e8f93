// Which instances views may see, as the indirect commands that draw them.
//
// A thread takes a whole slot, so that its instances keep their order without a prefix sum. push.view is the first view
// asked for, push.step how many follow: opaque and masked slots are for all of them, at the place of the first, and seen
// where any sees them; transparent ones are for each by itself, in its own order.
#version 460
#include "generated/gpu_interface.glsl"

layout(local_size_x = CULL_GROUP) in;

// False only where the box lies wholly outside a plane.
bool may_see(uint view, uint instance)
{
    vec3 center = instances[instance].box_center;
    vec3 half_extent = instances[instance].box_half_extent;
    for (uint p = 0u; p < 6u; ++p) {
        vec4 plane = views[view].planes[p];
        if (dot(plane.xyz, center) + plane.w < -dot(abs(plane.xyz), half_extent))
            return false;
    }
    return true;
}

bool any_may_see(uint first_view, uint view_count, uint instance)
{
    for (uint view = first_view; view < first_view + view_count; ++view) {
        if (may_see(view, instance))
            return true;
    }
    return false;
}

void main()
{
    uint surfaces = draw_counts.surfaces, transparents = draw_counts.transparents;
    uint thread = gl_GlobalInvocationID.x;
    if (thread >= surfaces + push.step * transparents)
        return;
    uint view = push.view, view_count = push.step, command = thread, slot = thread;
    if (thread >= surfaces) {
        uint place = (thread - surfaces) % transparents;
        view = push.view + (thread - surfaces) / transparents;
        view_count = 1u;
        command = surfaces + place;
        slot = draw_order[view * transparents + place];
    }
    DrawCommand draw = draw_slots[slot];
    uint first_drawn = view * draw_counts.instances + draw.first_instance;
    uint drawn = 0u;
    for (uint i = 0u; i < draw.instance_count; ++i) {
        uint instance = draw.first_instance + i;
        if (any_may_see(view, view_count, instance))
            drawn_instances[first_drawn + drawn++] = instance;
    }
    draw.instance_count = drawn;
    draw.first_instance = first_drawn;
    draw_commands[view * (surfaces + transparents) + command] = draw;
}
