// What views in mirrors ask of vertices. MIRRORS 0 where no view sees one: then this costs nothing.
#pragma once

#include "generated/gpu_interface.glsl"

#if MIRRORS

out float gl_ClipDistance[1];

// Leaves out what lies behind the mirror of a view; `world` is a vertex's place.
void clip_behind_mirror(uint view, vec3 world)
{
    // The same bits in every pass, as of positions.
    precise float distance = dot(views[view].clip_plane.xyz, world) + views[view].clip_plane.w;
    gl_ClipDistance[0] = distance;
}

// Of views that are drawn at once, leaves out all of those whose faces do not turn the way that this draw takes for front.
void clip_other_handedness(uint view)
{
    if (views[view].mirrored != push.mirrored)
        gl_ClipDistance[0] = -1.0;
}

#else

void clip_behind_mirror(uint view, vec3 world) {}
void clip_other_handedness(uint view) {}

#endif
