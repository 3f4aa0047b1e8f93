// Normal cones (Tegelaers section 4.3): which ways the samples of a visible cluster face, a bit for each cone of directions, and
// whether a light lies behind all of them. NORMAL_CONES is into how many squares, along a side, each face of a cube is divided;
// a square's cone holds all directions through it. Normals and lights are in the clustering camera's space.
//
//   cluster_cones  CONE_WORDS words a visible cluster
//
// A sample whose normal has no direction sets all bits; what no light is evaluated for sets none.
#pragma once

#include "lib/counters.glsl"
#include "lib/measured_bounds.glsl"

#if NORMAL_CONES

#extension GL_EXT_control_flow_attributes : require

const uint CONE_COUNT = 6u * NORMAL_CONES * NORMAL_CONES;
const uint CONE_WORDS = (CONE_COUNT + 31u) / 32u;

// Sets the bits of some cones of a visible cluster. Reading first spares most atomics.
void add_cones(uint at, uint bits)
{
    if ((cluster_cones[at] & bits) != bits)
        atomicOr(cluster_cones[at], bits);
}

// Lets the cones of a visible cluster hold a unit normal.
void include_normal(uint visible, vec3 normal)
{
    uint at = visible * CONE_WORDS;
    if (!(dot(normal, normal) > 0.5)) {
        for (uint word = 0u; word < CONE_WORDS; ++word)
            add_cones(at + word, 0xFFFFFFFFu);
        return;
    }
    vec3 extent = abs(normal);
    uint axis = extent.x >= extent.y && extent.x >= extent.z ? 0u : extent.y >= extent.z ? 1u : 2u;
    vec2 place = vec2(normal[(axis + 1u) % 3u], normal[(axis + 2u) % 3u]) / extent[axis];
    uvec2 square = min(uvec2((place + 1.0) * (0.5 * NORMAL_CONES)), uvec2(NORMAL_CONES - 1u));
    uint face = 2u * axis + uint(normal[axis] < 0.0);
    uint cone = (face * NORMAL_CONES + square.y) * NORMAL_CONES + square.x;
    add_cones(at + (cone >> 5), 1u << (cone & 31u));
}

// Sine and cosine of the half angle of each cone of a face.
const vec2 SPREADS[NORMAL_CONES * NORMAL_CONES] = vec2[](CONE_SPREADS);

vec3 cone_axis(uint cone)
{
    uint face = cone / (NORMAL_CONES * NORMAL_CONES), axis = face / 2u;
    uvec2 square = uvec2(cone % NORMAL_CONES, cone / NORMAL_CONES % NORMAL_CONES);
    vec2 across = (vec2(2u * square) + 1.0) / float(NORMAL_CONES) - 1.0;
    vec3 direction;
    direction[axis] = (face & 1u) == 0u ? 1.0 : -1.0;
    direction[(axis + 1u) % 3u] = across.x;
    direction[(axis + 2u) % 3u] = across.y;
    return normalize(direction);
}

// The ball around the samples of a visible cluster: (centre, radius).
vec4 ball_of_samples(uint visible)
{
#if BOUNDS == BOUNDS_DEPTH
    uvec2 tile = cell_of_linear(visible_clusters[visible]).xy;
    precise vec2 low = grid.origin.xy + grid.cell.xy * vec2(tile), high = grid.origin.xy + grid.cell.xy * vec2(tile + 1u);
    precise vec2 depths = vec2(low_bound(visible, 0u), high_bound(visible, 0u));
#else
    precise vec2 low = vec2(low_bound(visible, 0u), low_bound(visible, 1u));
    precise vec2 high = vec2(high_bound(visible, 0u), high_bound(visible, 1u));
    precise vec2 depths = vec2(low_bound(visible, 2u), high_bound(visible, 2u));
#endif
#if SPACE == SPACE_PERSPECTIVE
    precise vec2 lowest = min(low * depths.x, low * depths.y), highest = max(high * depths.x, high * depths.y);
    precise vec3 centre = vec3(0.5 * (lowest + highest), -0.5 * (depths.x + depths.y));
    precise vec3 extent = vec3(0.5 * (highest - lowest), 0.5 * (depths.y - depths.x));
#else
    precise vec3 centre = vec3(0.5 * (low + high), 0.5 * (depths.x + depths.y));
    precise vec3 extent = vec3(0.5 * (high - low), 0.5 * (depths.y - depths.x));
#endif
    return vec4(centre, length(extent));
}

// Of distances that cosines are compared in; the steps here round by less than half of it.
const float FACING_ROUNDING = 4e-6;

// Where a light stands: a spot at the apex of what it reaches, any other in the middle of its sphere.
vec3 place_of(LightVolume volume)
{
    precise vec3 place = (grid.clustering_from_world * vec4(read_light(volume.light).position, 1.0)).xyz;
    return place;
}

// Whether a light lies behind all samples of a visible cluster: for no position in their ball and no normal in
// their cones is n.l above 0. The ball grows by the slack that covers the rounding of positions. There is no loop, but what is
// unrolled: lavapipe ends a shader's loops after 65 535 turns of all of them, and axes are constants.
bool is_behind(uint visible, LightVolume light)
{
    precise vec4 ball = ball_of_samples(visible);
    precise vec3 towards = place_of(light) - ball.xyz;
    precise float radius = ball.w + max(grid.slack, grid.slack_per_radius * light.radius);
    precise float square = dot(towards, towards);
    precise float away = sqrt(square);
    precise float along = sqrt(max(square - radius * radius, 0.0));
    precise float rounding = FACING_ROUNDING * (away + radius);
    uint faced = uint(away <= radius);
    uint words[CONE_WORDS];
    [[unroll]] for (uint word = 0u; word < CONE_WORDS; ++word)
        words[word] = cluster_cones[visible * CONE_WORDS + word];
    [[unroll]] for (uint cone = 0u; cone < CONE_COUNT; ++cone) {
        vec2 spread = SPREADS[cone % (NORMAL_CONES * NORMAL_CONES)];
        precise float behind = -(spread.x * along + spread.y * radius);
        precise float before = dot(cone_axis(cone), towards);
        // Where half angle and ball together make a right angle, normals face all ways.
        uint facing = uint(radius >= away * spread.y) | uint(before >= behind - rounding);
        faced |= words[cone >> 5] >> (cone & 31u) & facing;
    }
    return faced == 0u;
}

#endif
