// Scattering, second half: a workgroup tests a tile of the lights of a group against the group's visible clusters.
// WRITE_LISTS 0 counts (pass count_lights), 1 writes (pass assign_lights) where light bits did not fit.
#version 460
#include "lib/counters.glsl"
#include "lib/light_tile.glsl"
#include "lib/list_builder.glsl"

layout(local_size_x = ASSIGN_GROUP) in;

shared uint tile_numbers[ASSIGN_GROUP];

void main()
{
    uint thread = gl_LocalInvocationID.x;
    uint tile = gl_WorkGroupID.y * TILE_ROW + gl_WorkGroupID.x;
    uint group = 0u, number = 0u, there = 0u;
    if (tile < state.tiles) {
        if (state.listed != 0u) {
            group = tile_groups[tile];
            there = min(groups[group].lights - (tile - groups[group].first_tile) * ASSIGN_GROUP, ASSIGN_GROUP);
            number = thread < there ? group_lights[tile * ASSIGN_GROUP + thread] : 0u;
        } else {
            uint tiles = (state.candidates + ASSIGN_GROUP - 1u) / ASSIGN_GROUP;
            group = tile / tiles;
            uint first = tile % tiles * ASSIGN_GROUP;
            there = min(state.candidates - first, ASSIGN_GROUP);
            number = min(first + thread, state.candidates - 1u);
        }
    }
    tile_numbers[thread] = number;
    fill_tile(read_volume(number));
    uint visible = group * ASSIGN_GROUP + thread;
    uvec2 met = lights_met(cell_of_visible(visible), there);
    if (visible >= state.visible)
        return;
    for (uint half_tile = 0u; half_tile < 2u; ++half_tile)
        for (uint bits = met[half_tile]; bits != 0u; bits &= bits - 1u)
            add_light(visible, tile_numbers[half_tile * 32u + uint(findLSB(bits))]);
#if !WRITE_LISTS
    count(COUNTER_INTERSECTION_TESTS, there);
#endif
}
