//! What of a scene can be shaded, for octrees that are kept where it is alone (Tegelaers section 8.2.1).

use super::slack;
use crate::octree::OctreeGeometry;
use crate::scene::{Instance, Scene};
use glam::DVec3;

/// How many times as far as the scene's farthest corner from the world's origin eyes, lights and geometry may lie together, so that
/// trimmed octrees serve.
const REACH: f64 = 8.0;

/// All surfaces of a scene, also those that are cut out or let light through: nothing in it moves.
pub struct SceneGeometry {
    triangles: OctreeGeometry,
    /// How far from its triangle a fragment may be looked up, metres.
    slack: f64,
}

impl SceneGeometry {
    /// The surfaces of a scene.
    pub fn of(scene: &Scene) -> Self {
        let farthest = scene.bounds().map_or(0.0, |(low, high)| low.abs().max(high.abs()).length());
        let slack = slack(REACH * farthest);
        let triangles = scene.instances.iter().flat_map(|instance| triangles(scene, instance));
        Self { triangles: OctreeGeometry::new(triangles, slack), slack }
    }

    /// The same where what rounding may cost a frame's fragments, metres, does not take them farther from their triangles than
    /// was thought of; else nothing, for a whole octree serves any fragment.
    pub fn within(&self, slack: f64) -> Option<&OctreeGeometry> {
        (slack <= self.slack).then_some(&self.triangles)
    }
}

/// The triangles of an instance, world space.
fn triangles<'a>(scene: &'a Scene, instance: &'a Instance) -> impl Iterator<Item = [DVec3; 3]> + 'a {
    let primitive = &scene.primitives[instance.primitive as usize];
    let first = primitive.first_index as usize;
    let corner = move |index: u32| {
        let vertex = &scene.vertices[(primitive.vertex_offset + index) as usize];
        instance.world_from_object.transform_point3(DVec3::from_array(vertex.position.map(f64::from)))
    };
    let indices = &scene.indices[first..first + primitive.index_count as usize];
    indices
        .chunks_exact(3)
        .map(move |triangle| [corner(triangle[0]), corner(triangle[1]), corner(triangle[2])])
}
