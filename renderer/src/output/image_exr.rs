//! Multi-channel OpenEXR images: everything known of each pixel.
//!
//! One layer a view, named as the view (`mono`, or `left` and `right`), with the channels
//!
//! | channel | type | meaning |
//! | --- | --- | --- |
//! | R G B A | half | linear HDR colour; coverage: 0 where nothing was hit, the part of the samples at edges with MSAA |
//! | Z | float | distance along the view's -Z, metres; infinity where nothing was hit |
//! | light_count | uint | length of the light list of the pixel's cluster |
//! | fragment_count | uint | fragments in the pixel's cluster |
//! | cluster_index | uint | linear cluster index; 4294967295 where nothing was hit |
//!
//! and the standard attributes `worldToCamera`, `worldToNDC`, `screenWindowCenter`, `screenWindowWidth` and
//! `pixelAspectRatio`. The screen window is where a view's frustum meets the plane at distance 1 (OpenEXR, *Technical
//! Introduction*), in camera space. A file has one `pixelAspectRatio`: the first view's. As OpenEXR has it, points are row vectors that
//! are multiplied with the matrix from the left, the translation is in the last row, camera space is left-handed (+X
//! right, +Y up, the camera looks along +Z), and NDC is (0, 0) in the upper left and (1, 1) in the lower right corner
//! of the image. NDC z is the device depth.

use super::atomic::write_whole;
use crate::measure::ViewPixels;
use crate::{Error, Result};
use exr::error::Error as ExrError;
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds,
    Layer, LayerAttributes, LineOrder, Text, Vec2, WritableImage,
};
use glam::{DMat4, DVec3};
use std::io;
use std::path::Path;

/// Scan lines in order: the bytes depend on the pixels alone.
const ENCODING: Encoding = Encoding {
    compression: Compression::ZIP16,
    blocks: exr::image::Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

/// Writes the views, of equal size, as layers of one image. Equal pixels give equal bytes.
///
/// # Errors
/// There is no view, a view's data is not as long as its size says, or the file cannot be written.
pub fn write_exr(path: &Path, views: &[ViewPixels]) -> Result<()> {
    let first = views.first().ok_or_else(|| Error::Internal("an image without views".into()))?;
    for view in views {
        check_lengths(view)?;
    }
    let bounds = IntegerBounds::from_dimensions((first.width as usize, first.height as usize));
    let stereo = views.len() > 1;
    let layers: Vec<_> = views.iter().map(|view| layer(view, stereo)).collect();
    let mut attributes = ImageAttributes::new(bounds);
    attributes.pixel_aspect = pixel_aspect(first);
    let image = Image::from_layers(attributes, layers);
    write_whole(path, |file| {
        image.write().non_parallel().to_buffered(file).map_err(|error| match error {
            ExrError::Io(error) => error,
            other => io::Error::other(other.to_string()),
        })
    })
}

fn check_lengths(view: &ViewPixels) -> Result<()> {
    let pixels = view.width as usize * view.height as usize;
    let lengths = [
        view.color.len(),
        view.depth.len(),
        view.light_count.len(),
        view.fragment_count.len(),
        view.cluster_index.len(),
    ];
    if pixels > 0 && lengths.iter().all(|&length| length == pixels) {
        return Ok(());
    }
    let (name, width, height) = (&view.name, view.width, view.height);
    Err(Error::Internal(format!("view {name} of {width}x{height} pixels has data of lengths {lengths:?}")))
}

fn layer(view: &ViewPixels, stereo: bool) -> Layer<AnyChannels<FlatSamples>> {
    let color = |channel: usize| FlatSamples::F16(view.color.iter().map(|pixel| pixel[channel]).collect());
    let channels = [
        ("R", color(0)),
        ("G", color(1)),
        ("B", color(2)),
        ("A", color(3)),
        ("Z", FlatSamples::F32(view.depth.clone())),
        ("light_count", FlatSamples::U32(view.light_count.clone())),
        ("fragment_count", FlatSamples::U32(view.fragment_count.clone())),
        ("cluster_index", FlatSamples::U32(view.cluster_index.clone())),
    ];
    let view_from_world = view.world_from_view.inverse();
    let mut attributes = LayerAttributes::named(view.name.as_str());
    attributes.view_name = stereo.then(|| Text::from(view.name.as_str()));
    attributes.software_name = Some(Text::from(concat!("manylight ", env!("CARGO_PKG_VERSION"))));
    let (center, width) = screen_window(view);
    attributes.screen_window_center = Vec2(center[0] as f32, center[1] as f32);
    attributes.screen_window_width = width as f32;
    attributes.world_to_camera = Some(row_vector_matrix(camera_from_view() * view_from_world));
    attributes.world_to_normalized_device =
        Some(row_vector_matrix(ndc_from_clip() * view.clip_from_view * view_from_world));
    Layer::new(
        (view.width as usize, view.height as usize),
        attributes,
        ENCODING,
        AnyChannels::sort(
            channels.into_iter().map(|(name, samples)| AnyChannel::new(name, samples)).collect(),
        ),
    )
}

/// Centre and width of a view's screen window. Views that are no perspective have the neutral one, as the standard
/// asks.
fn screen_window(view: &ViewPixels) -> ([f64; 2], f64) {
    let clip = view.clip_from_view;
    if clip.z_axis.w != -1.0 {
        return ([0.0; 2], 1.0);
    }
    ([clip.z_axis.x / clip.x_axis.x, clip.z_axis.y / clip.y_axis.y], 2.0 / clip.x_axis.x)
}

/// Width over height of a pixel, so that the image has the shape of what was seen.
fn pixel_aspect(view: &ViewPixels) -> f32 {
    let clip = view.clip_from_view;
    let [width, height] = [view.width, view.height].map(f64::from);
    ((clip.y_axis.y * height) / (clip.x_axis.x * width)) as f32
}

/// View space (the camera looks along -Z) to OpenEXR's left-handed camera space.
fn camera_from_view() -> DMat4 {
    DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0))
}

