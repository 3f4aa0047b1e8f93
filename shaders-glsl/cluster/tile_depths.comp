// Which depths the samples of each tile have (Enhuber section 3.1): the bounds of tiles, whose sides the cell tells. A workgroup
// takes the pixels of a tile, or a part of them; each thread keeps the ends of what it sees, so that depth is read once and
// bounds are written once a workgroup.
#version 460
#include "lib/measured_bounds.glsl"
#include "lib/sample_positions.glsl"
#include "lib/visible.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = TILE_WORKGROUP) in;

// As words of bounds: nothing is 0.
shared uint ends[2];

// Samples lie at least this far within their pixel, and a position rounds to the next tile within less than half of it.
const float INNER = 0.125;
const float ROUNDING = 0.05;

// Pixels along an axis, from the left or the bottom, whose samples may lie in a tile.
ivec2 pixels_of_tile(ViewData view, uint tile, uint axis)
{
    float pixels_per_tangent = float(view.resolution[axis]) / view.tangent_extent[axis];
    float first = (grid.origin[axis] - view.tangent_min[axis]) * pixels_per_tangent;
    float wide = grid.cell[axis] * pixels_per_tangent;
    float low = first + wide * float(tile) - ROUNDING - (1.0 - INNER);
    float high = first + wide * float(tile + 1u) + ROUNDING - INNER;
    return ivec2(max(ceil(low), 0.0), min(floor(high), float(view.resolution[axis]) - 1.0));
}

void main()
{
    uint thread = gl_LocalInvocationID.x;
    if (thread < 2u)
        ends[thread] = 0u;
    barrier();
    ViewData view = views[push.view];
    uvec2 tile = uvec2(gl_WorkGroupID.x, gl_WorkGroupID.y % grid.dimensions.y);
    uint part = gl_WorkGroupID.y / grid.dimensions.y, parts = gl_NumWorkGroups.y / grid.dimensions.y;
    ivec2 columns = pixels_of_tile(view, tile.x, 0u);
    // Rows count from the top.
    ivec2 rows = int(view.resolution.y) - 1 - pixels_of_tile(view, tile.y, 1u).yx;
    uint width = uint(max(columns.y - columns.x + 1, 0)), height = uint(max(rows.y - rows.x + 1, 0));
    uint low = 0u, high = 0u;
    for (uint i = part * TILE_WORKGROUP + thread; i < width * height; i += parts * TILE_WORKGROUP) {
        ivec2 pixel = ivec2(columns.x + int(i % width), rows.x + int(i / width));
        [[unroll]] for (int s = 0; s < SAMPLES; ++s) {
            float depth = stored_depth(pixel, s);
            vec3 position = clustering_position(view, vec2(pixel) + sample_position(s), depth);
            uint word = in_order(-position.z);
            bool within = depth > 0.0 && cell_of_position(position).xy == tile;
            low = max(low, within ? ~word : 0u);
            high = max(high, within ? word : 0u);
        }
    }
    if (low != 0u) {
        atomicMax(ends[0], low);
        atomicMax(ends[1], high);
    }
    barrier();
    uint visible = visible_index(linear_cluster(uvec3(tile, 0u)));
    if (thread < 2u && visible != NO_CLUSTER)
        raise_bound(bounds_at(visible) + thread, ends[thread]);
}
