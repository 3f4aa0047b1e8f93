//! Point lights of one frame, wherever they come from: rain, a CSV file, the scene.

/// A point light. Its influence ends at `r1` (METHODS of attenuation: Gelderen appendix A).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLight {
    /// World position, metres.
    pub position: [f32; 3],
    /// Linear colour, multiplies the attenuation.
    pub tint: [f32; 3],
    /// Intensity I.
    pub intensity: f32,
    /// Intensity cut-off I0.
    pub cutoff: f32,
    /// Near radius R0: the distance is clamped to at least this, metres.
    pub r0: f32,
    /// Influence radius R1 = sqrt(I/I0), metres.
    pub r1: f32,
}

/// How a light fades with distance (Gelderen appendix A, table of METHODS); names as there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Attenuation {
    /// I/d^2 for d < R1.
    Phy,
    /// I/d^2 - I0.
    Red,
    /// I/d^2 + 2*I0*d/R1 - 3*I0.
    Smo,
    /// I/d^2 - I0*d/R1.
    PhyRed1,
    /// I/d^2 - I0*d^2/R1^2: the default (Gelderen equation 5.1).
    PhyRed2,
    /// I/d^2 + 2*I0*d^2/R1^2 - 3*I0*d/R1.
    PhySmo1,
    /// I/d^2 + 2*I0*d^3/R1^3 - 3*I0*d^2/R1^2.
    PhySmo2,
    /// I*(R1-d)/R1.
    Lin,
    /// 4*I/R1^2 for d < R1.
    Stp,
}
