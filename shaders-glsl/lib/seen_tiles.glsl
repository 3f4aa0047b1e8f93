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

// Whether a triangle lies behind the eye, or beyond one side of the screen, by more than what rounding may have any tile find of it.
bool is_unseen(Triangle triangle)
{
    vec3 a = triangle.corners[0], b = triangle.corners[1], c = triangle.corners[2];
    Tile screen = Tile(grid.origin.xy, grid.origin.xy + grid.cell.xy * vec2(grid.dimensions.xy));
    vec4 nearest = max(max(tile_distances(a, screen), tile_distances(b, screen)), tile_distances(c, screen));
    float size = max(max(size_in_tile(a, screen), size_in_tile(b, screen)), size_in_tile(c, screen));
    float slack = 8.0 * SHELL_ROUNDING * size;
    bool is_behind = min(min(a.z, b.z), c.z) * min(grid.cell.x, grid.cell.y) > slack;
    // Sides of tiles tell what lies behind the eye from what lies before it the worse, the more of them there are.
    return is_behind || least_of(nearest) < -slack * float(max(grid.dimensions.x, grid.dimensions.y));
}

// The tiles of both, and those between.
TileRange joined_tiles(TileRange a, TileRange b)
{
    return TileRange(min(a.first, b.first), max(a.end, b.end));
}

const TileRange NO_TILES = TileRange(uvec2(0u), uvec2(0u));

// The tiles in which a triangle may be seen.
TileRange tiles_of_triangle(Triangle triangle)
{
    if (is_unseen(triangle))
        return NO_TILES;
    TileRange of_two = joined_tiles(tiles_of(triangle.corners[0]), tiles_of(triangle.corners[1]));
    return joined_tiles(of_two, tiles_of(triangle.corners[2]));
}
