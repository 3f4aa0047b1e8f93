//! How different two pictures look: FLIP for low dynamic range (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and
//! Fairchild, *FLIP: A Difference Evaluator for Alternating Images*, 2020), from 0, equal, to 1.
//!
//! ```text
//! sRGB ─> YCxCz ─┬─ contrast sensitivity ─> Hunt-adjusted L*a*b* ─> HyAB ─> colour ──┐
//!                └─ luminance ─> edges and points ─────────────────────────> feature ┴─> colour^(1 - feature)
//! ```
//!
//! Constants are those of the paper's table 1 and sections 4 and 5. Results are those of NVIDIA's evaluator (1.7) to three
//! digits, which the tests hold as numbers.

use crate::output::srgb_decode;
use glam::{DMat3, DVec3};
use rayon::prelude::*;

/// Pixels a degree of sight: a screen 0.7 m wide with 3840 pixels, seen from 0.7 m (section 6).
const PIXELS_PER_DEGREE: f64 = 67.0206;

/// Exponent of colour differences.
const COLOR_EXPONENT: f64 = 0.7;
/// Part of the largest colour difference below which lies most of the scale.
const COMMON_PART: f64 = 0.4;
/// Where that part ends on the scale.
const COMMON_SCALE: f64 = 0.95;
/// Width of features, degrees.
const FEATURE_WIDTH: f64 = 0.082;
/// Exponent of feature differences.
const FEATURE_EXPONENT: f64 = 0.5;

/// Gaussians (height, width) whose sum is the sensitivity to contrasts of lightness, of red against green, and of blue
/// against yellow, in the space of frequencies.
const SENSITIVITY: [&[(f64, f64)]; 3] = [&[(1.0, 0.0047)], &[(1.0, 0.0053)], &[(34.1, 0.04), (13.5, 0.025)]];

/// sRGB's primaries to XYZ (IEC 61966-2-1), by columns.
const XYZ_FROM_RGB: DMat3 = DMat3::from_cols_array(&[
    0.412_456_4,
    0.212_672_9,
    0.019_333_9,
    0.357_576_1,
    0.715_152_2,
    0.119_192,
    0.180_437_5,
    0.072_175,
    0.950_304_1,
]);

/// A plane of numbers of a picture, row by row.
#[derive(Clone)]
struct Plane {
    width: usize,
    values: Vec<f64>,
}

/// The difference of every pixel of two pictures of one size: sRGB of 8 bits, row by row, `width` a row.
pub(super) fn flip(width: usize, pictures: [&[[u8; 3]]; 2]) -> Vec<f64> {
    let opponents = pictures.map(|picture| opponent_planes(width, picture));
    let features = opponents.each_ref().map(|[luminance, ..]| Features::of(luminance));
    let seen = opponents.map(|planes| lab(&filtered(planes)));
    let largest = hyab(hunt_lab(DVec3::Y), hunt_lab(DVec3::Z)).powf(COLOR_EXPONENT);
    let pixel = |place: usize| {
        let color = redistributed(hyab(seen[0][place], seen[1][place]).powf(COLOR_EXPONENT), largest);
        color.powf(1.0 - features[0].difference(&features[1], place))
    };
    (0..pictures[0].len()).into_par_iter().map(pixel).collect()
}

/// Linear RGB to XYZ relative to white.
fn xyz(rgb: DVec3) -> DVec3 {
    XYZ_FROM_RGB * rgb / (XYZ_FROM_RGB * DVec3::ONE)
}

/// Y, Cx and Cz, which are linear in light.
fn opponent_planes(width: usize, picture: &[[u8; 3]]) -> [Plane; 3] {
    let linear = |[r, g, b]: [u8; 3]| {
        DVec3::from([r, g, b].map(|byte| f64::from(srgb_decode(f32::from(byte) / 255.0))))
    };
    let opponent = |pixel: &[u8; 3]| {
        let DVec3 { x, y, z } = xyz(linear(*pixel));
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    };
    let pixels: Vec<[f64; 3]> = picture.iter().map(opponent).collect();
    [0, 1, 2].map(|channel| Plane { width, values: pixels.iter().map(|pixel| pixel[channel]).collect() })
}

