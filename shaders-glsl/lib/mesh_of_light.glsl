// Which lights have the mesh at hand. MESH says whether they are points (MESH_SPHERE) or spots (MESH_SPOT). Where meshes of points have
// several levels of detail, MESH_LEVEL is that of the mesh at hand, and MESH_BEYOND has, of each level but the finest, how far its mesh
// reaches beyond its light, in radii of this one, over the part of a tile's width by which it may.
#pragma once

#include "lib/light_mesh.glsl"

#ifdef MESH_LEVEL

// Squares, written out, so that all shaders, and the host, choose alike.
float square_of(vec3 vector)
{
    precise float square = vector.x * vector.x + vector.y * vector.y + vector.z * vector.z;
    return square;
}

// The coarsest level that is fine enough as seen from the eye, as SphereLevel::of_detail has it (geometry/light_mesh.rs).
uint level_of(MeshFrame frame)
{
    const float BEYOND[] = float[](MESH_BEYOND);
    precise float allowed = grid.cell.x * grid.cell.x * square_of(frame.origin);
    uint level = 0u;
    for (uint at = 0u; at < BEYOND.length(); ++at) {
        precise float reaches = BEYOND[at] * BEYOND[at] * square_of(frame.x);
        if (!(reaches <= allowed))
            level = at + 1u;
    }
    return level;
}

#endif

bool has_mesh(MeshFrame frame)
{
#ifdef MESH_LEVEL
    return !is_spot(frame) && level_of(frame) == MESH_LEVEL;
#else
    return is_spot(frame) == (MESH == MESH_SPOT);
#endif
}
