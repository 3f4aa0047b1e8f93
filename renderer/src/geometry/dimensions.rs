//! How many clusters a grid has along each axis, from pixels, from metres or from a volume.
//!
//! Dimensions are whole numbers in f64 here: only a finished grid is checked against what a u32 can index.

use super::{Frustum, SliceLaw, Slices};
use glam::DVec3;

/// Relative slack when rounding a count up: 50 stays 50 where rounding errors made it 50.000000000001, so
/// that a grid does not change with the pose of the camera.
const ROUNDING: f64 = 1e-10;

/// More than enough for a quadratic convergence.
const MAX_STEPS: u32 = 100;

/// Dimensions of a perspective grid and its ratio d: slice k spans depths z1*(1+d)^k..z1*(1+d)^(k+1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PerspectiveDimensions {
    /// Clusters along x, y and depth; whole numbers.
    pub dimensions: DVec3,
    /// Thickness of a slice over the depth at which it begins.
    pub ratio: f64,
}

impl PerspectiveDimensions {
    /// Slices about as deep as `side`, the side of a cluster in tangents, says. The ratio is then refitted, so
    /// that a whole number of slices ends at the far plane.
    fn new(columns: f64, rows: f64, frustum: &Frustum, side: f64) -> Self {
        let depths = depth_span(frustum);
        let slices = round_up(depths / side.ln_1p());
        let dimensions = DVec3::new(round_up(columns), round_up(rows), slices);
        Self { dimensions, ratio: (depths / slices).exp_m1() }
    }
}

/// Persp P: clusters of `pixels` squared on a screen of `resolution` pixels (Gelderen section 3.1).
pub fn from_pixels(frustum: &Frustum, resolution: [u32; 2], pixels: f64) -> PerspectiveDimensions {
    let [columns, rows] = resolution.map(|side| f64::from(side) / pixels);
    PerspectiveDimensions::new(columns, rows, frustum, side_in_tangents(frustum, resolution, pixels))
}

/// Tiles of `pixels` squared on a screen of `resolution` pixels, in so many slices from the near to the far plane
/// (Enhuber section 3.2).
pub fn sliced_tiles(
    frustum: &Frustum,
    resolution: [u32; 2],
    pixels: f64,
    slices: f64,
) -> PerspectiveDimensions {
    let [columns, rows] = resolution.map(|side| round_up(f64::from(side) / pixels));
    let ratio = (depth_span(frustum) / slices).exp_m1();
    PerspectiveDimensions { dimensions: DVec3::new(columns, rows, slices), ratio }
}

/// Side of square tiles of which so many columns fill a screen, pixels: the least whole number.
pub fn counted_pixels([width, _]: [u32; 2], columns: f64) -> f64 {
    round_up(f64::from(width) / columns)
}

/// Square tiles in so many columns, rows and slices (Ortiz, step 1), and their side in pixels: the least whole number with
/// which the columns fill the screen. A screen higher than the rows has as many as it takes, where his index runs on
/// into the next slice.
pub fn counted_tiles(frustum: &Frustum, resolution: [u32; 2], counts: DVec3) -> (f64, PerspectiveDimensions) {
    let pixels = counted_pixels(resolution, counts.x);
    let rows = counts.y.max(round_up(f64::from(resolution[1]) / pixels));
    (pixels, counted(frustum, DVec3::new(counts.x, rows, counts.z)))
}

/// So many columns, rows and slices, whatever sides they give.
pub fn counted(frustum: &Frustum, counts: DVec3) -> PerspectiveDimensions {
    PerspectiveDimensions { dimensions: counts, ratio: (depth_span(frustum) / counts.z).exp_m1() }
}

impl PerspectiveDimensions {
    /// The slices of a law, and their number: as many as these, or as many as the law says.
    pub fn by_law(self, law: SliceLaw, frustum: &Frustum) -> (Slices, DVec3) {
        let Self { mut dimensions, mut ratio } = self;
        if law == SliceLaw::Cubes {
            ratio = frustum.size().y / dimensions.y;
            dimensions.z = round_up(depth_span(frustum) / ratio.ln_1p());
        }
        (Slices::new(law, frustum, ratio, dimensions.z), dimensions)
    }
}

/// The mean of the two sides of a cluster of Persp P, in tangents: clusters become about as deep as wide.
pub fn side_in_tangents(frustum: &Frustum, resolution: [u32; 2], pixels: f64) -> f64 {
    let [columns, rows] = resolution.map(|side| f64::from(side) / pixels);
    let size = frustum.size();
    (size.x / columns + size.y / rows) / 2.0
}