/// What an eye at its distance sees of the planes.
fn filtered(planes: [Plane; 3]) -> [Plane; 3] {
    let widest = SENSITIVITY.iter().flat_map(|sum| *sum).map(|(_, width)| *width).fold(0.0, f64::max);
    let pi = std::f64::consts::PI;
    let radius = (3.0 * (widest / (2.0 * pi * pi)).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
    let mut sums = SENSITIVITY.iter();
    planes.map(|plane| {
        let gaussian = |(height, width): &(f64, f64)| {
            let kernel = kernel(radius, |x| (-(pi * x / PIXELS_PER_DEGREE).powi(2) / width).exp());
            let area = kernel.iter().sum::<f64>();
            let weight = height * (pi / width).sqrt() * area * area;
            (weight, plane.blurred(&unit(kernel)))
        };
        let parts: Vec<(f64, Plane)> = sums.next().into_iter().copied().flatten().map(gaussian).collect();
        let total: f64 = parts.iter().map(|(weight, _)| weight).sum();
        let of = |place: usize| {
            parts.iter().map(|(weight, part)| weight * part.values[place]).sum::<f64>() / total
        };
        Plane { width: plane.width, values: (0..plane.values.len()).map(of).collect() }
    })
}

/// L* with a* and b* that fade in the dark (Hunt), of each pixel.
fn lab(planes: &[Plane; 3]) -> Vec<DVec3> {
    let white = XYZ_FROM_RGB * DVec3::ONE;
    let rgb_from_xyz = XYZ_FROM_RGB.inverse();
    let pixel = |place: usize| {
        let [y, cx, cz] = planes.each_ref().map(|plane| plane.values[place]);
        let y = (y + 16.0) / 116.0;
        let rgb = rgb_from_xyz * (DVec3::new(cx / 500.0 + y, y, y - cz / 200.0) * white);
        hunt_lab(rgb.clamp(DVec3::ZERO, DVec3::ONE))
    };
    (0..planes[0].values.len()).map(pixel).collect()
}

fn hunt_lab(rgb: DVec3) -> DVec3 {
    const BEND: f64 = 6.0 / 29.0;
    let curve = |t: f64| if t > BEND.powi(3) { t.cbrt() } else { t / (3.0 * BEND * BEND) + 4.0 / 29.0 };
    let [x, y, z] = xyz(rgb).to_array().map(curve);
    let lightness = 116.0 * y - 16.0;
    DVec3::new(lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z))
}

/// Distance for large differences: along lightness, then in the plane of colours.
fn hyab(a: DVec3, b: DVec3) -> f64 {
    let difference = a - b;
    difference.x.abs() + difference.y.hypot(difference.z)
}

/// A colour difference on the scale from 0 to 1, most of which is for common ones.
fn redistributed(difference: f64, largest: f64) -> f64 {
    let common = COMMON_PART * largest;
    if difference < common {
        difference * COMMON_SCALE / common
    } else {
        COMMON_SCALE + (difference - common) / (largest - common) * (1.0 - COMMON_SCALE)
    }
}

/// How strong edges and points are at each pixel.
struct Features {
    edges: Vec<f64>,
    points: Vec<f64>,
}

impl Features {
    fn of(luminance: &Plane) -> Self {
        let values = luminance.values.iter().map(|y| (y + 16.0) / 116.0).collect();
        let luminance = Plane { width: luminance.width, values };
        let deviation = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
        let radius = (3.0 * deviation).ceil() as i32;
        let bell = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
        let along = unit(kernel(radius, bell));
        let edge = balanced(kernel(radius, |x| -x * bell(x)));
        let point = balanced(kernel(radius, |x| (x * x / (deviation * deviation) - 1.0) * bell(x)));
        let strength = |across: &[f64]| {
            let [x, y] = [luminance.convolved([across, &along]), luminance.convolved([&along, across])];
            x.values.iter().zip(&y.values).map(|(x, y)| x.hypot(*y)).collect()
        };
        Self { edges: strength(&edge), points: strength(&point) }
    }

    fn difference(&self, other: &Self, place: usize) -> f64 {
        let edges = (self.edges[place] - other.edges[place]).abs();
        let points = (self.points[place] - other.points[place]).abs();
        (edges.max(points) / std::f64::consts::SQRT_2).powf(FEATURE_EXPONENT)
    }
}

/// A function at whole numbers from -radius to radius.
fn kernel(radius: i32, of: impl Fn(f64) -> f64) -> Vec<f64> {
    (-radius..=radius).map(|x| of(f64::from(x))).collect()
}

/// Weights whose sum is 1.
fn unit(weights: Vec<f64>) -> Vec<f64> {
    let sum: f64 = weights.iter().sum();
    weights.into_iter().map(|weight| weight / sum).collect()
}

