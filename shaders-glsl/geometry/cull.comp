// Which instances a view may see, as the indirect commands that draw them.
//
// A thread takes a whole drawable, so that its instances keep their order without a prefix sum. push.view is the view; where
// push.view_count is over 1, it is the first of so many views that a pass draws at once. Their commands come behind those of
// single views, hold no transparent drawables, and draw what any view sees once for each view (see geometry/surface.vert).
#version 460
#include "generated/gpu_interface.glsl"

layout(local_size_x = CULL_WORKGROUP) in;

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
    bool at_once = push.view_count > 1u;
    uint command = gl_GlobalInvocationID.x;
    if (command >= surfaces + (at_once ? 0u : transparents))
        return;
    uint drawable = command < surfaces ? command : draw_order[push.view * transparents + command - surfaces];
    uint list = at_once ? push.view_count : push.view;
    DrawCommand draw = drawables[drawable];
    uint first_drawn = list * draw_counts.instances + draw.first_instance;
    uint drawn = 0u;
    for (uint i = 0u; i < draw.instance_count; ++i) {
        uint instance = draw.first_instance + i;
        if (any_may_see(push.view, push.view_count, instance))
            drawn_instances[first_drawn + drawn++] = instance;
    }
    draw.instance_count = drawn * push.view_count;
    draw.first_instance = first_drawn * push.view_count;
    draw_commands[list * (surfaces + transparents) + command] = draw;
}
