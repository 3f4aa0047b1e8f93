//! The asymmetric frustum (Gelderen definition 4.1, appendix E).

/// A frustum by the signed tangents of its side planes and its signed near and far depths.
///
/// A view-space point p projects to (p.x/-p.z, p.y/-p.z); it is inside where that lies within x0..x1, y0..y1
/// and p.z within z0..z1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frustum {
    /// Left tangent.
    pub x0: f64,
    /// Right tangent.
    pub x1: f64,
    /// Bottom tangent.
    pub y0: f64,
    /// Top tangent.
    pub y1: f64,
    /// -far, metres, below z1.
    pub z0: f64,
    /// -near, metres, below 0.
    pub z1: f64,
}
