//! The lists of models on the CPU.

use super::box_of;
use crate::cpu::LightLists;
use crate::draw_list::Batches;
use crate::lights::PointLight;
use crate::scene::Scene;
use glam::DVec3;

/// The light lists of a scene's models in drawing order, from lights in world space. Pairs whose margin is below `epsilon`
/// (metres) are marked as too close to call.
pub fn light_lists(scene: &Scene, batches: &Batches, lights: &[PointLight], epsilon: f64) -> LightLists {
    let models = batches.instances.iter().map(|&index| box_of(scene, &scene.instances[index as usize]).0);
    LightLists::by_margin(models, lights, epsilon, |model, light| {
        f64::from(light.r1) - model.distance(DVec3::from_array(light.position.map(f64::from)))
    })
}
