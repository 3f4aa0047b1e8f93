//! Cameras: a rigid pose and an asymmetric frustum, both f64.

use crate::geometry::Frustum;
use glam::{DQuat, DVec3};

/// A rigid transform: where a camera (or head) is and how it is turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// World position, metres.
    pub position: DVec3,
    /// World-from-local rotation, unit.
    pub rotation: DQuat,
}

/// One rendering camera. It looks down its -Z; +Y is up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// World from view.
    pub pose: Pose,
    /// View-space frustum.
    pub frustum: Frustum,
}
