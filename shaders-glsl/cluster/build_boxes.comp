// The box around every cell of the grid, a thread a cell (Ortiz, step 1). Two corners of a tile are enough for all four, as x
// follows from x alone; tiles and fragments count rows from the same side.
#version 460
#include "lib/intersect.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint cluster = gl_GlobalInvocationID.x;
    if (cluster >= grid.dimensions.x * grid.dimensions.y * grid.dimensions.z)
        return;
    ClusterBox box = box_of_cell(cell_of_linear(cluster));
    cluster_boxes[cluster].low = box.low;
    cluster_boxes[cluster].high = box.high;
}
