//! How far clusters are from cubes.

use crate::geometry::{Frustum, SliceLaw, Slices, counted_tiles};
use glam::DVec3;

/// Field of view along the longer side, radians: that of the bundled recordings.
pub const FIELD: f64 = 1.261;
/// Near and far plane of the post's plot, metres.
pub const DEPTHS: [f64; 2] = [0.3, 100.0];

/// Over all clusters of a grid: the longest of a cluster's width, height and depth over the shortest, with its sides measured
/// in the middle of its depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aspects {
    /// How many slices the grid has.
    pub slices: f64,
    /// Mean over the clusters.
    pub mean: f64,
    /// That of the cluster nearest to a cube.
    pub least: f64,
    /// That of the cluster farthest from one.
    pub largest: f64,
}

/// The aspects of clusters in so many columns, rows and slices, which are square across, between two depths.
pub fn aspects(law: SliceLaw, counts: DVec3, [near, far]: [f64; 2]) -> Aspects {
    let x = (FIELD / 2.0).tan();
    let y = x * counts.y / counts.x;
    let frustum = Frustum { x0: -x, x1: x, y0: -y, y1: y, z0: -far, z1: -near };
    let screen = [counts.x, counts.y].map(|tiles| tiles as u32);
    let (slices, dimensions) = counted_tiles(&frustum, screen, counts).1.by_law(law, &frustum);
    let side = 2.0 * x / counts.x;
    let of_slice = |slice: u32| aspect(&slices, side, slice.into());
    let all: Vec<f64> = (0..dimensions.z as u32).map(of_slice).collect();
    Aspects {
        slices: dimensions.z,
        mean: all.iter().sum::<f64>() / dimensions.z,
        least: all.iter().copied().fold(f64::INFINITY, f64::min),
        largest: all.iter().copied().fold(0.0, f64::max),
    }
}

/// That of every cluster of a slice, `side` tangents wide and high.
fn aspect(slices: &Slices, side: f64, slice: f64) -> f64 {
    let [near, far] = [slice, slice + 1.0].map(|plane| slices.depth_at(plane));
    let (across, depth) = (side * (near + far) / 2.0, far - near);
    (across / depth).max(depth / across)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(law: SliceLaw) -> Aspects {
        aspects(law, DVec3::new(16.0, 9.0, 24.0), DEPTHS)
    }

    #[test]
    fn clusters_of_exponential_slices_are_alike_and_the_others_mirror_each_other() {
        let exponential = of(SliceLaw::Geometric);
        assert!((exponential.largest - exponential.least).abs() < 1e-9, "self-similar");
        // Depth over width: 2 (r - 1) / (side (r + 1)) with r = (1000/3)^(1/24).
        let ratio = (1000.0 / 3.0f64).powf(1.0 / 24.0);
        let side = 2.0 * (FIELD / 2.0).tan() / 16.0;
        assert!((exponential.mean - 2.0 * (ratio - 1.0) / (side * (ratio + 1.0))).abs() < 1e-9);
        let (ndc, view) = (of(SliceLaw::UniformNdc), of(SliceLaw::UniformView));
        assert!((ndc.mean - view.mean).abs() < 1e-9 && (ndc.largest - view.largest).abs() < 1e-9);
        assert!(ndc.largest > 19.0 && ndc.least < 1.1 && ndc.mean > exponential.mean);
    }

    #[test]
    fn cubes_are_cubes() {
        let cubes = of(SliceLaw::Cubes);
        assert!(cubes.largest < 1.1, "{cubes:?}");
        assert!(cubes.slices > 60.0);
    }
}
