//! A method's name and parameters.

/// How views share clusterings (Gelderen chapter 4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sharing {
    /// One clustering per view.
    Indi,
    /// One enclosing clustering for all views.
    Encl,
}

/// The shape of the clustering grid (Gelderen sections 3.1, 4.2, 4.3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Space {
    /// Perspective grid; the size of a cluster in pixels.
    Persp {
        /// Cluster side on the screen, pixels.
        pixels: f64,
    },
    /// Orthographic grid; the side of a cluster in metres.
    Ortho {
        /// Cluster side, metres.
        metres: f64,
    },
    /// Displaced perspective grid: apex moved back.
    Displ {
        /// Cluster side in pixels of the perspective grid whose average cluster volume is kept.
        pixels: f64,
        /// How far the apex moves back, metres.
        displacement: f64,
    },
}

/// A method: how the lights of a fragment are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MethodSpec {
    /// Brute force: every fragment evaluates every light.
    AllLights,
    /// Clustered shading.
    Clustered {
        /// One clustering per view, or one for all.
        sharing: Sharing,
        /// The grid.
        space: Space,
    },
}
