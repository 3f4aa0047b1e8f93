//! PNG previews of one frame, all views side by side.

use super::atomic::write_whole;
use super::color::{BACKGROUND, blend, cluster_color, cubehelix, heat, slice_color, tone_map};
use crate::Result;
use crate::geometry::cell_at;
use crate::measure::ViewPixels;
use image::{ImageFormat, Rgb, RgbImage};
use std::io;
use std::path::Path;

/// Writes `stem.png` (tone-mapped), `stem_lights.png` (see [`light_preview`]), which ends at the frame's own most lights,
/// `stem_share.png` (see [`share_preview`]), `stem_heat.png` (see [`heat_preview`]), `stem_clusters.png` and, of grids that have several slices, `stem_slices.png`.
///
/// # Errors
/// A file cannot be written.
pub fn write_previews(directory: &Path, stem: &str, views: &[ViewPixels]) -> Result<()> {
    let mut previews = vec![
        ("", image_preview(views)),
        ("_lights", light_preview(views, None)),
        ("_share", share_preview(views)),
        ("_heat", heat_preview(views)),
        ("_clusters", cluster_preview(views, cluster_color)),
    ];
    if views.iter().any(|view| view.dimensions[2] > 1) {
        previews.push(("_slices", cluster_preview(views, slice_color)));
    }
    for (suffix, preview) in previews {
        write_png(&directory.join(format!("{stem}{suffix}.png")), &preview)?;
    }
    Ok(())
}

/// Writes an image as PNG.
///
/// # Errors
/// The file cannot be written.
pub fn write_png(path: &Path, image: &RgbImage) -> Result<()> {
    write_whole(path, |file| {
        image.write_to(file, ImageFormat::Png).map_err(|error| match error {
            image::ImageError::IoError(error) => error,
            other => io::Error::other(other.to_string()),
        })
    })
}

/// The image as a display shows it.
pub fn image_preview(views: &[ViewPixels]) -> RgbImage {
    side_by_side(views, displayed)
}

/// A pixel's colour as a display shows it.
fn displayed(view: &ViewPixels, pixel: usize) -> [u8; 3] {
    let [r, g, b, _] = view.color[pixel];
    tone_map([r, g, b].map(|channel| channel.to_f32()))
}

/// The image blended, half and half, with the lights of each pixel's group as colour, by the same scale in every frame of every
/// method: blue for none to red for 150, green for more. Where nothing was hit, the image alone.
pub fn heat_preview(views: &[ViewPixels]) -> RgbImage {
    side_by_side(views, |view, pixel| {
        let image = displayed(view, pixel);
        if view.depth[pixel].is_infinite() { image } else { blend(image, heat(view.light_count[pixel])) }
    })
}

/// Lights per cluster as colour (cubehelix): black for none, white for `most_lights`, or for the most in these views
/// where it is `None`. Dark grey where nothing was hit.
pub fn light_preview(views: &[ViewPixels], most_lights: Option<u32>) -> RgbImage {
    let in_frame = || views.iter().flat_map(|view| &view.light_count).copied().max().unwrap_or(0);
    let scale = f64::from(most_lights.unwrap_or_else(in_frame).max(1));
    side_by_side(views, |view, pixel| {
        if view.depth[pixel].is_infinite() {
            BACKGROUND
        } else {
            cubehelix(f64::from(view.light_count[pixel]) / scale)
        }
    })
}

/// The lights of each pixel's group as a part of all lights of the frame, which is what a pixel costs relative to computing them
/// all (Tegelaers), as [`light_preview`] has them: white for all.
pub fn share_preview(views: &[ViewPixels]) -> RgbImage {
    light_preview(views, views.iter().map(|view| view.lights).max())
}

/// Clusters as colour, dark where there is none.
fn cluster_preview(views: &[ViewPixels], color: fn([u32; 3]) -> [u8; 3]) -> RgbImage {
    side_by_side(views, |view, pixel| match view.cluster_index[pixel] {
        u32::MAX => BACKGROUND,
        index => color(cell_at(index, view.dimensions)),
    })
}

/// One image with the views from left to right; `color` is given a view and the index of its pixel.
fn side_by_side(views: &[ViewPixels], color: impl Fn(&ViewPixels, usize) -> [u8; 3]) -> RgbImage {
    let width = views.iter().map(|view| view.width).sum();
    let height = views.iter().map(|view| view.height).max().unwrap_or(0);
    let mut image = RgbImage::from_pixel(width, height, Rgb(BACKGROUND));
    let mut left = 0;
    for view in views {
        for (y, x) in (0..view.height).flat_map(|y| (0..view.width).map(move |x| (y, x))) {
            let pixel = y as usize * view.width as usize + x as usize;
            image.put_pixel(left + x, y, Rgb(color(view, pixel)));
        }
        left += view.width;
    }
    image
}

