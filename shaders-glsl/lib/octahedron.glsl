// Directions as points of an octahedron unfolded to a square: two numbers from -1 to 1 (Meyer et al. 2010, On Floating-Point
// Normal Vectors).
#pragma once

// Each 1 or -1, where sign() has 0.
vec2 signs(vec2 v)
{
    return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

vec2 to_octahedron(vec3 direction)
{
    vec2 point = direction.xy / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    return direction.z >= 0.0 ? point : (1.0 - abs(point.yx)) * signs(point);
}

// Unit length.
vec3 from_octahedron(vec2 point)
{
    vec3 direction = vec3(point, 1.0 - abs(point.x) - abs(point.y));
    direction.xy -= max(-direction.z, 0.0) * signs(point);
    return normalize(direction);
}
