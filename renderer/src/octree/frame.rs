//! Where the cells of an octree lie (Tegelaers section 7.2.1).

use super::settings::{OctreeError, OctreeSettings};
use crate::geometry::LightVolume;
use glam::{DVec3, UVec3};

/// Deepest octree: coordinates of 21 bits, which three to a 64-bit code and single precision on the device hold.
pub const MOST_DEPTH: u32 = 21;

/// How far the octree reaches past the lights on each side, as a part of their extent.
const MARGIN: f64 = 1e-3;

/// Where cells lie: a cube of `2^depth` deepest cells an axis, from `origin` on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OctreeFrame {
    /// Low corner of the root, world space, metres.
    pub origin: DVec3,
    /// Edge of the deepest cells, metres.
    pub node: f64,
    /// Depth of the deepest leaves; the root has depth 0. At least 1.
    pub depth: u32,
    /// Depth at which lookups begin, below `depth`.
    pub start_depth: u32,
}

impl OctreeFrame {
    /// The smallest octree around all lights, of deepest cells as the settings say. Without lights, one of two cells an axis.
    ///
    /// # Errors
    /// A light or the node size is no number above 0, or the octree would be too deep.
    pub fn around(lights: &[LightVolume], settings: &OctreeSettings) -> Result<Self, OctreeError> {
        let node = settings.node;
        if !(node.is_finite() && node > 0.0) {
            return Err(OctreeError::NodeSize(node));
        }
        let (low, high) = bounds(lights)?;
        let extent = (high - low).max_element();
        let margin = (MARGIN * extent).max(settings.room);
        let edge = extent + 2.0 * margin;
        let depth = depth_for(edge, node);
        if depth > MOST_DEPTH || !edge.is_finite() {
            let least = edge / f64::from(1_u32 << MOST_DEPTH);
            return Err(OctreeError::TooDeep { extent, node, depth, most: MOST_DEPTH, least });
        }
        let start_depth = settings.start_depth.min(depth - 1);
        Ok(Self { origin: low - margin, node, depth, start_depth })
    }

    /// Deepest cells along an axis.
    pub fn side(&self) -> u32 {
        1 << self.depth
    }

    /// Edge of the nodes of a depth, metres.
    pub fn edge(&self, depth: u32) -> f64 {
        self.node * f64::from(1_u32 << (self.depth - depth))
    }

    /// The deepest cell that holds a point of the world; `None` outside, where no light reaches.
    pub fn cell(&self, point: DVec3) -> Option<UVec3> {
        let at = self.in_cells(point).floor();
        let inside = at.cmpge(DVec3::ZERO).all() && at.cmplt(DVec3::splat(f64::from(self.side()))).all();
        inside.then(|| at.as_uvec3())
    }

    /// Whether all of a light's ball lies in the octree.
    pub(super) fn holds(&self, light: &LightVolume) -> bool {
        let low = self.in_cells(light.centre - light.radius);
        let high = self.in_cells(light.centre + light.radius);
        low.cmpge(DVec3::ZERO).all() && high.cmple(DVec3::splat(f64::from(self.side()))).all()
    }

    /// A point of the world with the origin as zero and a deepest cell as unit.
    pub(super) fn in_cells(&self, point: DVec3) -> DVec3 {
        (point - self.origin) / self.node
    }
}

/// Least depth, from 1 on, at which a root of cells of `node` is as long as `edge`.
fn depth_for(edge: f64, node: f64) -> u32 {
    // Past the deepest that is of use it does not matter how much deeper.
    (1..1024).find(|depth| f64::from(*depth).exp2() * node >= edge).unwrap_or(1024)
}

/// The box around all balls; a point where there are none.
fn bounds(lights: &[LightVolume]) -> Result<(DVec3, DVec3), OctreeError> {
    let mut corners: Option<(DVec3, DVec3)> = None;
    for (light, &LightVolume { centre, radius, .. }) in lights.iter().enumerate() {
        if !(centre.is_finite() && radius.is_finite() && radius > 0.0) {
            return Err(OctreeError::Light { light, centre, radius });
        }
        let (low, high) = (centre - radius, centre + radius);
        corners = Some(corners.map_or((low, high), |(least, most)| (least.min(low), most.max(high))));
    }
    Ok(corners.unwrap_or_default())
}