/// Clip space (-1..1, +Y up) to OpenEXR's NDC (0..1, +Y down), both homogeneous.
fn ndc_from_clip() -> DMat4 {
    DMat4::from_translation(DVec3::new(0.5, 0.5, 0.0)) * DMat4::from_scale(DVec3::new(0.5, -0.5, 1.0))
}

/// A matrix for column vectors, by columns, is the matrix for row vectors, by rows.
fn row_vector_matrix(matrix: DMat4) -> [f32; 16] {
    matrix.to_cols_array().map(|value| value as f32)
}

#[cfg(test)]
mod tests {
    use super::super::testing::view;
    use super::*;
    use exr::prelude::{FlatImage, ReadChannels, ReadLayers, read};
    use half::f16;

    fn read_back(path: &Path) -> FlatImage {
        read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_file(path)
            .unwrap()
    }

    #[test]
    fn stereo_reads_back_as_named_layers_with_every_channel() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("000300.exr");
        let views = [view("left", 5, 3), view("right", 5, 3)];
        write_exr(&path, &views).unwrap();
        let image = read_back(&path);
        assert_eq!(image.layer_data.len(), 2);
        for (layer, view) in image.layer_data.iter().zip(&views) {
            assert_eq!(layer.attributes.layer_name, Some(Text::from(view.name.as_str())));
            assert_eq!(layer.attributes.view_name, Some(Text::from(view.name.as_str())));
            let names: Vec<String> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
            assert_eq!(names, ["A", "B", "G", "R", "Z", "cluster_index", "fragment_count", "light_count"]);
            let samples: Vec<&FlatSamples> = layer.channel_data.list.iter().map(|c| &c.sample_data).collect();
            let red: Vec<f16> = view.color.iter().map(|pixel| pixel[0]).collect();
            assert_eq!(samples[3], &FlatSamples::F16(red));
            assert_eq!(samples[4], &FlatSamples::F32(view.depth.clone()));
            assert_eq!(samples[5], &FlatSamples::U32(view.cluster_index.clone()));
            assert_eq!(samples[6], &FlatSamples::U32(view.fragment_count.clone()));
            assert_eq!(samples[7], &FlatSamples::U32(view.light_count.clone()));
        }
    }

    #[test]
    fn matrices_are_row_vector_matrices_to_camera_and_to_ndc() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("mono.exr");
        let mut mono = view("mono", 4, 2);
        mono.world_from_view = DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0));
        // Tangents of 1 both ways, reversed depth: near 0.5, far infinite.
        mono.clip_from_view = DMat4::from_cols_array_2d(&[
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, -1.0],
            [0.0, 0.0, 0.5, 0.0],
        ]);
        write_exr(&path, &[mono]).unwrap();
        let attributes = &read_back(&path).layer_data[0].attributes;
        assert_eq!(attributes.layer_name, Some(Text::from("mono")));
        assert_eq!(attributes.view_name, None);
        let camera = attributes.world_to_camera.unwrap();
        assert_eq!(camera[12..], [-1.0, -2.0, 3.0, 1.0]);
        assert_eq!(camera[8..11], [0.0, 0.0, -1.0], "what lies ahead (world -Z) has a positive camera z");
        let ndc = attributes.world_to_normalized_device.unwrap();
        // Ten metres ahead, five to the right and ten up: three quarters across, at the upper edge.
        let point = [1.0 + 5.0, 2.0 + 10.0, 3.0 - 10.0, 1.0];
        let out: Vec<f32> =
            (0..4).map(|column| (0..4).map(|row| point[row] * ndc[row * 4 + column]).sum()).collect();
        assert!((out[0] / out[3] - 0.75).abs() < 1e-6 && (out[1] / out[3]).abs() < 1e-6, "{out:?}");
    }

    #[test]
    fn the_header_has_the_shape_of_what_was_seen() {
        use crate::geometry::Frustum;
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("pair.exr");
        let eye = |name: &str, x0: f64, x1: f64| {
            let frustum = Frustum { x0, x1, y0: -1.0, y1: 3.0, z0: -100.0, z1: -0.1 };
            ViewPixels { clip_from_view: frustum.clip_from_view(), ..view(name, 16, 8) }
        };
        write_exr(&path, &[eye("left", -1.5, 0.5), eye("right", -0.25, 2.25)]).unwrap();
        let image = read_back(&path);
        // Two by four, in sixteen by eight pixels.
        assert_eq!(image.attributes.pixel_aspect, 0.25);
        let windows = image.layer_data.iter().map(|layer| {
            let Vec2(x, y) = layer.attributes.screen_window_center;
            [x, y, layer.attributes.screen_window_width]
        });
        assert_eq!(windows.collect::<Vec<_>>(), [[-0.5, 1.0, 2.0], [1.0, 1.0, 2.5]]);
    }

    #[test]
    fn equal_pixels_give_equal_bytes() {
        let dir = tempfile::tempdir().unwrap();
        let bytes = ["a.exr", "b.exr"].map(|name| {
            let path = dir.path().join(name);
            write_exr(&path, &[view("left", 40, 37), view("right", 40, 37)]).unwrap();
            std::fs::read(path).unwrap()
        });
        assert_eq!(bytes[0], bytes[1]);
    }

    #[test]
    fn data_of_the_wrong_length_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("x.exr");
        let mut broken = view("mono", 4, 2);
        broken.depth.pop();
        assert!(matches!(write_exr(&path, &[broken]), Err(Error::Internal(_))));
        assert!(matches!(write_exr(&path, &[]), Err(Error::Internal(_))));
        assert!(!path.exists());
    }
}
