//! Where the cells of a world grid lie in a frame.

use super::Scenery;
use crate::geometry::views::Pose;
use crate::geometry::{ClusterSpace, Grid};
use crate::lights::Light;
use clap::ValueEnum;
use glam::{DVec3, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a world grid is laid around.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum GridBox {
    /// The box around all geometry.
    Scene,
    /// The box around the centres of the frame's lights.
    Lights,
}

/// No side of a box is shorter than this part of how far the scene reaches from its middle: cells of lights in one plane,
/// or of a single one, still have a thickness, and the index of any sample fits 32 bits.
const THINNEST: f64 = 1e-6;

/// A low and a high corner, metres.
type Corners = (DVec3, DVec3);

/// `grid` where it lies among the lights and the geometry of a frame, centred in its box.
///
/// Where there are no lights it lies around the scene, and the other way round. A function of these alone, not of views.
pub fn settled(grid: &Grid, around: &Scenery) -> Grid {
    let lights = bounds(around.lights);
    let found = match around.grid_box {
        GridBox::Lights => lights.or(around.scene),
        GridBox::Scene => around.scene.or(lights),
    };
    let (low, high) = found.unwrap_or((-DVec3::ONE, DVec3::ONE));
    let middle = 0.5 * (low + high);
    let half = (0.5 * (high - low)).max(DVec3::splat(least_half(middle, around.scene)));
    let space = ClusterSpace::Orthographic { min: -half, max: half };
    Grid { pose: Pose::from_position(middle), space, ..*grid }
}

/// The box around the centres of lights; `None` of none.
fn bounds(lights: &[Light]) -> Option<Corners> {
    let corners = |(low, high): (Vec3, Vec3), light: &Light| {
        let place = Vec3::from(light.position);
        (low.min(place), high.max(place))
    };
    let first = lights.first().map(|light| Vec3::from(light.position))?;
    let (low, high) = lights.iter().fold((first, first), corners);
    Some((low.as_dvec3(), high.as_dvec3()))
}

/// Least half of a side for a box around `middle`.
fn least_half(middle: DVec3, scene: Option<Corners>) -> f64 {
    let farthest = scene.map_or(0.0, |(low, high)| (low - middle).abs().max((high - middle).abs()).length());
    THINNEST * farthest.max(1.0)
}
