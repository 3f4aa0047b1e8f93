// What a spot light reaches against a cell: separating axes, and exact. The same as geometry/hexahedron.rs has in double precision,
// which tells why.
//
// A cell is a solid of eight corners, made of a piece of a frustum or of a box. A sector is grown by the slack that covers the rounding
// of places (grown_sector); what is in the tests themselves is covered here: rounding never takes a light from a cell, and may leave
// it one that ends just before it. Every step is `precise`: all ways of assignment get the same answer, to the bit.
#pragma once

// The points up to `range` from the apex whose direction is within an angle of the axis.
struct Sector {
    vec3 apex;
    float range; // metres
    vec3 axis;   // unit
    float sine, cosine; // of the angle, at most a right one
};

// Corners, of which bit 0, 1 and 2 of the index choose the upper side along x, y and z, and planes by unit normals, inwards.
struct Solid {
    vec3 corners[8];
    vec4 planes[6];
};

// What is added to results that rounding may have made too small, in parts of what is in them.
const float CONE_ROUNDING = 1e-6;
const float NOWHERE = 3e38; // metres: as far away as nothing is

// The solid between tangents and between two z, whose side planes lead through the eye: the near end before the far one.
Solid solid_of_piece(vec2 low, vec2 high, vec2 ends)
{
    Solid solid;
    for (uint corner = 0u; corner < 8u; ++corner) {
        float z = (corner & 4u) == 0u ? ends.x : ends.y;
        precise vec2 place = -z * vec2((corner & 1u) == 0u ? low.x : high.x, (corner & 2u) == 0u ? low.y : high.y);
        solid.corners[corner] = vec3(place, z);
    }
    solid.planes[0] = vec4(normalize(vec3(1.0, 0.0, low.x)), 0.0);
    solid.planes[1] = vec4(-normalize(vec3(1.0, 0.0, high.x)), 0.0);
    solid.planes[2] = vec4(normalize(vec3(0.0, 1.0, low.y)), 0.0);
    solid.planes[3] = vec4(-normalize(vec3(0.0, 1.0, high.y)), 0.0);
    solid.planes[4] = vec4(0.0, 0.0, 1.0, -ends.y);
    solid.planes[5] = vec4(0.0, 0.0, -1.0, ends.x);
    return solid;
}

// The solid of a box along unit and perpendicular axes.
Solid solid_of_box(vec3 centre, vec3 half_extent, mat3 axes)
{
    Solid solid;
    for (uint corner = 0u; corner < 8u; ++corner) {
        vec3 upper = vec3(corner & 1u, corner >> 1 & 1u, corner >> 2) * 2.0 - 1.0;
        precise vec3 place = centre + axes * (upper * half_extent);
        solid.corners[corner] = place;
    }
    for (uint side = 0u; side < 6u; ++side) {
        uint axis = side >> 1;
        vec3 normal = (side & 1u) == 0u ? axes[axis] : -axes[axis];
        precise float offset = half_extent[axis] - dot(normal, centre);
        solid.planes[side] = vec4(normal, offset);
    }
    return solid;
}

// A sector that holds every point up to `slack` metres from this one.
Sector grown_sector(Sector sector, float slack)
{
    precise float back = slack / sector.sine;
    precise vec3 apex = sector.apex - sector.axis * back;
    precise float range = sector.range + slack + back;
    return Sector(apex, range, sector.axis, sector.sine, sector.cosine);
}

// The solid as seen from the apex.
Solid from_apex(Solid cell, Sector sector)
{
    for (uint corner = 0u; corner < 8u; ++corner) {
        precise vec3 place = cell.corners[corner] - sector.apex;
        cell.corners[corner] = place;
    }
    for (uint side = 0u; side < 6u; ++side) {
        precise float offset = dot(cell.planes[side].xyz, sector.apex) + cell.planes[side].w;
        cell.planes[side].w = offset;
    }
    return cell;
}

// Metres that no coordinate which is in the tests exceeds.
float size_of_pair(Solid cell, Sector sector)
{
    float size = sector.range + dot(abs(sector.apex), vec3(1.0));
    for (uint corner = 0u; corner < 8u; ++corner)
        size = max(size, dot(abs(cell.corners[corner]), vec3(1.0)));
    return size;
}

