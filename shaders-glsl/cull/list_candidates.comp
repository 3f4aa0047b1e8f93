// Lists the candidates by ascending light, with their volumes; a thread takes a word of bits.
//
// A pass of its own, behind the prefix sum: llvmpipe runs the body of a loop once even where no lane enters it, so that so
// long a body, within the sum, costs every one of its items.
#version 460
#include "lib/cell_range.glsl"
#include "lib/halves.glsl"
#include "lib/light_volume.glsl"

layout(local_size_x = ASSIGN_WORKGROUP) in;

void main()
{
    uint word = gl_GlobalInvocationID.x;
    uint words = (grid.light_count + 31u) / 32u;
    if (word >= words)
        return;
    uint number = light_bits[words + word];
    for (uint bits = light_bits[word]; bits != 0u; bits &= bits - 1u) {
        uint light = word * 32u + uint(findLSB(bits));
        LightVolume volume = volume_of_light(light);
        CellRange range = cells_near(volume);
        light_volumes[number] = volume;
        candidates[number] = Candidate(light, pack_cells(uvec3(range.low), uvec3(range.high)));
        ++number;
    }
}
