// Where the slices of a perspective grid begin, by the variant's law. A depth is told in parts of grid.origin.z; its
// coordinate grows by one from plane to plane.
//
//   SLICES_GEOMETRIC         every slice as many times as deep as the one before
//   SLICES_GEOMETRIC_BIASED  the same, by one logarithm, one product and one sum of the depth itself (Ortiz)
//   SLICES_SECOND_PLANE      the first ends at grid.origin.z, the others are geometric (Ortegren)
//   SLICES_LINEAR            even steps from the eye
//   SLICES_UNIFORM_NDC       even steps of projected depth
//   SLICES_UNIFORM_VIEW      even steps from the near plane
#pragma once

#include "generated/gpu_interface.glsl"

float coordinate_of_parts(float parts)
{
#if SLICES == SLICES_GEOMETRIC || SLICES == SLICES_GEOMETRIC_BIASED
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

// The coordinate of a depth, metres.
float slice_coordinate(float depth)
{
#if SLICES == SLICES_GEOMETRIC_BIASED
    precise float coordinate = log2(depth) * grid.scale.z + grid.slice_bias;
    return coordinate;
#else
    return coordinate_of_parts(depth / grid.origin.z);
#endif
}

// How far rounding may take a coordinate: twice what the Vulkan specification grants log2 (3 ULP), the division, the product and
// the sum, in parts of what they give. Grids are planned so that it stays below half a slice.
float slice_rounding(float coordinate)
{
    const float ROUNDING = 2e-6;
#if SLICES == SLICES_GEOMETRIC_BIASED
    return ROUNDING * (abs(coordinate) + abs(grid.slice_bias) + grid.scale.z);
#else
    return ROUNDING * (abs(coordinate) + grid.scale.z);
#endif
}

// The coordinate of what may lie nearer than anything in the grid, and behind the eye: below 1 there.
float clamped_slice_coordinate(float depth)
{
    float parts = depth / grid.origin.z;
#if SLICES == SLICES_SECOND_PLANE || SLICES == SLICES_LINEAR
    return coordinate_of_parts(max(parts, 0.0));
#else
    return coordinate_of_parts(max(parts, 1e-3));
#endif
}
