//! Pictures that are computed for the report itself, pixel by pixel.

use crate::Result;
use crate::report::chart::Plot;
use crate::report::pictures::{Kind, encoded};
use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};

/// Samples of a pixel along each side.
const SAMPLES: u32 = 2;

/// A picture of `size` pixels; `color` tells what is seen (display colour, 0 to 1) at a place from (0, 0) at the top left to
/// (1, 1) at the bottom right.
///
/// # Errors
/// The picture cannot be encoded.
pub fn picture([width, height]: [u32; 2], alt: &str, color: impl Fn(DVec2) -> DVec3) -> Result<Plot> {
    let size = DVec2::new(f64::from(width), f64::from(height));
    let image = RgbImage::from_fn(width, height, |x, y| {
        let sample = |i: u32| {
            let within =
                DVec2::new(f64::from(i % SAMPLES) + 0.5, f64::from(i / SAMPLES) + 0.5) / f64::from(SAMPLES);
            color((DVec2::new(f64::from(x), f64::from(y)) + within) / size)
        };
        let mean = (0..SAMPLES * SAMPLES).map(sample).sum::<DVec3>() / f64::from(SAMPLES * SAMPLES);
        Rgb((255.0 * mean.clamp(DVec3::ZERO, DVec3::ONE)).round().to_array().map(|channel| channel as u8))
    });
    encoded(&image, Kind::Drawing, "computed for this report", (0, alt.to_owned()))
}
