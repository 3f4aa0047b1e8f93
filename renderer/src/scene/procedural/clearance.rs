//! How far a point is from a scene's triangles.

use glam::{Mat4, Vec3};

use crate::scene::{Bounds, Primitive, Scene};

/// Distance in metres from `point` to the nearest triangle of the scene; infinite for an empty scene.
///
/// Brute force over the instances whose bounds are nearer than the best so far: meant for tests that a
/// recording flies through free space, not for a frame.
pub fn distance_to_geometry(scene: &Scene, point: Vec3) -> f32 {
    let mut candidates: Vec<(f32, usize)> = scene
        .instances
        .iter()
        .enumerate()
        .map(|(k, instance)| {
            let bounds = scene.primitives[instance.primitive as usize].bounds;
            (distance_to_bounds(&world_bounds(bounds, &instance.world_from_object.as_mat4()), point), k)
        })
        .collect();
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best = f32::INFINITY;
    for (lower_bound, k) in candidates {
        if lower_bound >= best {
            break;
        }
        let instance = &scene.instances[k];
        let primitive = &scene.primitives[instance.primitive as usize];
        best =
            best.min(distance_to_primitive(scene, primitive, &instance.world_from_object.as_mat4(), point));
    }
    best
}

fn world_bounds(bounds: Bounds, world_from_object: &Mat4) -> Bounds {
    let (centre, half) = ((bounds.min + bounds.max) * 0.5, (bounds.max - bounds.min) * 0.5);
    let centre = world_from_object.transform_point3(centre);
    let axis = |k: usize| world_from_object.col(k).truncate().abs();
    let half = axis(0) * half.x + axis(1) * half.y + axis(2) * half.z;
    Bounds { min: centre - half, max: centre + half }
}

fn distance_to_bounds(bounds: &Bounds, point: Vec3) -> f32 {
    point.distance(point.clamp(bounds.min, bounds.max))
}

fn distance_to_primitive(scene: &Scene, primitive: &Primitive, world_from_object: &Mat4, point: Vec3) -> f32 {
    let first = primitive.first_index as usize;
    let world = |index: u32| {
        let vertex = &scene.vertices[(primitive.vertex_offset + index) as usize];
        world_from_object.transform_point3(vertex.position.into())
    };
    scene.indices[first..first + primitive.index_count as usize]
        .chunks_exact(3)
        .map(|corners| distance_to_triangle([0, 1, 2].map(|k| world(corners[k])), point))
        .fold(f32::INFINITY, f32::min)
}

/// The nearest point lies inside the triangle, if the point projects into it, or else on an edge.
fn distance_to_triangle([a, b, c]: [Vec3; 3], point: Vec3) -> f32 {
    let normal = (b - a).cross(c - a);
    let inside = |p: Vec3, q: Vec3| (q - p).cross(point - p).dot(normal) >= 0.0;
    if normal.length_squared() > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return (point - a).dot(normal).abs() / normal.length();
    }
    distance_to_segment(a, b, point)
        .min(distance_to_segment(b, c, point))
        .min(distance_to_segment(c, a, point))
}

fn distance_to_segment(a: Vec3, b: Vec3, point: Vec3) -> f32 {
    let along = b - a;
    let length_squared = along.length_squared();
    let t =
        if length_squared > 0.0 { ((point - a).dot(along) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(a + along * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangle_distances() {
        let triangle = [Vec3::ZERO, Vec3::X * 2.0, Vec3::Y * 2.0];
        for (point, expected) in [
            (Vec3::new(0.5, 0.5, 3.0), 3.0),
            (Vec3::new(-3.0, -4.0, 0.0), 5.0),
            (Vec3::new(1.0, -2.0, 0.0), 2.0),
            (Vec3::new(2.0, 2.0, 0.0), 2.0_f32.sqrt()),
        ] {
            assert!((distance_to_triangle(triangle, point) - expected).abs() < 1e-6, "{point}");
        }
    }
}
