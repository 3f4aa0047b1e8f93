//! A list for each model (Enhuber sections 2.5, 3.2): an instance of a primitive, as it is drawn. A light is on it where it
//! meets the model's oriented box ([`OrientedBox`]), whatever the cameras see, so that any number of views share the lists,
//! in mirrors too, and each instance of what is drawn several times has its own.
//!
//! ```text
//! scene ──placements──> model_boxes (once) ─┐
//! all models ──list_clusters────────────────┴──count, offsets, assign──> LightLists
//!                                  instance that is drawn ──its index──> its list (shading)
//! ```
//!
//! To the passes that build lists, models are the cells of a grid of one row, in drawing order: [`plan()`] makes it,
//! [`settled`] gives it its length and a place, in the middle of the scene, that the boxes on the device are relative to.
//! `lookup/model.glsl` finds the list of a fragment, [`twin`] the lists on the CPU.

pub mod twin;

use super::Scenery;
use crate::geometry::views::Pose;
use crate::geometry::{ClusterSpace, Grid, OrientedBox};
use crate::placements::middle;
use crate::scene::{Instance, Scene};
use glam::DVec3;

/// Most models whose places in the row hierarchy and scatter hold, in halves of words.
pub const MOST_ACCELERATED: u32 = 1 << 16;

/// The row of a frame's models before it is known how many there are: of one.
pub fn plan() -> Grid {
    let space = ClusterSpace::Orthographic { min: -DVec3::ONE, max: DVec3::ONE };
    Grid { pose: Pose::IDENTITY, space, dimensions: [1; 3] }
}

/// The row of a scene's models, in the box of all of them. Its cells stand for models by their index alone.
pub fn settled(around: &Scenery) -> Grid {
    let middle = middle(around.scene);
    let half = around.scene.map_or(DVec3::ONE, |(_, high)| (high - middle).max(DVec3::splat(1e-3)));
    let space = ClusterSpace::Orthographic { min: -half, max: half };
    Grid { pose: Pose::from_position(middle), space, dimensions: [around.models.max(1), 1, 1] }
}

/// The box of an instance, and whether it is that of the world's axes, for its matrix shears.
pub fn box_of(scene: &Scene, instance: &Instance) -> (OrientedBox, bool) {
    OrientedBox::around(instance, &scene.primitives[instance.primitive as usize].bounds)
}

/// Says how many models of a scene are tested by boxes along the world's axes, where there are any.
pub fn sheared_note(scene: &Scene) -> Option<String> {
    let sheared = scene.instances.iter().filter(|instance| box_of(scene, instance).1).count();
    (sheared > 0).then(|| {
        format!(
            "{sheared} of {} models are sheared: method m tests lights against their boxes along the world's axes",
            scene.instances.len()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw_list::Batches;
    use crate::geometry::ConeTest;
    use crate::lights::Light;
    use crate::methods::GridBox;
    use crate::scene::procedural::by_name;

    fn light(position: [f32; 3], r1: f32) -> Light {
        Light { position, tint: [1.0; 3], intensity: 1.0, cutoff: 1.0, r0: 0.01, r1, spot: None }
    }

    #[test]
    fn models_are_a_row_in_the_middle_of_the_scene() {
        let scene = Some((DVec3::new(-4.0, 0.0, 2.0), DVec3::new(6.0, 8.0, 2.0)));
        let around = Scenery { lights: &[], scene, models: 7, grid_box: GridBox::Lights };
        let row = settled(&around);
        assert_eq!((row.dimensions, row.pose.position), ([7, 1, 1], DVec3::new(1.0, 4.0, 2.0)));
        assert_eq!(settled(&Scenery { models: 0, scene: None, ..around }).dimensions, [1; 3]);
    }

    #[test]
    fn built_in_scenes_shear_nothing() {
        for name in ["street", "temple"] {
            assert_eq!(sheared_note(&by_name(name).unwrap()), None);
        }
    }

    #[test]
    fn a_list_has_the_lights_that_reach_some_vertex() {
        let scene = by_name("temple").unwrap();
        let batches = Batches::new(&scene);
        let lights: Vec<_> =
            (0..40u8).map(|k| light([f32::from(k) * 3.0 - 60.0, f32::from(k % 7), -20.0], 6.0)).collect();
        let lists = twin::light_lists(&scene, &batches, (&lights, ConeTest::Unasked), 0.0);
        let mut reached = 0;
        for (place, &index) in batches.instances.iter().enumerate() {
            let instance = &scene.instances[index as usize];
            let primitive = &scene.primitives[instance.primitive as usize];
            let first = primitive.vertex_offset as usize;
            for vertex in scene.vertices[first..first + primitive.vertex_count as usize].iter().step_by(50) {
                let at = instance
                    .world_from_object
                    .transform_point3(DVec3::from_array(vertex.position.map(f64::from)));
                for (number, light) in (0..).zip(&lights) {
                    let distance = DVec3::from_array(light.position.map(f64::from)).distance(at);
                    if distance < f64::from(light.r1) - 1e-4 {
                        assert!(lists.list(place).contains(&number));
                        reached += 1;
                    }
                }
            }
        }
        assert!(reached > 100, "{reached}");
    }
}
