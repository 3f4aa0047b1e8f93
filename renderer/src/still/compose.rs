//! The pixels of a still from what the device drew and found out.

use super::{Base, Show};
use crate::geometry::Grid;
use crate::gpu_interface::PixelData;
use crate::measure::ViewPixels;
use crate::output::{cluster_color, cubehelix, slice_color, srgb_decode, srgb_encode, tone_map};
use crate::passes::shade::BACKGROUND;
use half::f16;
use image::{Rgb, RgbImage};

/// No cluster, in [`PixelData::cluster_index`].
const NO_CLUSTER: u32 = u32::MAX;
/// Where no cluster exists (Gelderen figures 4.8 and 5.1).
const MISSING: [f32; 3] = [1.0, 0.0, 1.0];
/// Where nothing was hit, linear.
const NOTHING: [f32; 3] = [0.009; 3];
/// What is left of the light where a clustering shows nothing.
const DIMMED: f32 = 0.25;

/// What the device drew of one camera, row-major from the top left.
pub struct Layers {
    /// Linear radiance as the method shaded it; `None` where the camera is no view of the recording.
    pub shaded: Option<Vec<[f16; 4]>>,
    /// Surfaces without shading; alpha is the light on them.
    pub clay: Vec<[f16; 4]>,
    /// Lines and spheres, colour already multiplied with alpha.
    pub overlay: Vec<[f16; 4]>,
    /// Each clustering's knowledge of each pixel.
    pub clusterings: Vec<Vec<PixelData>>,
    /// Distance along the camera's -Z, metres; infinity where nothing was hit.
    pub distance: Vec<f32>,
    /// Base colours and normals of the G-buffer, as colours, where they are shown.
    pub gbuffer: Option<[Vec<[f16; 4]>; 2]>,
}

/// A pixel below the overlay, linear.
enum Surface {
    /// Radiance, which a display shows by tone mapping.
    Radiance([f32; 3]),
    /// A colour as it is.
    Plain([f32; 3]),
}

/// Puts the layers together: the picture as a display shows it, and the pixels for EXR, into which `view` has the
/// camera's name, size and matrices already.
pub fn compose(show: &Show, layers: &Layers, grids: &[Grid], view: ViewPixels) -> (RgbImage, ViewPixels) {
    let known = combined(layers);
    let most = known.iter().map(|pixel| show.base.count(pixel)).max().unwrap_or(0).max(1);
    let mut image = RgbImage::new(view.width, view.height);
    let mut color = Vec::with_capacity(known.len());
    for (position, target) in image.pixels_mut().enumerate() {
        let surface = surface(show, layers, (&known[position], position), (grids, most));
        let (shown, linear) = match surface {
            Surface::Radiance(light) => {
                (tone_map(light).map(|byte| srgb_decode(f32::from(byte) / 255.0)), light)
            }
            Surface::Plain(color) => (color, color),
        };
        let [r, g, b, coverage] = layers.overlay[position].map(f16::to_f32);
        let over = |below: [f32; 3]| -> [f32; 3] {
            std::array::from_fn(|i| below[i] * (1.0 - coverage.min(1.0)) + [r, g, b][i])
        };
        *target = pixel(over(shown));
        let [r, g, b] = over(linear).map(f16::from_f32);
        let below = covered(show, layers, position) * (1.0 - coverage.min(1.0));
        color.push([r, g, b, f16::from_f32(below + coverage.min(1.0))]);
    }
    let pixels = ViewPixels {
        color,
        background: if shows_radiance(show, layers) { BACKGROUND } else { NOTHING },
        depth: layers.distance.clone(),
        light_count: known.iter().map(|pixel| pixel.light_count).collect(),
        fragment_count: known.iter().map(|pixel| pixel.fragment_count).collect(),
        cluster_index: known.iter().map(|pixel| pixel.cluster_index).collect(),
        ..view
    };
    let image = layers.gbuffer.as_ref().map_or(image, |parts| side_by_side(parts, layers, &pixels));
    (image, pixels)
}

/// A linear colour as a display takes it.
fn pixel(color: [f32; 3]) -> Rgb<u8> {
    Rgb(color.map(|c| (srgb_encode(c.clamp(0.0, 1.0)) * 255.0).round() as u8))
}

