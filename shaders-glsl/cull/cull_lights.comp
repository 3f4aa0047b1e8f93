// Which lights may meet a visible cluster: those whose range of cells meets a block that holds one. A thread takes the
// lights of a word of bits, which are then ranked as those of clusters are. Most lights lie outside what the visible
// clusters span together, and are told by its planes, for a part of the cost.
#version 460
#include "lib/blocks.glsl"
#include "lib/cell_range.glsl"
#include "lib/intersect.glsl"
#include "lib/light_volume.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

bool may_meet_visible(LightVolume volume)
{
    CellRange range = cells_near(volume);
    if (is_empty(range))
        return false;
    return may_hold_visible(block_of(uvec3(range.low)), block_of(uvec3(range.high)));
}

void main()
{
    CellBounds visible = range_bounds(lowest_visible(), highest_visible());
    uint word = gl_GlobalInvocationID.x;
    uint first = word * 32u;
    if (first >= grid.light_count)
        return;
    uint near = 0u;
    for (uint light = first; light < min(first + 32u, grid.light_count); ++light)
        near |= uint(may_meet_range(visible, volume_of_light(light))) << (light - first);
    uint bits = 0u;
    for (; near != 0u; near &= near - 1u) {
        uint place = uint(findLSB(near));
        bits |= uint(may_meet_visible(volume_of_light(first + place))) << place;
    }
    light_bits[word] = bits;
}