/// The average volume of a cluster of Persp P, cubic metres.
pub fn average_volume(frustum: &Frustum, counts: &PerspectiveDimensions) -> f64 {
    frustum.volume() / counts.dimensions.element_product()
}

/// Ortho S: sides of about `metres` (at most), dividing `extent` exactly.
pub fn from_metres(extent: DVec3, metres: f64) -> DVec3 {
    (extent / metres).map(round_up)
}

/// A perspective grid over the whole of `frustum` whose clusters have about `volume` cubic metres on average
/// (Gelderen equations 4.4 and 4.5).
pub fn from_volume(frustum: &Frustum, volume: f64) -> PerspectiveDimensions {
    let cubes = frustum.z1.powi(3) - frustum.z0.powi(3);
    let side = solve_side(3.0 * depth_span(frustum) * volume / cubes);
    let size = frustum.size();
    PerspectiveDimensions::new(size.x / side, size.y / side, frustum, side)
}

/// ln(far/near).
fn depth_span(frustum: &Frustum) -> f64 {
    (frustum.z0 / frustum.z1).ln()
}

fn round_up(count: f64) -> f64 {
    (count * (1.0 - ROUNDING)).ceil().max(1.0)
}

/// Solves d^2*ln(1+d) = `right` by Newton's method to a relative 1e-12.
///
/// The left side is convex and grows; at the start, the cube root, it is too small. So the first step
/// overshoots, every further one comes down, and no step can fail.
fn solve_side(right: f64) -> f64 {
    let mut d = right.cbrt();
    for _ in 0..MAX_STEPS {
        let log = d.ln_1p();
        let step = (d * d * log - right) / (2.0 * d * log + d * d / (1.0 + d));
        d -= step;
        if step.abs() <= 1e-12 * d {
            break;
        }
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn rounding_up_forgives_rounding_errors_only() {
        assert_eq!(round_up(50.0 + 1e-12), 50.0);
        assert_eq!(round_up(50.0001), 51.0);
        assert_eq!(round_up(1e-9), 1.0);
        assert_eq!(from_metres(DVec3::new(200.0, 112.5, 99.6), 4.0), DVec3::new(50.0, 29.0, 25.0));
    }

    #[test]
    fn counted_tiles_are_square_and_fill_the_screen() {
        let frustum = Frustum { x0: -1.6, x1: 1.6, y0: -0.9, y1: 0.9, z0: -100.0, z1: -0.3 };
        let tiles = |resolution, counts: [f64; 3]| {
            let (pixels, counts) = counted_tiles(&frustum, resolution, DVec3::from_array(counts));
            (pixels, counts.dimensions.to_array())
        };
        assert_eq!(tiles([1920, 1080], [16.0, 9.0, 24.0]), (120.0, [16.0, 9.0, 24.0]));
        assert_eq!(tiles([1366, 768], [16.0, 9.0, 24.0]), (86.0, [16.0, 9.0, 24.0]));
        assert_eq!(tiles([640, 720], [16.0, 9.0, 24.0]), (40.0, [16.0, 18.0, 24.0]), "of an eye");
        assert_eq!(tiles([320, 100], [16.0, 9.0, 1.0]), (20.0, [16.0, 9.0, 1.0]), "as many as said");
        assert_eq!(tiles([8, 8], [16.0, 9.0, 2.0]), (1.0, [16.0, 9.0, 2.0]), "no pixel is divided");
    }

    proptest! {
        #[test]
        fn newton_solves_the_equation(exponent in -12.0..6.0f64) {
            let right = 10f64.powf(exponent);
            let d = solve_side(right);
            prop_assert!((d * d * d.ln_1p() / right - 1.0).abs() < 1e-10);
        }

        #[test]
        fn the_volume_asked_for_is_met_before_rounding(
            far in 5.0..500.0f64, x in 0.3..2.0f64, volume in 0.001..1.0f64,
        ) {
            let frustum = Frustum { x0: -x, x1: 0.5 * x, y0: -0.7, y1: 1.1, z0: -far, z1: -0.2 };
            let counts = from_volume(&frustum, volume);
            let average = average_volume(&frustum, &counts);
            prop_assert!(average <= volume * (1.0 + 1e-9), "rounding up only makes clusters smaller");
            let one_less = (counts.dimensions - DVec3::ONE).element_product();
            prop_assert!(frustum.volume() / one_less.max(1e-9) >= volume * (1.0 - 1e-9));
            let reached = frustum.z1 * (1.0 + counts.ratio).powf(counts.dimensions.z);
            prop_assert!((reached / frustum.z0 - 1.0).abs() < 1e-9, "the slices end at the far plane");
        }
    }
}
