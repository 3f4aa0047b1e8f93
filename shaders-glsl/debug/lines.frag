// Lines, faint where HIDDEN: those are drawn through everything first.
#version 460

layout(location = 0) flat in vec3 tint;
layout(location = 0) out vec4 out_color;

void main()
{
    out_color = vec4(tint, HIDDEN != 0 ? 0.3 : 1.0);
}
