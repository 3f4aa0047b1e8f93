// Meshes that hold what lights reach: a template of four coordinates a vertex, which a light's frame takes to the clustering camera's
// space (geometry/light_mesh.rs).
#pragma once

#include "generated/gpu_interface.glsl"

// Only the meshes of spots have a tip.
bool is_spot(MeshFrame frame)
{
    return frame.tip != vec3(0.0);
}

vec3 placed_vertex(MeshFrame frame, vec4 vertex)
{
    precise vec3 place = frame.origin + frame.x * vertex.x + frame.y * vertex.y + frame.z * vertex.z + frame.tip * vertex.w;
    return place;
}
