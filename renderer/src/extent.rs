//! How large a scene, its models and a camera's way through it are: what `run.json` tells of them. Pure.
//!
//! Methods that divide the world or lists by models are judged by it (Enhuber, table 4.2).

use crate::recording::Recording;
use crate::scene::Scene;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Counts, and sizes of boxes along the world's axes, metres. A model is an instance that is drawn.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Extent {
    /// Triangles drawn, those of every instance.
    pub triangles: u64,
    /// Vertices in memory.
    pub vertices: u64,
    /// Models.
    pub models: u64,
    /// Of the box around all models.
    pub scene_m: [f64; 3],
    /// Of the models' boxes, their mean.
    pub model_mean_m: [f64; 3],
    /// Of the models' boxes, the variance of their sizes, square metres.
    pub model_variance_m2: [f64; 3],
    /// Of the box around the camera's places in all frames of the recording.
    pub path_m: [f64; 3],
    /// Frames of the recording.
    pub path_frames: u32,
}

impl Extent {
    /// Of a scene and the way that a recording takes.
    pub fn of(scene: &Scene, recording: &Recording) -> Self {
        let size = |(low, high): (DVec3, DVec3)| high - low;
        let models: Vec<DVec3> =
            scene.instances.iter().map(|instance| size(scene.bounds_of(instance))).collect();
        let mean = mean(&models);
        let squares: Vec<DVec3> = models.iter().map(|model| (*model - mean) * (*model - mean)).collect();
        let heads = recording.file().frames.iter().map(|frame| (frame.head.position, frame.head.position));
        let path = heads.reduce(|(low, high), (at, _)| (low.min(at), high.max(at)));
        Self {
            triangles: scene.triangle_count(),
            vertices: scene.vertices.len() as u64,
            models: models.len() as u64,
            scene_m: scene.bounds().map_or(DVec3::ZERO, size).to_array(),
            model_mean_m: mean.to_array(),
            model_variance_m2: self::mean(&squares).to_array(),
            path_m: path.map_or(DVec3::ZERO, size).to_array(),
            path_frames: recording.frame_count(),
        }
    }
}

/// Zero of nothing.
fn mean(values: &[DVec3]) -> DVec3 {
    values.iter().sum::<DVec3>() / values.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::load;
    use crate::scene::procedural::by_name;

    #[test]
    fn the_hall_is_as_large_as_it_is_told_to_be() {
        let (scene, recording) = (by_name("hall").unwrap(), load("hall").unwrap());
        let extent = Extent::of(&scene, &recording);
        assert_eq!((extent.triangles, extent.models, extent.path_frames), (254_230, 400, 1200));
        let rounded = extent.scene_m.map(|side| (side * 10.0).round() / 10.0);
        assert_eq!(rounded, [37.3, 15.7, 23.0]);
        for axis in 0..3 {
            assert!(extent.model_mean_m[axis] > 0.0 && extent.model_mean_m[axis] < extent.scene_m[axis]);
            assert!(extent.path_m[axis] > 0.0 && extent.path_m[axis] < extent.scene_m[axis]);
        }
    }

    #[test]
    fn mean_and_variance_are_those_of_the_boxes_of_all_models() {
        let (mut scene, recording) = (by_name("street").unwrap(), load("bistro").unwrap());
        let sizes: Vec<DVec3> = scene
            .instances
            .iter()
            .map(|instance| scene.bounds_of(instance))
            .map(|(low, high)| high - low)
            .collect();
        let other = sizes.iter().position(|size| *size != sizes[0]).unwrap();
        let (a, b) = (sizes[0], sizes[other]);
        scene.instances.swap(1, other);
        scene.instances.truncate(2);
        let extent = Extent::of(&scene, &recording);
        let [mean, variance] = [extent.model_mean_m, extent.model_variance_m2].map(DVec3::from_array);
        assert!((mean - 0.5 * (a + b)).length() < 1e-12);
        assert!((variance - 0.25 * (a - b) * (a - b)).length() < 1e-9 && variance.length() > 0.0);
        scene.instances.clear();
        assert_eq!(Extent::of(&scene, &recording).model_mean_m, [0.0; 3]);
    }
}