// The unit direction across the axis of a vector; any where that has none.
vec3 across_axis(Sector sector, vec3 vector)
{
    precise vec3 across = vector - sector.axis * dot(sector.axis, vector);
    precise float square = dot(across, across);
    vec3 other = abs(sector.axis.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    if (square <= 1e-12 * dot(vector, vector))
        across = other;
    // Again, for what little is left along the axis is all the more of it, the less there is across.
    across = normalize(across);
    precise vec3 cleaned = across - sector.axis * dot(sector.axis, across);
    return normalize(cleaned);
}

// How far a unit direction and the direction within the cone that is nearest to it agree: the cosine of their angle.
float nearest_in_cone(Sector sector, vec3 direction, out vec3 nearest)
{
    precise float along = dot(sector.axis, direction);
    precise vec3 across = direction - sector.axis * along;
    precise vec3 side = sector.axis * sector.cosine + across_axis(sector, direction) * sector.sine;
    nearest = sqrt(dot(across, across)) * sector.cosine <= along * sector.sine ? direction : side;
    precise float agreement = dot(direction, nearest);
    return agreement;
}

// How far the sector reaches along a unit direction from its apex, metres.
float reach_along(Sector sector, vec3 direction)
{
    vec3 nearest;
    return sector.range * max(nearest_in_cone(sector, direction, nearest), 0.0);
}

float lowest_corner(Solid cell, vec3 axis)
{
    float lowest = NOWHERE;
    for (uint corner = 0u; corner < 8u; ++corner) {
        precise float along = dot(axis, cell.corners[corner]);
        lowest = min(lowest, along);
    }
    return lowest;
}

// Whether all of the cell lies beyond the side of the cone that faces a point; a point on the axis faces none.
bool side_separates(Solid cell, Sector sector, vec3 point, float slack)
{
    precise vec3 normal = across_axis(sector, point) * sector.cosine - sector.axis * sector.sine;
    return lowest_corner(cell, normal) > slack;
}

// Whether some axis separates the cell from the sector: the normals of its faces, the sector's axis, that from the apex to the
// cell's middle, and those across the sides of the cone that face its corners and its middle.
bool sector_separates(Solid asked, Sector sector)
{
    float slack = CONE_ROUNDING * size_of_pair(asked, sector);
    Solid cell = from_apex(asked, sector);
    bool separates = lowest_corner(cell, -sector.axis) > slack || lowest_corner(cell, sector.axis) > sector.range + slack;
    for (uint side = 0u; side < 6u; ++side)
        separates = separates || cell.planes[side].w + reach_along(sector, cell.planes[side].xyz) < -slack;
    vec3 middle = vec3(0.0);
    for (uint corner = 0u; corner < 8u; ++corner) {
        separates = separates || side_separates(cell, sector, cell.corners[corner], slack);
        middle += 0.125 * cell.corners[corner];
    }
    float away = sqrt(dot(middle, middle));
    vec3 towards = away > 0.0 ? middle / away : sector.axis;
    separates = separates || lowest_corner(cell, towards) > reach_along(sector, towards) + slack;
    return separates || side_separates(cell, sector, middle, slack);
}

// Distance of the plane of a face along the cone's most direct ray, where that hits within the face.
float through_face(Solid cell, Sector sector, uint side, float slack)
{
    vec4 plane = cell.planes[side];
    vec3 ray;
    float slope = nearest_in_cone(sector, plane.xyz, ray);
    if (plane.w >= 0.0 || slope <= 0.0)
        return NOWHERE;
    precise float away = -plane.w / slope;
    bool inside = true;
    for (uint other = 0u; other < 6u; ++other) {
        precise float within = dot(cell.planes[other].xyz, ray) * away + cell.planes[other].w;
        inside = inside && within >= -slack;
    }
    return inside ? away : NOWHERE;
}

// Whether a point lies within the endless cone.
bool within_cone(Sector sector, vec3 point, float slack)
{
    precise float along = dot(sector.axis, point);
    precise vec3 across = point - sector.axis * along;
    precise float beyond = sector.cosine * sqrt(dot(across, across)) - sector.sine * along;
    return beyond <= slack;
}

// Distance of the nearest point of an edge within the cone.
float along_edge(Sector sector, vec3 from, vec3 to, float slack)
{
    precise vec3 edge = to - from;
    precise vec2 along = vec2(dot(sector.axis, from), dot(sector.axis, edge));
    precise vec3 across = from - sector.axis * along.x;
    precise vec3 across_edge = edge - sector.axis * along.y;
    float ss = sector.sine * sector.sine, cc = sector.cosine * sector.cosine;
    precise float a = ss * along.y * along.y - cc * dot(across_edge, across_edge);
    precise float b = ss * along.x * along.y - cc * dot(across, across_edge);
    precise float c = ss * along.x * along.x - cc * dot(across, across);
    // b^2 - a c, with what is in both left out.
    precise vec3 tilt = across_edge * along.x - across * along.y;
    precise float turn = dot(sector.axis, cross(across, across_edge));
    precise vec2 parts = vec2(ss * dot(tilt, tilt), cc * turn * turn);
    precise float discriminant = cc * (parts.x - parts.y);
    float lost = 2.0 * CONE_ROUNDING * cc * (parts.x + parts.y);
    precise float root = sqrt(max(discriminant, 0.0));
    precise float sum = -(b + (b < 0.0 ? -root : root));
    precise vec2 zeros = vec2(sum / a, c / sum);
    float low = 2.0, high = -1.0;
    if (within_cone(sector, from, slack))
        low = high = 0.0;
    if (within_cone(sector, to, slack)) {
        low = min(low, 1.0);
        high = 1.0;
    }
    for (uint zero = 0u; zero < 2u; ++zero) {
        float t = zeros[zero];
        if (sum != 0.0 && discriminant >= -lost && t >= 0.0 && t <= 1.0 && along.x + along.y * t >= -slack) {
            low = min(low, t);
            high = max(high, t);
        }
    }
    // Without length, any place is the nearest.
    precise float square = dot(edge, edge);
    precise float t = square > 0.0 ? -dot(from, edge) / square : 0.0;
    t = min(max(t, low), high);
    precise vec3 nearest = from + edge * t;
    precise float away = sqrt(dot(nearest, nearest));
    return low <= high ? away : NOWHERE;
}

// Whether the cell and the sector have a point in common: the cell's nearest point to the apex, of all within the cone, lies in range.
bool sector_meets(Solid asked, Sector sector)
{
    float slack = CONE_ROUNDING * size_of_pair(asked, sector);
    Solid cell = from_apex(asked, sector);
    bool around_apex = true;
    float least = NOWHERE;
    for (uint side = 0u; side < 6u; ++side) {
        around_apex = around_apex && cell.planes[side].w >= -slack;
        least = min(least, through_face(cell, sector, side, slack));
    }
    for (uint edge = 0u; edge < 12u; ++edge) {
        // Along x, y, z: the corner's other two bits count.
        uint axis = edge >> 2, others = edge & 3u;
        uint below = others & ((1u << axis) - 1u);
        uint corner = (others ^ below) << 1 | below;
        least = min(least, along_edge(sector, cell.corners[corner], cell.corners[corner | 1u << axis], slack));
    }
    return around_apex || least <= sector.range + slack;
}
