// Coordinates along z of the depths in `measurements`, and how far rounding may take each: what slices count on. Behind the
// depths (push.step of them) lie the coordinates, then the allowances, then the near distance and the slices per log2.
#version 460
#include "lib/cluster_space.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint i = gl_GlobalInvocationID.x, count = push.step;
    if (i >= count)
        return;
    float coordinate = cluster_coordinates(vec3(0.0, 0.0, -uintBitsToFloat(measurements[i]))).z;
    measurements[count + i] = floatBitsToUint(coordinate);
    measurements[2u * count + i] = floatBitsToUint(slice_rounding(coordinate));
    if (i == 0u) {
        measurements[3u * count] = floatBitsToUint(grid.origin.z);
        measurements[3u * count + 1u] = floatBitsToUint(grid.scale.z);
    }
}
