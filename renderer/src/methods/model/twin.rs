//! The lists of models on the CPU.

use super::box_of;
use crate::cpu::LightLists;
use crate::draw_list::Batches;
use crate::lights::Light;
use crate::scene::Scene;

/// The light lists of a scene's models in drawing order, from lights in world space. Pairs whose margin is below `epsilon`
/// (metres) are marked as too close to call.
pub fn light_lists(scene: &Scene, batches: &Batches, lights: &[Light], epsilon: f64) -> LightLists {
    let models = batches.instances.iter().map(|&index| box_of(scene, &scene.instances[index as usize]).0);
    LightLists::by_margin(models, lights, epsilon, |model, light| {
        let (centre, radius) = light.bounding_sphere();
        radius - model.distance(centre)
    })
}
