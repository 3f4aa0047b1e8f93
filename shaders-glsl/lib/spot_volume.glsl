// What spot lights reach, against a cell in the clustering camera's space, beyond the sphere around it.
#pragma once

#include "lib/cone.glsl"
#include "lib/light_volume.glsl"

// What a spot light reaches, grown by what rounding may move it.
Sector sector_of_light(uint light)
{
    LightData place = read_light(light);
    SpotData spot = read_spot(light);
    precise vec3 apex = (grid.clustering_from_world * vec4(place.position, 1.0)).xyz;
    precise vec3 axis = mat3(grid.clustering_from_world) * spot.axis;
    precise float cosine = max(spot.cosine - COSINE_ROUNDING, 0.0);
    precise float square = (1.0 - cosine) * (1.0 + cosine);
    Sector sector = Sector(apex, place.r1, normalize(axis), sqrt(square), cosine);
    return grown_sector(sector, max(grid.slack, grid.slack_per_radius * place.r1));
}

// The cell, or the box that is tested in its place.
Solid solid_of_cell(CellBounds cell)
{
#if SPACE == SPACE_MODEL
    return solid_of_box(cell.centre, cell.half_extent, mat3(cell.axes[0], cell.axes[1], cell.axes[2]));
#elif BOXED || SPACE == SPACE_ORTHOGRAPHIC
    return solid_of_box(cell.centre, cell.half_extent, mat3(1.0));
#else
    return solid_of_piece(cell.low, cell.high, vec2(cell.z_near, cell.z_far));
#endif
}

// Whether a light is a spot whose cone misses the cell.
bool cone_misses(CellBounds cell, LightVolume volume)
{
    if (volume.kind != VOLUME_SECTOR)
        return false;
    Sector sector = sector_of_light(volume.light);
#if CONES == CONES_SEPARATING
    return sector_separates(solid_of_cell(cell), sector);
#else
    return !sector_meets(solid_of_cell(cell), sector);
#endif
}
