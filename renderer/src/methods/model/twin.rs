//! The lists of models on the CPU.

use super::box_of;
use crate::cpu::LightLists;
use crate::draw_list::Batches;
use crate::geometry::{ConeTest, Hexahedron};
use crate::lights::Light;
use crate::scene::Scene;

/// The light lists of a scene's models in drawing order, from lights in world space, whose cones are asked as `cone` says. Pairs whose margin is below `epsilon`
/// (metres) are marked as too close to call.
pub fn light_lists(
    scene: &Scene,
    batches: &Batches,
    (lights, cone): (&[Light], ConeTest),
    epsilon: f64,
) -> LightLists {
    let models = batches.instances.iter().map(|&index| box_of(scene, &scene.instances[index as usize]).0);
    LightLists::by_margin(models, lights, epsilon, |model, light| {
        let (centre, radius) = light.bounding_sphere();
        let of_cone =
            light.sector().map_or(f64::INFINITY, |sector| cone.margin(&Hexahedron::of_box(model), &sector));
        (radius - model.distance(centre)).min(of_cone)
    })
}
