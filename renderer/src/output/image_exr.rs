//! Multi-channel OpenEXR images: everything known of each pixel.
//!
//! Each view (`mono`, or `left` and `right`) has the channels
//!
//! | channel | type | meaning |
//! | --- | --- | --- |
//! | R G B A | half | linear HDR colour of what was hit, multiplied with its coverage: 0 where nothing was, the part of the samples at edges with MSAA |
//! | Z | float | distance along the view's -Z, metres; infinity where nothing was hit |
//! | light_count | uint | length of the light list of the pixel's cluster |
//! | fragment_count | uint | fragments in the pixel's cluster |
//! | cluster_index | uint | linear cluster index; 4294967295 where nothing was hit |
//!
//! which lie in one of two layouts (OpenEXR, *Storing Multi-View Images in OpenEXR Files*):
//!
//! ```text
//! multipart    a part a view, named as it, with its channels and its attributes
//! multiview    one part; the first view's channels by their names, another's behind its own: right.R, right.Z, ...
//!              multiView lists the views; standard attributes are the first view's, manylightViews has those of all
//!              as JSON: {"left": {"worldToCamera": [16], "worldToNDC": [16], "screenWindowCenter": [2],
//!              "screenWindowWidth": x}, "right": ...}
//! ```
//!
//! The standard attributes are `worldToCamera`, `worldToNDC`, `screenWindowCenter`, `screenWindowWidth` and
//! `pixelAspectRatio`. The screen window is where a view's frustum meets the plane at distance 1 (OpenEXR, *Technical
//! Introduction*), in camera space. A file has one `pixelAspectRatio`: the first view's. As OpenEXR has it, points are row vectors that
//! are multiplied with the matrix from the left, the translation is in the last row, camera space is left-handed (+X
//! right, +Y up, the camera looks along +Z), and NDC is (0, 0) in the upper left and (1, 1) in the lower right corner
//! of the image. NDC z is the device depth.

use super::atomic::write_whole;
use crate::config::ExrLayout;
use crate::measure::ViewPixels;
use crate::{Error, Result};
use exr::error::Error as ExrError;
use exr::meta::attribute::AttributeValue;
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds,
    Layer, LayerAttributes, LineOrder, Text, Vec2, WritableImage,
};
use glam::{DMat4, DVec3};
use half::f16;
use serde::Serialize;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Scan lines in order: the bytes depend on the pixels alone.
const ENCODING: Encoding = Encoding {
    compression: Compression::ZIP16,
    blocks: exr::image::Blocks::ScanLines,
    line_order: LineOrder::Increasing,
};

/// The attribute of [`ExrLayout::Multiview`] that has every view's camera.
const CAMERAS: &str = "manylightViews";

