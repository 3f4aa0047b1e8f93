// The part of a light's tiles that a workgroup takes (y), a thread one after the other: so few that loops over meshes and slices within have
// fewer turns than the 65 535 of all of them after which lavapipe ends a shader's.
#pragma once

#include "generated/gpu_interface.glsl"

uint first_tile()
{
    return gl_WorkGroupID.y * MESH_TILES + gl_LocalInvocationIndex;
}

uint end_of_tiles(uint tiles)
{
    return min(tiles, (gl_WorkGroupID.y + 1u) * MESH_TILES);
}
