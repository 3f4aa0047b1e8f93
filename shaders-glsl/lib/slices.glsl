// Where the slices of a perspective grid begin, by the variant's law. A depth is told in parts of grid.origin.z; its
// coordinate grows by one from plane to plane.
//
//   SLICES_GEOMETRIC     every slice as many times as deep as the one before
//   SLICES_SECOND_PLANE  the first ends at grid.origin.z, the others are geometric (Ortegren)
//   SLICES_LINEAR        even steps from the eye
//   SLICES_UNIFORM_NDC   even steps of projected depth
//   SLICES_UNIFORM_VIEW  even steps from the near plane
#pragma once

#include "generated/gpu_interface.glsl"

float slice_coordinate(float parts)
{
#if SLICES == SLICES_GEOMETRIC
    precise float coordinate = log2(parts) * grid.scale.z;
#elif SLICES == SLICES_SECOND_PLANE
    precise float coordinate = parts < 1.0 ? parts : 1.0 + log2(parts) * grid.scale.z;
#elif SLICES == SLICES_LINEAR
    precise float coordinate = parts * grid.scale.z;
#elif SLICES == SLICES_UNIFORM_NDC
    precise float coordinate = (1.0 - 1.0 / parts) * grid.scale.z;
#else
    precise float coordinate = (parts - 1.0) * grid.scale.z;
#endif
    return coordinate;
}

// The same of what may lie nearer than anything in the grid, and behind the eye: below 1 there.
float clamped_slice_coordinate(float parts)
{
#if SLICES == SLICES_SECOND_PLANE || SLICES == SLICES_LINEAR
    return slice_coordinate(max(parts, 0.0));
#else
    return slice_coordinate(max(parts, 1e-3));
#endif
}
