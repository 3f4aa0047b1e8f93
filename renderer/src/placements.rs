//! Where instances are: in f64 on the host, relative to a frame's origin on the device. Pure.
//!
//! A primitive that lies far from its object's own origin is moved there, and its instances are moved back: what single
//! precision holds of its vertices is then fine, and the matrices are in f64.

use crate::culling::WorldBox;
use crate::draw_list::Batches;
use crate::geometry::OrientedBox;
use crate::gpu_interface::{InstanceData, ModelBox};
use crate::scene::{Bounds, Primitive, Scene, Vertex};
use glam::{DMat4, DVec3, Vec3};
use std::borrow::Cow;

/// A primitive is moved where all of it is farther than this from its object's origin, metres.
const FAR: f32 = 1024.0;

/// An instance as it is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Affine; of the vertices as [`near_vertices`] has them.
    world_from_object: DMat4,
    bounds: WorldBox,
}

impl Placement {
    /// The instance as shaders read it in a frame with this origin (metres).
    pub fn data(&self, origin: DVec3) -> InstanceData {
        let mut matrix = self.world_from_object;
        matrix.w_axis -= origin.extend(0.0);
        InstanceData {
            world_from_object: matrix.as_mat4().to_cols_array_2d(),
            box_center: (self.bounds.center - origin).as_vec3().to_array(),
            box_half_extent: self.bounds.half_extent.as_vec3().to_array(),
            ..Default::default()
        }
    }

    /// No point of it is farther than this from `origin`, metres.
    pub fn reach(&self, origin: DVec3) -> f64 {
        self.bounds.reach(origin)
    }
}

/// The point that boxes of models on the device are relative to, given the lowest and the highest corner of the scene, metres.
pub fn middle(scene: Option<(DVec3, DVec3)>) -> DVec3 {
    scene.map_or(DVec3::ZERO, |(low, high)| 0.5 * (low + high))
}

/// Boxes around the scene's models in drawing order, relative to `middle` (metres).
pub fn model_boxes(scene: &Scene, batches: &Batches, middle: DVec3) -> Vec<ModelBox> {
    let boxed = |&index: &u32| {
        let instance = &scene.instances[index as usize];
        let bounds = &scene.primitives[instance.primitive as usize].bounds;
        let (OrientedBox { center, half_extent, axes }, _) = OrientedBox::around(instance, bounds);
        ModelBox {
            centre: (center - middle).as_vec3().to_array(),
            half_extent: half_extent.as_vec3().to_array(),
            axes: axes.map(|axis| axis.as_vec3().to_array()),
        }
    };
    batches.instances.iter().map(boxed).collect()
}

/// The scene's instances in drawing order.
pub fn placements(scene: &Scene, batches: &Batches) -> Vec<Placement> {
    let placement = |(&index, &bounds): (&u32, &WorldBox)| {
        let instance = &scene.instances[index as usize];
        let moved = moved_by(&scene.primitives[instance.primitive as usize]);
        let back = DMat4::from_translation(moved.as_dvec3());
        Placement { world_from_object: instance.world_from_object * back, bounds }
    };
    batches.instances.iter().zip(&batches.boxes).map(placement).collect()
}

/// The scene's vertices, those of primitives far from their object's origin moved to it.
pub fn near_vertices(scene: &Scene) -> Cow<'_, [Vertex]> {
    let mut vertices = Cow::Borrowed(scene.vertices.as_slice());
    for primitive in scene.primitives.iter().filter(|primitive| moved_by(primitive) != Vec3::ZERO) {
        let moved = moved_by(primitive).as_dvec3();
        let first = primitive.vertex_offset as usize;
        for vertex in &mut vertices.to_mut()[first..first + primitive.vertex_count as usize] {
            let far = Vec3::from(vertex.position).as_dvec3();
            vertex.position = (far - moved).as_vec3().to_array();
        }
    }
    vertices
}

/// The point of its object's space that becomes the origin of a primitive's vertices. None of them is then farther from it
/// than from where it was: what reaches from near to far stays.
fn moved_by(primitive: &Primitive) -> Vec3 {
    let Bounds { min, max } = primitive.bounds;
    let (middle, half) = (0.5 * min + 0.5 * max, 0.5 * max - 0.5 * min);
    let nearest = Vec3::ZERO.clamp(min, max).length();
    if nearest > FAR.max(half.length()) { middle } else { Vec3::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::procedural::by_name;

    /// A scene, and the same with everything a long way off: in its vertices, or in its matrices.
    fn scenes(away: DVec3) -> [Scene; 3] {
        let near = by_name("temple").unwrap();
        let (mut baked, mut placed) = (near.clone(), near.clone());
        for instance in &mut placed.instances {
            instance.world_from_object = DMat4::from_translation(away) * instance.world_from_object;
        }
        let shift = away.as_vec3();
        baked.vertices.iter_mut().for_each(|v| v.position = (Vec3::from(v.position) + shift).to_array());
        for primitive in &mut baked.primitives {
            primitive.bounds.min += shift;
            primitive.bounds.max += shift;
        }
        [near, placed, baked]
    }

    #[test]
    fn what_is_far_away_is_drawn_as_finely_as_what_is_near() {
        let away = DVec3::new(65_536.0, 0.0, -1_048_576.0);
        let [near, placed, _] = scenes(away);
        let data = |scene: &Scene, origin| -> Vec<InstanceData> {
            placements(scene, &Batches::new(scene)).iter().map(|p| p.data(origin)).collect()
        };
        for (a, b) in data(&near, DVec3::ZERO).iter().zip(data(&placed, away)) {
            let (a, b) = (bytemuck::bytes_of(a).to_vec(), bytemuck::bytes_of(&b).to_vec());
            let floats = |bytes: Vec<u8>| bytemuck::pod_collect_to_vec::<u8, f32>(&bytes);
            for (a, b) in floats(a).into_iter().zip(floats(b)) {
                assert!((a - b).abs() <= 1e-9 + a.abs() * f32::EPSILON, "{a} {b}");
            }
        }
    }

    #[test]
    fn what_reaches_from_near_to_far_stays() {
        let mut scene = by_name("temple").unwrap();
        scene.primitives[0].bounds = Bounds { min: Vec3::splat(1100.0), max: Vec3::splat(9000.0) };
        assert_eq!(moved_by(&scene.primitives[0]), Vec3::ZERO);
        scene.primitives[0].bounds.max = Vec3::splat(1200.0);
        assert_eq!(moved_by(&scene.primitives[0]), Vec3::splat(1150.0));
    }

    #[test]
    fn vertices_far_from_their_object_keep_their_place() {
        let [near, _, baked] = scenes(DVec3::new(20_000.0, 0.0, 0.0));
        assert!(matches!(near_vertices(&near), Cow::Borrowed(_)), "nothing near is touched");
        let vertices = near_vertices(&baked);
        let batches = Batches::new(&baked);
        for (&index, placement) in batches.instances.iter().zip(placements(&baked, &batches)) {
            let instance = &baked.instances[index as usize];
            let primitive = &baked.primitives[instance.primitive as usize];
            let at = primitive.vertex_offset as usize;
            let [before, after] =
                [&baked.vertices[at], &vertices[at]].map(|v| Vec3::from(v.position).as_dvec3());
            let place = instance.world_from_object.transform_point3(before);
            assert!(place.distance(placement.world_from_object.transform_point3(after)) < 1e-5);
            assert!(after.length() < 500.0, "{after}");
        }
    }
}
