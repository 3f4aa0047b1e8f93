// Light against cell, or against what the cell's samples take of it: what decides whether a light gets onto a cell's list. Its volume is a sphere: (centre in the
// clustering camera's space, radius). The test is the variant's, put together from these parts (Enhuber sections 2.6, 3.5.2):
//
//   TEST_HS       half spaces: the centre lies within the cell's six planes, moved out by the radius
//   TEST_SAT_*    no separating axis among the edges (E), the planes' normals (P), and the axes from the centre to each
//                 vertex (V) or to the nearest one (N)
//   TEST_MM       the rectangle in which the sphere is seen meets the cell's, and its depths those of the cell (Mara and McGuire)
//   TEST_NEAREST  the nearest point of the cell lies in the sphere: exact
//   BOXED         of the box around the cell, instead of it (Ortiz): conservative
//
// Of a spot light, which is tested as the sphere around what it reaches, CONES says what is asked besides: nothing, some axes
// that may separate its cone from the cell, or whether they have a point in common (lib/cone.glsl).
//
// The cheap parts come first. Every step is `precise`: all ways of assignment get the same answer, to the bit. Any axis
// that separates proves that the two do not meet, so rounding of an axis costs nothing but a false positive; rounding
// of what is projected to it is covered by the slack of the radii, as that of planes is.
//
// What passes half spaces, normals, the rectangle or the nearest point lies within the planes moved out: ranges (lib/cell_range.glsl)
// and nodes (meets_grown) are cut by these. Nothing so simple bounds the other axes alone (TEST_BOUNDED 0): there,
// nothing is cut.
#pragma once

#include "lib/cluster_space.glsl"
#include "lib/light_volume.glsl"
#include "lib/normal_cones.glsl"

// Rounding of distances from a range of cells against those from its cells, in parts of the coordinates.
const float RANGE_ROUNDING = 4e-6;

#if BOXED
#include "lib/cell_boxed.glsl"
#elif SPACE == SPACE_PERSPECTIVE
#include "lib/cell_frustum.glsl"
#elif SPACE == SPACE_MODEL
#include "lib/cell_model.glsl"
#else
#include "lib/cell_box.glsl"
#endif
#if TEST_MM
#include "lib/projected_sphere.glsl"
#endif
#if TEST_SAT_N || TEST_SAT_V
#include "lib/separating_vertices.glsl"
#endif
#if CONES != CONES_UNASKED
#include "lib/spot_volume.glsl"
#endif

// What of a visible cluster is tested against lights, where it holds samples.
CellBounds bounds_of_visible(uint visible)
{
    uvec3 cell = cell_of_linear(visible_clusters[visible]);
#if BOUNDS == BOUNDS_CELL
    return range_bounds(cell, cell);
#else
    return measured_bounds(visible, cell);
#endif
}

bool sphere_meets(CellBounds cell, vec4 sphere)
{
#if TEST_MM
    return meets_seen(cell, sphere, seen_rectangle(sphere));
#endif
#if TEST_HS || TEST_SAT_P
    if (!within_planes(cell, sphere))
        return false;
#endif
#if TEST_SAT_P
    if (normals_separate(cell, sphere))
        return false;
#endif
#if TEST_SAT_E
    if (edges_separate(cell, sphere))
        return false;
#endif
#if TEST_SAT_N
    if (nearest_vertex_separates(cell, sphere))
        return false;
#endif
#if TEST_SAT_V
    if (vertices_separate(cell, sphere))
        return false;
#endif
#if TEST_NEAREST
    return nearest_point_within(cell, sphere);
#else
    return true;
#endif
}

// Whether some volume whose sphere meets a cell is left out all the same.
#define LEAVES_OUT (BOUNDS == BOUNDS_BOX && SPACE == SPACE_PERSPECTIVE && !BOXED || CONES != CONES_UNASKED || NORMAL_CONES)

// Whether a volume whose sphere meets a visible cluster's cell is left out all the same: by the cell's own planes, where a part of it
// is tested, by its cone, or because its light lies behind all samples. Few spheres meet, so that this stands apart.
bool is_left_out(uint visible, CellBounds cell, LightVolume volume)
{
#if TEST_HS || TEST_SAT_P
    if (beyond_cell(cell, bounding_sphere(volume)))
        return true;
#endif
#if CONES != CONES_UNASKED
    if (cone_misses(cell, volume))
        return true;
#endif
#if NORMAL_CONES
    if (is_behind(visible, volume)) {
        // Lists that are written pair by pair are found twice.
#if !WRITE_LISTS
        count(COUNTER_LIGHTS_SKIPPED, 1u);
#endif
        return true;
    }
#endif
    return false;
}

// Whether a light's volume meets a visible cluster's cell. Every kind (VOLUME_*) lies in its bounding sphere.
bool meets(uint visible, CellBounds cell, LightVolume volume)
{
    return sphere_meets(cell, bounding_sphere(volume)) && !is_left_out(visible, cell, volume);
}

// Whether a light may meet some cell of a range that `range` bounds.
bool may_meet_range(CellBounds range, LightVolume volume)
{
#if TEST_BOUNDED
    return may_be_within_planes(range, bounding_sphere(volume));
#else
    return true;
#endif
}

// Whether a sphere whose centre lies anywhere in a box may meet the cell; `sphere` has the box's centre.
bool meets_grown(CellBounds cell, vec4 sphere, vec3 half_extent)
{
#if SPACE == SPACE_MODEL
    return nearest_point_within_grown(cell, sphere, half_extent);
#elif !TEST_BOUNDED
    return true;
#elif (SPACE == SPACE_ORTHOGRAPHIC || BOXED) && TEST_NEAREST
    return nearest_point_within(CellBounds(cell.centre, cell.half_extent + half_extent), sphere);
#else
    return within_planes_grown(cell, sphere, half_extent);
#endif
}
