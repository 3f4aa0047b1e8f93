// The box around a cell of a perspective grid, or around what its samples take of it, along the axes of the clustering camera's
// space (Ortiz, step 1). Those of cells lie in `cluster_boxes` (cluster/build_boxes.comp).
#pragma once

#include "lib/measured_bounds.glsl"
#include "lib/axis_box.glsl"

// The box around the cell, from one corner to the opposite one, between tangents and between depths (near, far): an end of the
// box is as far out as the nearer or the farther end of the piece is.
ClusterBox box_of_piece(vec2 low, vec2 high, vec2 depths)
{
    precise vec2 lowest = min(low * depths.x, low * depths.y);
    precise vec2 highest = max(high * depths.x, high * depths.y);
    ClusterBox box;
    box.low = vec3(lowest, -depths.y);
    box.high = vec3(highest, -depths.x);
    return box;
}

// The box around a cell, of the planes that decide slices.
ClusterBox box_of_cell(uvec3 cell)
{
    precise vec2 low = grid.origin.xy + grid.cell.xy * vec2(cell.xy);
    precise vec2 high = grid.origin.xy + grid.cell.xy * vec2(cell.xy + 1u);
    return box_of_piece(low, high, vec2(slice_planes[cell.z], slice_planes[cell.z + 1u]));
}

// The box around the boxes of cells from one to another: those of the outermost cells reach as far as any. Where nothing is
// visible yet, a range is no range.
CellBounds range_bounds(uvec3 first, uvec3 last)
{
    uvec3 ends[2] = uvec3[](min(first, grid.dimensions - 1u), min(last, grid.dimensions - 1u));
    ClusterBox box = read_cluster_box(linear_cluster(ends[0]));
    if (ends[0] != ends[1])
        for (uint corner = 1u; corner < 8u; ++corner) {
            uvec3 cell = uvec3(ends[corner & 1u].x, ends[corner >> 1 & 1u].y, ends[corner >> 2].z);
            ClusterBox other = read_cluster_box(linear_cluster(cell));
            box.low = min(box.low, other.low);
            box.high = max(box.high, other.high);
        }
    return axis_box(box.low, box.high);
}

// What the samples of a visible cluster take of its cell; nothing of the kind where it holds none.
CellBounds measured_bounds(uint visible, uvec3 cell)
{
    vec2 low = vec2(low_bound(visible, 0u), low_bound(visible, 1u));
    vec2 high = vec2(high_bound(visible, 0u), high_bound(visible, 1u));
    ClusterBox box = box_of_piece(low, high, vec2(low_bound(visible, 2u), high_bound(visible, 2u)));
    return axis_box(box.low, box.high);
}
