// The tiles of a grid in which points, and what lies between them, may be seen.
#pragma once

#include "lib/shell.glsl"

// The first tile and the one behind the last, along x and y.
struct TileRange {
    uvec2 first, end;
};

// All tiles where the point does not lie before the eye. What is left out is farther from it than what rounding may take.
TileRange tiles_of(vec3 point)
{
    // Nearer to the plane of the eye, tangents may have no end.
    if (point.z > -1e-20)
        return TileRange(uvec2(0u), grid.dimensions.xy);
    const float TILE_ROUNDING = 1e-2;
    vec2 tangents = point.xy / -point.z;
    vec2 slack = vec2(8.0 * SHELL_ROUNDING * (1.0 + abs(tangents.x) + abs(tangents.y)));
    vec2 most = vec2(grid.dimensions.xy);
    vec2 first = clamp(floor((tangents - slack - grid.origin.xy) / grid.cell.xy - TILE_ROUNDING), vec2(0.0), most);
    vec2 end = clamp(ceil((tangents + slack - grid.origin.xy) / grid.cell.xy + TILE_ROUNDING), first, most);
    return TileRange(uvec2(first), uvec2(end));
}

// The tiles of both, and those between.
TileRange joined_tiles(TileRange a, TileRange b)
{
    return TileRange(min(a.first, b.first), max(a.end, b.end));
}