/// Writes the views, of equal size, as one image. Equal pixels give equal bytes.
///
/// # Errors
/// There is no view, a view's data is not as long as its size says, or the file cannot be written.
pub fn write_exr(path: &Path, views: &[ViewPixels], layout: ExrLayout) -> Result<()> {
    let first = views.first().ok_or_else(|| Error::Internal("an image without views".into()))?;
    for view in views {
        check_lengths(view)?;
    }
    let bounds = IntegerBounds::from_dimensions((first.width as usize, first.height as usize));
    let layers = match layout {
        ExrLayout::Multipart => views.iter().map(|view| part(view, views.len() > 1)).collect(),
        ExrLayout::Multiview => vec![one_part(first, views)?],
    };
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

/// A view alone.
fn part(view: &ViewPixels, stereo: bool) -> Layer<AnyChannels<FlatSamples>> {
    let mut attributes = Camera::of(view).attributes();
    attributes.layer_name = Some(Text::from(view.name.as_str()));
    attributes.view_name = stereo.then(|| Text::from(view.name.as_str()));
    layer(view, attributes, channels(view, ""))
}

/// All views; of a view that is the only one, nothing tells it from an image that knows no views.
fn one_part(first: &ViewPixels, views: &[ViewPixels]) -> Result<Layer<AnyChannels<FlatSamples>>> {
    let mut attributes = Camera::of(first).attributes();
    if views.len() > 1 {
        attributes.multi_view_names = Some(views.iter().map(|view| Text::from(view.name.as_str())).collect());
        // One attribute of our own, for the file's order of several would change from run to run.
        attributes.other.insert(Text::from(CAMERAS), AttributeValue::Text(cameras(views)?));
    }
    let others = views[1..].iter().flat_map(|view| channels(view, &format!("{}.", view.name)));
    Ok(layer(first, attributes, channels(first, "").into_iter().chain(others)))
}

fn layer(
    view: &ViewPixels,
    attributes: LayerAttributes,
    channels: impl IntoIterator<Item = AnyChannel<FlatSamples>>,
) -> Layer<AnyChannels<FlatSamples>> {
    let size = (view.width as usize, view.height as usize);
    Layer::new(size, attributes, ENCODING, AnyChannels::sort(channels.into_iter().collect()))
}

/// Everything known of a view's pixels; names begin with `prefix`.
fn channels(view: &ViewPixels, prefix: &str) -> [AnyChannel<FlatSamples>; 8] {
    let color = premultiplied(view);
    let of_color = |channel: usize| FlatSamples::F16(color.iter().map(|pixel| pixel[channel]).collect());
    [
        ("R", of_color(0)),
        ("G", of_color(1)),
        ("B", of_color(2)),
        ("A", of_color(3)),
        ("Z", FlatSamples::F32(view.depth.clone())),
        ("light_count", FlatSamples::U32(view.light_count.clone())),
        ("fragment_count", FlatSamples::U32(view.fragment_count.clone())),
        ("cluster_index", FlatSamples::U32(view.cluster_index.clone())),
    ]
    .map(|(name, samples)| AnyChannel {
        name: Text::from(format!("{prefix}{name}").as_str()),
        // Whether samples are perceptually linear is guessed by the name, which must be the channel's own.
        ..AnyChannel::new(name, samples)
    })
}

/// The colour of what covers each pixel: the background's part is taken off.
fn premultiplied(view: &ViewPixels) -> Vec<[f16; 4]> {
    let of_pixel = |&[r, g, b, a]: &[f16; 4]| {
        if a == f16::ONE {
            return [r, g, b, a];
        }
        if a == f16::ZERO {
            return [f16::ZERO; 4];
        }
        let [r, g, b] = std::array::from_fn(|channel| {
            let behind = view.background[channel] * (1.0 - a.to_f32());
            f16::from_f32(([r, g, b][channel].to_f32() - behind).max(0.0))
        });
        [r, g, b, a]
    };
    view.color.iter().map(of_pixel).collect()
}

/// Where a view was seen from, as OpenEXR's attributes of these names have it.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Camera {
    world_to_camera: [f32; 16],
    #[serde(rename = "worldToNDC")]
    world_to_ndc: [f32; 16],
    screen_window_center: [f32; 2],
    screen_window_width: f32,
}

impl Camera {
    fn of(view: &ViewPixels) -> Self {
        let view_from_world = view.world_from_view.inverse();
        let (center, width) = screen_window(view);
        Self {
            world_to_camera: row_vector_matrix(camera_from_view() * view_from_world),
            world_to_ndc: row_vector_matrix(ndc_from_clip() * view.clip_from_view * view_from_world),
            screen_window_center: center.map(|value| value as f32),
            screen_window_width: width as f32,
        }
    }

    fn attributes(&self) -> LayerAttributes {
        let [x, y] = self.screen_window_center;
        LayerAttributes {
            software_name: Some(Text::from(concat!("manylight ", env!("CARGO_PKG_VERSION")))),
            screen_window_center: Vec2(x, y),
            screen_window_width: self.screen_window_width,
            world_to_camera: Some(self.world_to_camera),
            world_to_normalized_device: Some(self.world_to_ndc),
            ..LayerAttributes::default()
        }
    }
}

/// Every view's camera by the view's name, JSON.
fn cameras(views: &[ViewPixels]) -> Result<Text> {
    let all: BTreeMap<&str, Camera> =
        views.iter().map(|view| (view.name.as_str(), Camera::of(view))).collect();
    let json = serde_json::to_string(&all)
        .map_err(|error| Error::Internal(format!("a camera is not JSON: {error}")))?;
    Ok(Text::from(json.as_str()))
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
mod tests;
