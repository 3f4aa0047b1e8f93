// What follows from how many places the counter of visible clusters has given.
#version 460
#include "lib/publish_visible.glsl"

layout(local_size_x = 1) in;

void main()
{
    publish_visible(state.visible_total);
}
