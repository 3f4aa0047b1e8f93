// Which slices of a tile hold samples, by sorting these (Tegelaers section 6.2); a workgroup takes a tile.
//
//   samples ──> keys (slice, sample) ──merge sort──> ascending ──compact──> slices, each once ─┬─> tile_slices, tile_counts
//   slices marked by transparent geometry, which depth does not show ──────────────────────────┘
//
// The sort is a merge from the bottom up. Where merging two runs puts a key is its place in its own run and how many keys of the
// other are less, found by bisection: log n steps for each of log n widths, with all threads busy at every width.
#version 460
#include "lib/cluster_space.glsl"
#include "lib/sample_positions.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = SORT_TILE_WORKGROUP) in;

const uint SAMPLES_THERE = TILE_PIXELS * TILE_PIXELS * SAMPLES;
// Keys of a thread.
const uint OWN = (TILE_KEYS + SORT_TILE_WORKGROUP - 1u) / SORT_TILE_WORKGROUP;
// The slice of what is no sample: behind all others.
const uint NO_SLICE = 0xFFFFu;

shared uint keys[TILE_KEYS];
shared uint sums[SORT_TILE_WORKGROUP];
// Slices that are marked and hold no sample, a bit each, and how many there are.
shared uint marked[SORT_TILE_SLICES / 32u];
shared uint marked_there;

// The key of a sample by its number in the tile, whose rows count from the bottom.
uint key_of_sample(ViewData view, uint number)
{
    uint in_tile = number / uint(SAMPLES);
    int s = int(number % uint(SAMPLES));
    uvec2 pixel = gl_WorkGroupID.xy * TILE_PIXELS + uvec2(in_tile % TILE_PIXELS, in_tile / TILE_PIXELS);
    uint slice = NO_SLICE;
    if (number < SAMPLES_THERE && all(lessThan(pixel, view.resolution))) {
        pixel.y = view.resolution.y - 1u - pixel.y;
        float depth = stored_depth(ivec2(pixel), s);
        if (depth > 0.0)
            slice = cell_of_position(clustering_position(view, vec2(pixel) + sample_position(s), depth)).z;
    }
    return slice << 16 | (number & 0xFFFFu);
}

// How many of `width` ascending keys from `first` on are less than `key`; no two are equal.
uint keys_below(uint first, uint width, uint key)
{
    uint low = 0u, high = width;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (keys[first + middle] < key)
            low = middle + 1u;
        else
            high = middle;
    }
    return low;
}

void merge_runs(uint width)
{
    uint own[OWN], place[OWN];
    [[unroll]] for (uint i = 0u; i < OWN; ++i) {
        uint at = gl_LocalInvocationID.x + i * SORT_TILE_WORKGROUP;
        if (at < TILE_KEYS) {
            own[i] = keys[at];
            uint run = at & ~(width - 1u);
            place[i] = (at & ~(2u * width - 1u)) + (at - run) + keys_below(run ^ width, width, own[i]);
        }
    }
    barrier();
    [[unroll]] for (uint i = 0u; i < OWN; ++i)
        if (gl_LocalInvocationID.x + i * SORT_TILE_WORKGROUP < TILE_KEYS)
            keys[place[i]] = own[i];
    barrier();
}

bool begins_slice(uint at)
{
    uint slice = at < TILE_KEYS ? keys[at] >> 16 : NO_SLICE;
    return slice != NO_SLICE && (at == 0u || keys[at - 1u] >> 16 != slice);
}

// Keeps one key of each slice, from the first on, and gives how many there are. A thread takes keys that follow each other.
uint compact_keys()
{
    uint thread = gl_LocalInvocationID.x, first = thread * OWN;
    uint there = 0u;
    uint kept[OWN];
    for (uint i = 0u; i < OWN; ++i)
        if (begins_slice(first + i))
            kept[there++] = keys[first + i];
    sums[thread] = there;
    barrier();
    for (uint reach = 1u; reach < SORT_TILE_WORKGROUP; reach <<= 1) {
        uint before = thread >= reach ? sums[thread - reach] : 0u;
        barrier();
        sums[thread] += before;
        barrier();
    }
    for (uint i = 0u; i < there; ++i)
        keys[sums[thread] - there + i] = kept[i];
    barrier();
    return sums[SORT_TILE_WORKGROUP - 1u];
}

// Whether a slice is among the first `there` keys, which are of one slice each.
bool holds_sample(uint slice, uint there)
{
    uint place = keys_below(0u, there, slice << 16);
    return place < there && keys[place] >> 16 == slice;
}

// Finds the slices that are marked and hold no sample.
void find_marked(uint tile, uint there)
{
    for (uint slice = gl_LocalInvocationID.x; slice < grid.dimensions.z; slice += SORT_TILE_WORKGROUP) {
        uint cluster = tile + grid.dimensions.x * grid.dimensions.y * slice;
        bool is_marked = (cluster_bits[cluster >> 5] & 1u << (cluster & 31u)) != 0u;
        if (is_marked && !holds_sample(slice, there)) {
            atomicOr(marked[slice >> 5], 1u << (slice & 31u));
            atomicAdd(marked_there, 1u);
        }
    }
    barrier();
}

// How many marked slices without samples lie before one.
uint marked_below(uint slice)
{
    uint below = 0u;
    if (marked_there > 0u) {
        for (uint word = 0u; word < slice >> 5; ++word)
            below += uint(bitCount(marked[word]));
        below += uint(bitCount(marked[slice >> 5] & (1u << (slice & 31u)) - 1u));
    }
    return below;
}

void main()
{
    ViewData view = views[push.view];
    uint thread = gl_LocalInvocationID.x;
    for (uint at = thread; at < TILE_KEYS; at += SORT_TILE_WORKGROUP)
        keys[at] = key_of_sample(view, at);
    for (uint word = thread; word < SORT_TILE_SLICES / 32u; word += SORT_TILE_WORKGROUP)
        marked[word] = 0u;
    if (thread == 0u)
        marked_there = 0u;
    barrier();
    for (uint width = 1u; width < TILE_KEYS; width *= 2u)
        merge_runs(width);
    uint there = compact_keys();
    uint tile = linear_cluster(uvec3(gl_WorkGroupID.xy, 0u));
    find_marked(tile, there);
    uint first = tile * grid.dimensions.z;
    for (uint place = thread; place < there; place += SORT_TILE_WORKGROUP) {
        uint slice = keys[place] >> 16;
        tile_slices[first + place + marked_below(slice)] = slice;
    }
    if (marked_there > 0u)
        for (uint slice = thread; slice < grid.dimensions.z; slice += SORT_TILE_WORKGROUP)
            if ((marked[slice >> 5] & 1u << (slice & 31u)) != 0u)
                tile_slices[first + marked_below(slice) + keys_below(0u, there, slice << 16)] = slice;
    if (thread == 0u)
        tile_counts[tile] = there + marked_there;
}
