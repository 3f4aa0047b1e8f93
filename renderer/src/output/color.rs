//! Colours of previews, 8-bit sRGB.

use std::f64::consts::TAU;

/// What radiance is multiplied with before the curve.
const EXPOSURE: f32 = 1.0;

/// Where nothing was hit.
pub(super) const BACKGROUND: [u8; 3] = [24, 24, 24];

/// Linear HDR colour to display: a fixed exposure, a filmic curve per channel, the sRGB transfer function.
///
/// The curve is x(2.51x + 0.03) / (x(2.43x + 0.59) + 0.14), clamped to 1: Narkowicz's fit of the ACES reference
/// rendering ("ACES Filmic Tone Mapping Curve", 2015). NaN and negative light show as black.
pub fn tone_map(color: [f32; 3]) -> [u8; 3] {
    color.map(|channel| {
        // Beyond this the curve is at 1 already, and infinity over infinity is avoided.
        let x = (channel * EXPOSURE).clamp(0.0, 1e4);
        let x = if x.is_nan() { 0.0 } else { x };
        let display = (x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)).clamp(0.0, 1.0);
        to_byte(f64::from(srgb_encode(display)))
    })
}

/// The sRGB transfer function (IEC 61966-2-1), linear 0..1 to encoded 0..1.
pub(crate) fn srgb_encode(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The inverse of [`srgb_encode`].
pub(crate) fn srgb_decode(encoded: f32) -> f32 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// A colour whose lightness rises with `fraction` from black at 0 to white at 1 (Green 2011, "A colour scheme for
/// the display of astronomical intensity images"; start 0.5, rotations -1.5, hue 1, gamma 1).
pub fn cubehelix(fraction: f64) -> [u8; 3] {
    const START: f64 = 0.5;
    const ROTATIONS: f64 = -1.5;
    let lightness = fraction.clamp(0.0, 1.0);
    let angle = TAU * (START / 3.0 + 1.0 + ROTATIONS * lightness);
    let amplitude = lightness * (1.0 - lightness) / 2.0;
    let (sin, cos) = angle.sin_cos();
    [(-0.14861, 1.78277), (-0.29227, -0.90649), (1.97294, 0.0)]
        .map(|(along, across)| to_byte(lightness + amplitude * (along * cos + across * sin)))
}

/// Most lights that [`heat`] tells apart.
const HOTTEST: u32 = 150;

/// The colour of so many lights as M. Enhuber's thesis has it (*Comparison of Light Assignment Methods*, TU Graz 2019, figure
/// 4.10): from blue for none to red for 150, evenly, and green for more.
pub fn heat(lights: u32) -> [u8; 3] {
    if lights > HOTTEST {
        return [0, 255, 0];
    }
    let part = f64::from(lights) / f64::from(HOTTEST);
    [to_byte(part), 0, to_byte(1.0 - part)]
}

/// Half of each of two colours, as a display shows them.
pub(super) fn blend(a: [u8; 3], b: [u8; 3]) -> [u8; 3] {
    std::array::from_fn(|channel| a[channel].midpoint(b[channel]))
}

/// One of three colours that colour-blind readers tell apart (Okabe and Ito 2008: orange, sky blue, bluish green),
/// by the sum of the cluster's indices modulo 3: neighbours along every axis differ.
pub fn cluster_color([x, y, z]: [u32; 3]) -> [u8; 3] {
    [[230, 159, 0], [86, 180, 233], [0, 158, 115]][((x + y + z) % 3) as usize]
}

/// The slice of a cluster as colour: the three low bits of its index as red, green and blue (Ortiz).
pub fn slice_color([_, _, slice]: [u32; 3]) -> [u8; 3] {
    [0, 1, 2].map(|bit| if slice >> bit & 1 == 1 { 255 } else { 0 })
}

fn to_byte(fraction: f64) -> u8 {
    (fraction.clamp(0.0, 1.0) * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tone_map_is_black_at_zero_white_at_infinity_and_rises() {
        assert_eq!(tone_map([0.0, -1.0, f32::NAN]), [0, 0, 0]);
        assert_eq!(tone_map([f32::INFINITY, 1e9, 20.0]), [255, 255, 255]);
        let mut last = 0;
        for step in 0..2000 {
            let [value, ..] = tone_map([step as f32 * 0.005, 0.0, 0.0]);
            assert!(value >= last);
            last = value;
        }
    }

    #[test]
    fn tone_map_meets_values_computed_by_hand() {
        // 0.18: curve 0.18*(0.4518+0.03)/(0.18*(0.4374+0.59)+0.14) = 0.26689; sRGB 0.55357.
        assert_eq!(tone_map([0.18, 1.0, 0.001]), [141, 232, 1]);
    }

    #[test]
    fn cubehelix_meets_known_points() {
        assert_eq!(cubehelix(0.0), [0, 0, 0]);
        assert_eq!(cubehelix(0.25), [22, 83, 76]);
        assert_eq!(cubehelix(0.5), [160, 121, 73]);
        assert_eq!(cubehelix(0.75), [199, 179, 237]);
        assert_eq!(cubehelix(1.0), [255, 255, 255]);
        assert_eq!(cubehelix(7.0), [255, 255, 255]);
    }

    #[test]
    fn slices_are_the_three_low_bits_of_their_index() {
        assert_eq!(slice_color([7, 7, 0]), [0, 0, 0]);
        assert_eq!(
            [1, 2, 4].map(|slice| slice_color([0, 0, slice])),
            [[255, 0, 0], [0, 255, 0], [0, 0, 255]]
        );
        assert_eq!(slice_color([0, 0, 8 + 6]), [0, 255, 255]);
    }

    #[test]
    fn heat_goes_from_blue_to_red_and_is_green_beyond() {
        assert_eq!([0, 50, 150].map(heat), [[0, 0, 255], [85, 0, 170], [255, 0, 0]]);
        assert_eq!([151, u32::MAX].map(heat), [[0, 255, 0]; 2]);
        assert_eq!(blend([0, 255, 100], [101, 255, 0]), [50, 255, 50]);
    }

    #[test]
    fn neighbouring_clusters_differ() {
        for cell in [[0, 0, 0], [5, 3, 7], [2, 9, 4]] {
            for axis in 0..3 {
                let mut next = cell;
                next[axis] += 1;
                assert_ne!(cluster_color(cell), cluster_color(next));
            }
        }
    }
}