/// Weights of which the positive sum to 1 and the negative to -1.
fn balanced(weights: Vec<f64>) -> Vec<f64> {
    let positive: f64 = weights.iter().filter(|weight| **weight > 0.0).sum();
    let negative: f64 = -weights.iter().filter(|weight| **weight < 0.0).sum::<f64>();
    weights.into_iter().map(|weight| weight / if weight > 0.0 { positive } else { negative }).collect()
}

impl Plane {
    fn blurred(&self, kernel: &[f64]) -> Self {
        self.convolved([kernel, kernel])
    }

    /// Weighted sums of neighbours, by a kernel along x and one along y; the border goes on beyond itself.
    fn convolved(&self, [x, y]: [&[f64]; 2]) -> Self {
        let height = self.values.len() / self.width.max(1);
        let pass = |values: &[f64], kernel: &[f64], (count, stride): (usize, usize)| -> Vec<f64> {
            let radius = (kernel.len() / 2) as isize;
            let sum = |place: usize| {
                let along = (place / stride % count) as isize;
                let start = place - along as usize * stride;
                let near =
                    |step: usize| (along + step as isize - radius).clamp(0, count as isize - 1) as usize;
                kernel
                    .iter()
                    .enumerate()
                    .map(|(step, weight)| weight * values[start + near(step) * stride])
                    .sum()
            };
            (0..values.len()).into_par_iter().map(sum).collect()
        };
        let across = pass(&self.values, x, (self.width, 1));
        Self { width: self.width, values: pass(&across, y, (height, self.width)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [32, 24];

    /// Red rises to the right, green downwards, with a red box at columns `left` to `left` + 12.
    fn picture(left: usize) -> Vec<[f64; 3]> {
        let [width, height] = SIZE;
        let pixel = |place: usize| {
            let (x, y) = (place % width, place / width);
            let boxed = (6..12).contains(&y) && (left..left + 12).contains(&x);
            let gradient = [x as f64 / (width - 1) as f64, y as f64 / (height - 1) as f64, 0.5];
            if boxed { [0.9, 0.1, 0.2] } else { gradient }
        };
        (0..width * height).map(pixel).collect()
    }

    fn bytes(picture: &[[f64; 3]]) -> Vec<[u8; 3]> {
        picture
            .iter()
            .map(|pixel| pixel.map(|value| (value.clamp(0.0, 1.0) * 255.0).round_ties_even() as u8))
            .collect()
    }

    fn compare(test: &[[f64; 3]]) -> Vec<f64> {
        flip(SIZE[0], [&bytes(&picture(8)), &bytes(test)])
    }

    fn mean(values: &[f64]) -> f64 {
        values.iter().sum::<f64>() / values.len() as f64
    }

    #[test]
    fn differences_are_those_of_the_authors_program() {
        let brighter: Vec<[f64; 3]> =
            picture(8).iter().map(|pixel| pixel.map(|value| value + 0.05)).collect();
        let inverted: Vec<[f64; 3]> = picture(8).iter().map(|pixel| pixel.map(|value| 1.0 - value)).collect();
        // Mean, largest, and the pixels (0, 0) and (31, 23), by flip-evaluator 1.7 (LDR, 67.02 pixels a degree).
        let expected = [
            (picture(10), [0.055_663, 0.647_992, 0.000_483, 0.0]),
            (brighter, [0.251_991, 0.309_002, 0.251_432, 0.192_389]),
            (inverted, [0.955_946, 0.989_067, 0.989_064, 0.989_067]),
        ];
        for (test, expected) in expected {
            let found = compare(&test);
            let largest = found.iter().copied().fold(0.0, f64::max);
            let found = [mean(&found), largest, found[0], found[SIZE[0] * SIZE[1] - 1]];
            let near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-3);
            assert!(near, "{found:?}, not {expected:?}");
        }
    }

    #[test]
    fn extremes_are_those_of_the_scale() {
        let of = |a: [u8; 3], b: [u8; 3]| mean(&flip(16, [&[a; 256], &[b; 256]]));
        assert_eq!(of([9, 99, 199], [9, 99, 199]), 0.0);
        assert!((of([0, 255, 0], [0, 0, 255]) - 1.0).abs() < 1e-9, "the largest difference there is");
        assert!((of([0; 3], [255; 3]) - 0.967_391).abs() < 1e-3);
        assert!((of([0; 3], [255; 3]) - of([255; 3], [0; 3])).abs() < 1e-12, "it is symmetric");
    }
}
