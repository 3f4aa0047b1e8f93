// Lists the candidates by ascending light, with their volumes; a workgroup takes a block of lights. Where its candidates
// begin, it sums up from the numbers of the blocks before. The last one knows how many there are, and publishes it.
#version 460
#include "lib/cell_range.glsl"
#include "lib/halves.glsl"
#include "lib/light_bits.glsl"
#include "lib/light_volume.glsl"
#include "lib/publish_candidates.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = ASSIGN_WORKGROUP) in;

// Candidates of the blocks before.
shared uint first_number;
// Candidates of each word, four bytes together.
shared uint word_counts[ASSIGN_WORKGROUP / 4u];
shared uint lights_listed[LIGHT_BLOCK];

// Candidates of the words before this thread's: all threads read the same words, for barriers are dear.
uint rank_of_word(uint thread)
{
    // Two sums in two halves: neither is beyond LIGHT_BLOCK.
    uint halves = 0u;
    [[unroll]] for (uint i = 0u; i < ASSIGN_WORKGROUP / 4u; ++i) {
        uint below = i < thread / 4u ? 0xFFFFFFFFu : i == thread / 4u ? (1u << 8u * (thread % 4u)) - 1u : 0u;
        uint counts = word_counts[i] & below;
        halves += (counts & 0xFF00FFu) + (counts >> 8 & 0xFF00FFu);
    }
    return (halves & 0xFFFFu) + (halves >> 16);
}

void list_candidate(uint number, uint light)
{
    LightVolume volume = volume_of_light(light);
    CellRange range = cells_near(volume);
    light_volumes[number] = volume;
    candidates[number] = Candidate(light, pack_cells(uvec3(range.low), uvec3(range.high)));
}

void main()
{
    uint thread = gl_LocalInvocationID.x, block = gl_WorkGroupID.x;
    if (thread == 0u)
        first_number = 0u;
    if (thread < ASSIGN_WORKGROUP / 4u)
        word_counts[thread] = 0u;
    barrier();
    uint before = 0u;
    for (uint other = thread; other < block; other += ASSIGN_WORKGROUP)
        before += light_bits[block_count(other)];
    if (before > 0u)
        atomicAdd(first_number, before);
    uint word = block * ASSIGN_WORKGROUP + thread;
    uint bits = word < light_words() ? light_bits[word] : 0u;
    if (bits != 0u)
        atomicOr(word_counts[thread / 4u], uint(bitCount(bits)) << 8u * (thread % 4u));
    barrier();
    uint first = first_number, there = light_bits[block_count(block)];
    for (uint rank = rank_of_word(thread); bits != 0u; bits &= bits - 1u)
        lights_listed[rank++] = word * 32u + uint(findLSB(bits));
    barrier();
    for (uint i = thread; i < there; i += ASSIGN_WORKGROUP)
        list_candidate(first + i, lights_listed[i]);
    if (thread == 0u && block + 1u == gl_NumWorkGroups.x)
        publish_candidates(first + there);
}
