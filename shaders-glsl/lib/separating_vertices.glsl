// SAT-N and SAT-V: the axes from a sphere's centre to vertices of the cell.
//
// Vertices are taken relative to the centre: they are as small as the distances that matter, and so is their rounding.
// An axis to a vertex separates where all vertices project beyond the radius, for this one does so by its distance.
// A centre that is a vertex gives an axis without length, which separates nothing.
#pragma once

float lowest_projection(CellEnd end, vec3 axis)
{
    precise vec2 lowest = min(axis.xy * end.low, axis.xy * end.high);
    precise float projection = lowest.x + lowest.y + axis.z * end.z;
    return projection;
}

bool vertex_separates(CellEnd near, CellEnd far, vec3 vertex, float radius)
{
    precise float lowest = min(lowest_projection(near, vertex), lowest_projection(far, vertex));
    precise float reach = radius * sqrt(dot(vertex, vertex));
    return lowest > reach;
}

vec3 nearest_vertex(CellEnd end)
{
    return vec3(mix(end.high, end.low, lessThan(abs(end.low), abs(end.high))), end.z);
}

bool nearest_vertex_separates(CellBounds cell, vec4 sphere)
{
    CellEnd near = cell_end(cell, sphere.xyz, false);
    CellEnd far = cell_end(cell, sphere.xyz, true);
    vec3 of_near = nearest_vertex(near), of_far = nearest_vertex(far);
    precise vec2 squares = vec2(dot(of_near, of_near), dot(of_far, of_far));
    return vertex_separates(near, far, squares.x <= squares.y ? of_near : of_far, sphere.w);
}

bool vertices_separate(CellBounds cell, vec4 sphere)
{
    CellEnd near = cell_end(cell, sphere.xyz, false);
    CellEnd far = cell_end(cell, sphere.xyz, true);
    for (uint corner = 0u; corner < 8u; ++corner) {
        CellEnd end = (corner & 4u) == 0u ? near : far;
        vec3 vertex = vec3((corner & 1u) == 0u ? end.low.x : end.high.x, (corner & 2u) == 0u ? end.low.y : end.high.y, end.z);
        if (vertex_separates(near, far, vertex, sphere.w))
            return true;
    }
    return false;
}
