//! The piece of a frustum that is a cluster of a perspective grid.

use glam::{DVec2, DVec3};

/// Points with tangents low..high and depths near..far, from the apex at the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FrustumPiece {
    low: DVec2,
    high: DVec2,
    near: f64,
    far: f64,
}

impl FrustumPiece {
    /// The piece with these corners, in the order of [`super::Grid::cell_corners`]: the near ones first.
    pub fn new(corners: &[DVec3; 8]) -> Self {
        let tangents = |corner: DVec3| corner.truncate() / -corner.z;
        Self {
            // The near corners may lie in the apex.
            low: tangents(corners[4]),
            high: tangents(corners[7]),
            near: -corners[0].z,
            far: -corners[4].z,
        }
    }

    /// Unit directions of the four edges that meet in the apex.
    pub fn sides(&self) -> [DVec3; 4] {
        let side = |x: f64, y: f64| DVec3::new(x, y, -1.0).normalize();
        let Self { low, high, .. } = *self;
        [side(low.x, low.y), side(high.x, low.y), side(low.x, high.y), side(high.x, high.y)]
    }

    /// Distance of a point, metres; 0 inside.
    ///
    /// At each depth the piece is a rectangle, and its nearest point is the clamped one. Of the depths, the best is an
    /// end, or it is the best one for some choice of the sides that the point lies beyond: so the best of all those is
    /// the best there is.
    pub fn distance(&self, point: DVec3) -> f64 {
        let sides = |axis: usize| [None, Some(self.low[axis]), Some(self.high[axis])];
        let mut depths = vec![self.near, self.far];
        for x in sides(0) {
            for y in sides(1) {
                depths.push(best_depth(point, [x, y]).clamp(self.near, self.far));
            }
        }
        depths.into_iter().map(|depth| self.distance_at(point, depth)).fold(f64::INFINITY, f64::min)
    }

    fn distance_at(&self, point: DVec3, depth: f64) -> f64 {
        let nearest = point.truncate().clamp(self.low * depth, self.high * depth);
        point.distance(nearest.extend(-depth))
    }
}

/// The depth at which a point is nearest to the planes through the apex of the given tangents: where two are given, to
/// the line they share; where none is, to all depths alike but its own.
fn best_depth(point: DVec3, tangents: [Option<f64>; 2]) -> f64 {
    let (mut along, mut square) = (-point.z, 1.0);
    for (axis, tangent) in tangents.into_iter().enumerate() {
        if let Some(tangent) = tangent {
            along += tangent * point[axis];
            square += tangent * tangent;
        }
    }
    along / square
}