/// What a G-buffer holds of a view: base colours, normals, and depth, by which what is nearest is white (Tegelaers figure 4.3).
fn side_by_side([base, normals]: &[Vec<[f16; 4]>; 2], layers: &Layers, view: &ViewPixels) -> RgbImage {
    let nearest = layers.distance.iter().copied().fold(f32::INFINITY, f32::min);
    let linear = |texel: [f16; 4]| [texel[0], texel[1], texel[2]].map(f16::to_f32);
    RgbImage::from_fn(3 * view.width, view.height, |x, y| {
        let at = (y * view.width + x % view.width) as usize;
        match x / view.width {
            0 => pixel(linear(base[at])),
            // Numbers, not light.
            1 => Rgb(linear(normals[at]).map(|c| (c * 255.0).round() as u8)),
            _ => match layers.distance[at] {
                far if far.is_infinite() => Rgb([0; 3]),
                distance => pixel([nearest / distance; 3]),
            },
        }
    })
}

/// Whether the picture is what the method shaded.
fn shows_radiance(show: &Show, layers: &Layers) -> bool {
    layers.shaded.is_some() && show.base.is_picture()
}

/// How much of a pixel is covered below the overlay, 0 to 1.
fn covered(show: &Show, layers: &Layers, position: usize) -> f32 {
    match (&layers.shaded, show.base) {
        (Some(shaded), base) if base.is_picture() => shaded[position][3].to_f32(),
        _ => f32::from(u8::from(layers.distance[position].is_finite())),
    }
}

/// A pixel's cluster with the clustering it belongs to.
struct Known {
    clustering: usize,
    light_count: u32,
    fragment_count: u32,
    cluster_index: u32,
}

/// Of several clusterings that know a pixel, the last is shown.
fn combined(layers: &Layers) -> Vec<Known> {
    (0..layers.distance.len())
        .map(|position| {
            let of = |c: usize| &layers.clusterings[c][position];
            let found = (0..layers.clusterings.len()).rev().find(|&c| of(c).cluster_index != NO_CLUSTER);
            found.map_or(
                Known { clustering: 0, light_count: 0, fragment_count: 0, cluster_index: NO_CLUSTER },
                |clustering| {
                    let PixelData { light_count, fragment_count, cluster_index, .. } = *of(clustering);
                    Known { clustering, light_count, fragment_count, cluster_index }
                },
            )
        })
        .collect()
}

impl Base {
    /// Whether surfaces show what was shaded, also beside other pictures.
    fn is_picture(self) -> bool {
        matches!(self, Self::Picture | Self::Gbuffer)
    }

    fn count(self, pixel: &Known) -> u32 {
        match self {
            Self::LightCount => pixel.light_count,
            Self::FragmentCount => pixel.fragment_count,
            Self::Picture | Self::Clusters | Self::Slices | Self::Gbuffer => 0,
        }
    }
}

fn surface(
    show: &Show,
    layers: &Layers,
    (pixel, position): (&Known, usize),
    (grids, most): (&[Grid], u32),
) -> Surface {
    let [r, g, b, light] = layers.clay[position].map(f16::to_f32);
    if layers.distance[position].is_infinite() {
        return match (&layers.shaded, show.base) {
            (Some(shaded), base) if base.is_picture() => radiance(shaded[position]),
            _ => Surface::Plain(NOTHING),
        };
    }
    let missing = pixel.cluster_index == NO_CLUSTER;
    if show.missing && missing {
        return Surface::Plain(MISSING.map(|c| c * light));
    }
    match (show.base, &layers.shaded) {
        (Base::Picture | Base::Gbuffer, Some(shaded)) => radiance(shaded[position]),
        (Base::Picture | Base::Gbuffer, None) => Surface::Plain([r, g, b]),
        _ if missing => Surface::Plain([DIMMED * light * light; 3]),
        (Base::Clusters | Base::Slices, _) => {
            let cell = grids[pixel.clustering].cluster_at(pixel.cluster_index);
            let color = if show.base == Base::Slices { slice_color(cell) } else { cluster_color(cell) };
            Surface::Plain(decoded(color).map(|c| c * light))
        }
        (Base::LightCount | Base::FragmentCount, _) => {
            let fraction = f64::from(show.base.count(pixel)) / f64::from(most);
            Surface::Plain(decoded(cubehelix(fraction)))
        }
    }
}

fn radiance([r, g, b, _]: [f16; 4]) -> Surface {
    Surface::Radiance([r, g, b].map(f16::to_f32))
}

fn decoded(color: [u8; 3]) -> [f32; 3] {
    color.map(|byte| srgb_decode(f32::from(byte) / 255.0))
}
