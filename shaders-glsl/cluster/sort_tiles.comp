// Which slices of a tile hold samples, by sorting these (Tegelaers section 6.2); a workgroup takes a tile.
//
//   samples ──> keys (slice, sample) ──merge sort──> ascending ──compact──> slices, each once ─┬─> tile_slices, tile_counts
//   slices marked by transparent geometry, which depth does not show ──────────────────────────┘
//
// The sort is a merge from the bottom up. A thread takes UNIT keys at a time: it sorts them alone at first, and at every width of
// runs it finds by bisection where those begin which it merges to its place, so that all threads are busy at every width.
#version 460
#include "lib/cluster_space.glsl"
#include "lib/sample_positions.glsl"
#extension GL_EXT_control_flow_attributes : require

layout(local_size_x = TILE_THREADS) in;

const uint SAMPLES_THERE = TILE_PIXELS * TILE_PIXELS * SAMPLES;
// Keys of a thread.
const uint OWN = (TILE_KEYS + TILE_THREADS - 1u) / TILE_THREADS;
// Keys that a thread sorts, or merges, at a time.
const uint UNIT = min(8u, TILE_KEYS);
const uint OWN_UNITS = (OWN + UNIT - 1u) / UNIT;
// The slice of what is no sample: behind all others.
const uint NO_SLICE = 0xFFFFu;

shared uint keys[TILE_KEYS];
shared uint sums[TILE_THREADS];
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

// How many of the first `there` keys, which ascend, are less than `key`.
uint keys_below(uint there, uint key)
{
    uint low = 0u, high = there;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (keys[middle] < key)
            low = middle + 1u;
        else
            high = middle;
    }
    return low;
}

// Sorts each unit by itself.
void sort_units()
{
    for (uint first = gl_LocalInvocationID.x * UNIT; first < TILE_KEYS; first += TILE_THREADS * UNIT) {
        uint unit[UNIT];
        [[unroll]] for (uint i = 0u; i < UNIT; ++i)
            unit[i] = keys[first + i];
        [[unroll]] for (uint end = UNIT - 1u; end > 0u; --end)
            [[unroll]] for (uint i = 0u; i < end; ++i) {
                uint least = min(unit[i], unit[i + 1u]), most = max(unit[i], unit[i + 1u]);
                unit[i] = least;
                unit[i + 1u] = most;
            }
        [[unroll]] for (uint i = 0u; i < UNIT; ++i)
            keys[first + i] = unit[i];
    }
    barrier();
}

// How many keys of the first of two runs are among the least `both` of the two, which begin at `run`.
uint keys_of_first(uint run, uint width, uint both)
{
    uint low = max(both, width) - width, high = min(both, width);
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (keys[run + middle] < keys[run + width + both - 1u - middle])
            low = middle + 1u;
        else
            high = middle;
    }
    return low;
}

// Merges runs two by two.
void merge_runs(uint width)
{
    uint merged[OWN_UNITS * UNIT];
    [[unroll]] for (uint own = 0u; own < OWN_UNITS; ++own) {
        uint at = (gl_LocalInvocationID.x + own * TILE_THREADS) * UNIT;
        if (at < TILE_KEYS) {
            uint run = at & ~(2u * width - 1u);
            uint first = keys_of_first(run, width, at - run);
            uint second = at - run - first;
            [[unroll]] for (uint i = 0u; i < UNIT; ++i) {
                uint a = keys[run + min(first, width - 1u)], b = keys[run + width + min(second, width - 1u)];
                bool takes_first = second >= width || (first < width && a < b);
                merged[own * UNIT + i] = takes_first ? a : b;
                first += uint(takes_first);
                second += uint(!takes_first);
            }
        }
    }
    barrier();
    [[unroll]] for (uint own = 0u; own < OWN_UNITS; ++own) {
        uint at = (gl_LocalInvocationID.x + own * TILE_THREADS) * UNIT;
        if (at < TILE_KEYS)
            [[unroll]] for (uint i = 0u; i < UNIT; ++i)
                keys[at + i] = merged[own * UNIT + i];
    }
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
    for (uint reach = 1u; reach < TILE_THREADS; reach <<= 1) {
        uint before = thread >= reach ? sums[thread - reach] : 0u;
        barrier();
        sums[thread] += before;
        barrier();
    }
    for (uint i = 0u; i < there; ++i)
        keys[sums[thread] - there + i] = kept[i];
    barrier();
    return sums[TILE_THREADS - 1u];
}

// Whether a slice is among the first `there` keys, which are of one slice each.
bool holds_sample(uint slice, uint there)
{
    uint place = keys_below(there, slice << 16);
    return place < there && keys[place] >> 16 == slice;
}

// Finds the slices that are marked and hold no sample.
void find_marked(uint tile, uint there)
{
    for (uint slice = gl_LocalInvocationID.x; slice < grid.dimensions.z; slice += TILE_THREADS) {
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
    for (uint at = thread; at < TILE_KEYS; at += TILE_THREADS)
        keys[at] = key_of_sample(view, at);
    for (uint word = thread; word < SORT_TILE_SLICES / 32u; word += TILE_THREADS)
        marked[word] = 0u;
    if (thread == 0u)
        marked_there = 0u;
    barrier();
    sort_units();
    for (uint width = UNIT; width < TILE_KEYS; width *= 2u)
        merge_runs(width);
    uint there = compact_keys();
    uint tile = linear_cluster(uvec3(gl_WorkGroupID.xy, 0u));
    find_marked(tile, there);
    uint first = tile * grid.dimensions.z;
    for (uint place = thread; place < there; place += TILE_THREADS) {
        uint slice = keys[place] >> 16;
        tile_slices[first + place + marked_below(slice)] = slice;
    }
    if (marked_there > 0u)
        for (uint slice = thread; slice < grid.dimensions.z; slice += TILE_THREADS)
            if ((marked[slice >> 5] & 1u << (slice & 31u)) != 0u)
                tile_slices[first + marked_below(slice) + keys_below(there, slice << 16)] = slice;
    if (thread == 0u)
        tile_counts[tile] = there + marked_there;
}
