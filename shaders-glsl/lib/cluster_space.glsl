// Cluster spaces (Gelderen sections 3.1, 4.2, 4.3): from a sample's pixel and depth to its cluster.
//
// Marking and shading call the same functions with the same pixel and depth, and every step is `precise`:
// the index comes out with the same bits, so a shaded fragment always finds its cluster.
#pragma once

#include "generated/gpu_interface.glsl"
#include "lib/slices.glsl"
#include "lib/view_position.glsl"

// Continuous cluster coordinates of a position in the clustering camera's space.
vec3 cluster_coordinates(vec3 position)
{
#if SPACE == SPACE_PERSPECTIVE
    precise vec2 tangent = position.xy / -position.z;
    precise vec3 coordinates = vec3((tangent - grid.origin.xy) * grid.scale.xy, slice_coordinate(-position.z));
#else
    precise vec3 coordinates = (position - grid.origin) * grid.scale;
#endif
    return coordinates;
}

#if SPACE == SPACE_PERSPECTIVE

// The slice whose planes a depth lies between, given its coordinate: slice_planes[slice] <= depth < slice_planes[slice + 1].
// A coordinate near a whole number leaves it to the plane there, with which lights are tested (see slice_depth).
uint slice_of(float depth, float coordinate)
{
    float last = float(grid.dimensions.z - 1u);
    float plane = round(coordinate);
    bool close = abs(coordinate - plane) < slice_rounding(coordinate);
    if (close && plane >= 1.0 && plane <= last) {
        uint slice = uint(plane);
        return depth < slice_planes[slice] ? slice - 1u : slice;
    }
    return uint(clamp(floor(coordinate), 0.0, last));
}

#endif

// Cell of a position in the clustering camera's space. What lies outside, as samples on the grid's far sides, belongs to
// the last cell there.
uvec3 cell_of_position(vec3 position)
{
    vec3 coordinates = cluster_coordinates(position);
    uvec3 cell = uvec3(clamp(ivec3(floor(coordinates)), ivec3(0), ivec3(grid.dimensions) - 1));
#if SPACE == SPACE_PERSPECTIVE
    cell.z = slice_of(-position.z, coordinates.z);
#endif
    return cell;
}

// Position of a sample in the clustering camera's space.
vec3 clustering_position(ViewData view, vec2 pixel, float depth)
{
    precise vec3 local = (view.clustering_from_view * vec4(view_position(view, pixel, depth), 1.0)).xyz;
    return local;
}

uint linear_cluster(uvec3 cell)
{
    return cell.x + grid.dimensions.x * (cell.y + grid.dimensions.y * cell.z);
}

uvec3 cell_of_linear(uint cluster)
{
    uint slice = grid.dimensions.x * grid.dimensions.y;
    uint in_slice = cluster % slice;
    return uvec3(in_slice % grid.dimensions.x, in_slice / grid.dimensions.x, cluster / slice);
}

// Linear cluster index of a sample.
uint cluster_of_sample(ViewData view, vec2 pixel, float depth)
{
    return linear_cluster(cell_of_position(clustering_position(view, pixel, depth)));
}