#[cfg(test)]
mod tests {
    use super::super::testing::view;
    use super::*;

    #[test]
    fn heat_map_has_the_known_colours_at_known_counts() {
        let mut pixels = view("mono", 4, 1);
        pixels.light_count = vec![0, 0, 50, 100];
        let image = light_preview(&[pixels.clone()], None);
        let colors: Vec<[u8; 3]> = image.pixels().map(|pixel| pixel.0).collect();
        assert_eq!(colors, [[24, 24, 24], [0, 0, 0], [160, 121, 73], [255, 255, 255]]);
        let image = light_preview(&[pixels], Some(200));
        assert_eq!(image.get_pixel(3, 0).0, [160, 121, 73]);
    }

    #[test]
    fn shares_are_of_all_lights_whatever_the_most_of_a_pixel() {
        let mut pixels = view("mono", 3, 1);
        (pixels.lights, pixels.light_count) = (100, vec![50, 50, 25]);
        let image = share_preview(&[pixels.clone()]);
        let colors: Vec<[u8; 3]> = image.pixels().map(|pixel| pixel.0).collect();
        assert_eq!(colors, [BACKGROUND, [160, 121, 73], [22, 83, 76]]);
        pixels.light_count = vec![100; 3];
        assert_eq!(share_preview(&[pixels]).get_pixel(1, 0).0, [255; 3], "what computes all is white");
    }

    #[test]
    fn heat_is_half_of_what_is_hit_whatever_the_frame() {
        let mut pixels = view("mono", 4, 1);
        pixels.light_count = vec![900, 0, 150, 151];
        let image = heat_preview(&[pixels.clone()]);
        let seen = image_preview(&[pixels]);
        for (pixel, color) in [[0, 0, 255], [255, 0, 0], [0, 255, 0]].into_iter().enumerate() {
            let at = pixel as u32 + 1;
            assert_eq!(image.get_pixel(at, 0).0, blend(seen.get_pixel(at, 0).0, color), "pixel {at}");
        }
        assert_eq!(image.get_pixel(0, 0), seen.get_pixel(0, 0), "nothing was hit there");
        assert_ne!(image.get_pixel(1, 0), seen.get_pixel(1, 0));
    }

    #[test]
    fn a_frame_without_lights_is_black_not_undefined() {
        let mut pixels = view("mono", 2, 1);
        pixels.light_count = vec![0, 0];
        assert_eq!(light_preview(&[pixels], None).get_pixel(1, 0).0, [0, 0, 0]);
    }

    #[test]
    fn views_stand_side_by_side_and_read_back() {
        let dir = tempfile::tempdir().unwrap();
        let (left, right) = (view("left", 3, 2), view("right", 3, 2));
        write_previews(dir.path(), "000300", &[left.clone(), right]).unwrap();
        let read = |name: &str| image::open(dir.path().join(name)).unwrap().to_rgb8();
        let clusters = read("000300_clusters.png");
        assert_eq!(clusters.dimensions(), (6, 2));
        assert_eq!(clusters.get_pixel(0, 0).0, [24, 24, 24]);
        assert_eq!(clusters.get_pixel(3, 0).0, [24, 24, 24]);
        assert_eq!(clusters.get_pixel(1, 0).0, cluster_color([1, 0, 0]));
        assert_eq!(clusters.get_pixel(3, 1).0, cluster_color([1, 1, 0]));
        assert!(!dir.path().join("000300_slices.png").exists(), "a grid of one slice");
        let [r, g, b, _] = left.color[5].map(|channel| channel.to_f32());
        assert_eq!(read("000300.png").get_pixel(2, 1).0, tone_map([r, g, b]));
        for other in ["lights", "share", "heat"] {
            assert_eq!(read(&format!("000300_{other}.png")).dimensions(), (6, 2));
        }
    }

    #[test]
    fn slices_are_shown_where_there_are_several() {
        let dir = tempfile::tempdir().unwrap();
        let pixels = ViewPixels { dimensions: [2, 1, 3], ..view("mono", 3, 2) };
        write_previews(dir.path(), "000007", &[pixels]).unwrap();
        let slices = image::open(dir.path().join("000007_slices.png")).unwrap().to_rgb8();
        let colors: Vec<[u8; 3]> = slices.pixels().map(|pixel| pixel.0).collect();
        let [red, green] = [[255, 0, 0], [0, 255, 0]];
        assert_eq!(colors, [[24, 24, 24], [0; 3], red, red, green, green]);
    }
}
