//! The comparison of rendered frames, layer by layer and channel by channel.
//!
//! Integers are compared exactly. Of floats the largest and the root mean square difference are told, and of colours
//! how different they look as a display shows them ([`super::flip`], of what the PNG beside the EXR holds).

use super::flip::flip;
use crate::output::{cubehelix, tone_map, write_png};
use crate::{Error, Result};
use exr::prelude::{AnyChannels, FlatSamples, Layer, ReadChannels, ReadLayers, Text, read};
use image::{Rgb, RgbImage};
use serde::Serialize;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

/// One layer of one frame that both sets have.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ImageComparison {
    /// Its file in a run's `frames`.
    pub file: String,
    /// The layer: a view.
    pub layer: String,
    /// Channels that both have, by name.
    pub channels: Vec<ChannelComparison>,
    /// Channels that one side alone has, or all where the sizes of the images differ.
    pub not_compared: Vec<String>,
    /// How different the colours look, from 0 to 1; `None` without colours.
    pub flip: Option<Flip>,
}

/// How different two pictures look.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Flip {
    /// Mean over pixels.
    pub mean: f64,
    /// Of the pixel that differs most.
    pub largest: f64,
}

/// One channel of a layer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChannelComparison {
    /// Its name.
    pub channel: String,
    /// Whether it holds integers, which must be equal.
    pub exact: bool,
    /// How many pixels differ.
    pub pixels_differing: usize,
    /// The largest difference. Pixels that are finite on one side alone count as differing and not here.
    pub largest: f64,
    /// The root of the mean square difference, of the same pixels.
    pub root_mean_square: f64,
}

type AnyLayer = Layer<AnyChannels<FlatSamples>>;

/// Every layer of every frame that was rendered to a file by both runs; with `out`, pictures of differences go there.
///
/// # Errors
/// An image is no EXR image, or a picture cannot be written.
pub(super) fn compare(runs: [&Path; 2], out: Option<&Path>) -> Result<Vec<ImageComparison>> {
    let mut compared = vec![];
    for file in images(runs[0]) {
        let paths = runs.map(|run| run.join("frames").join(&file));
        if !paths[1].is_file() {
            continue;
        }
        let [a, b] = [layers(&paths[0])?, layers(&paths[1])?];
        for layer in &a {
            let Some(other) = b.iter().find(|other| name(other) == name(layer)) else { continue };
            compared.push(compare_layer(&file, [layer, other], out)?);
        }
    }
    Ok(compared)
}

/// Names of the EXR images of a run, in order; none where nothing was rendered to files.
fn images(run: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(run.join("frames")) else { return vec![] };
    let names = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(".exr")).collect();
    names.sort();
    names
}

fn layers(path: &Path) -> Result<Vec<AnyLayer>> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_file(path)
        .map_err(|error| Error::file(path, format!("is no EXR image that can be read: {error}")))?;
    Ok(image.layer_data.into_iter().flat_map(by_view).collect())
}

/// The views of a layer that holds several: the first view's channels have their plain names, another's are behind its own
/// name and a point. Any other layer as it is.
fn by_view(layer: AnyLayer) -> Vec<AnyLayer> {
    let Some(views) = layer.attributes.multi_view_names.clone() else { return vec![layer] };
    let prefixes: Vec<String> = views.iter().skip(1).map(|view| format!("{view}.")).collect();
    let plain = |name: &str| !prefixes.iter().any(|prefix| name.starts_with(prefix));
    let of_view = |(number, view): (usize, &Text)| {
        let mut this = layer.clone();
        this.attributes.layer_name = Some(view.clone());
        this.channel_data.list.retain_mut(|channel| {
            let name = channel.name.to_string();
            let own = match number {
                0 => plain(&name).then_some(name.as_str()),
                _ => name.strip_prefix(&prefixes[number - 1]),
            };
            own.map(|own| channel.name = own.into()).is_some()
        });
        this
    };
    views.iter().enumerate().map(of_view).collect()
}

fn name(layer: &AnyLayer) -> String {
    layer.attributes.layer_name.as_ref().map(ToString::to_string).unwrap_or_default()
}

fn samples<'l>(layer: &'l AnyLayer, channel: &str) -> Option<&'l FlatSamples> {
    layer.channel_data.list.iter().find(|known| known.name.eq(channel)).map(|known| &known.sample_data)
}

fn compare_layer(file: &str, layers: [&AnyLayer; 2], out: Option<&Path>) -> Result<ImageComparison> {
    let mut compared = ImageComparison {
        file: file.to_owned(),
        layer: name(layers[0]),
        channels: vec![],
        not_compared: vec![],
        flip: None,
    };
    let same_size = layers[0].size == layers[1].size;
    let picture = Pictures { out, file, layer: &compared.layer.clone(), width: layers[0].size.0 };
    for channel in
        layers.iter().flat_map(|layer| &layer.channel_data.list).map(|channel| channel.name.to_string())
    {
        if compared.knows(&channel) {
            continue;
        }
        match layers.map(|layer| samples(layer, &channel)) {
            [Some(a), Some(b)] if same_size => {
                compared.channels.push(compare_channel(channel, [a, b], &picture)?)
            }
            _ => compared.not_compared.push(channel),
        }
    }
    if same_size {
        compared.flip = compare_colors(layers, &picture)?;
    }
    Ok(compared)
}

fn compare_channel(
    channel: String,
    [a, b]: [&FlatSamples; 2],
    picture: &Pictures<'_>,
) -> Result<ChannelComparison> {
    let exact = matches!([a, b], [FlatSamples::U32(_), FlatSamples::U32(_)]);
    let [a, b] = [a, b].map(numbers);
    let differs: Vec<bool> = a.iter().zip(&b).map(|(a, b)| a != b && !(a.is_nan() && b.is_nan())).collect();
    let differences = a.iter().zip(&b).map(|(a, b)| if a == b { 0.0 } else { (a - b).abs() });
    let finite: Vec<f64> = differences.filter(|difference| difference.is_finite()).collect();
    let squares: f64 = finite.iter().map(|difference| difference * difference).sum();
    let pixels_differing = differs.iter().filter(|differs| **differs).count();
    if exact && pixels_differing > 0 {
        picture.write(&channel, differs.iter().map(|differs| if *differs { [255; 3] } else { [0; 3] }))?;
    }
    Ok(ChannelComparison {
        channel,
        exact,
        pixels_differing,
        largest: finite.iter().copied().fold(0.0, f64::max),
        root_mean_square: (squares / finite.len().max(1) as f64).sqrt(),
    })
}

fn numbers(samples: &FlatSamples) -> Vec<f64> {
    match samples {
        FlatSamples::F16(values) => values.iter().map(|value| value.to_f64()).collect(),
        FlatSamples::F32(values) => values.iter().copied().map(f64::from).collect(),
        FlatSamples::U32(values) => values.iter().copied().map(f64::from).collect(),
    }
}

/// `None` where a side lacks a colour.
fn compare_colors(layers: [&AnyLayer; 2], picture: &Pictures<'_>) -> Result<Option<Flip>> {
    let [Some(a), Some(b)] = layers.map(displayed) else { return Ok(None) };
    if a == b {
        return Ok(Some(Flip { mean: 0.0, largest: 0.0 }));
    }
    let differences = flip(picture.width, [&a, &b]);
    picture.write("flip", differences.iter().map(|difference| cubehelix(*difference)))?;
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    Ok(Some(Flip { mean, largest: differences.into_iter().fold(0.0, f64::max) }))
}

/// The colours of a layer as a display shows them.
fn displayed(layer: &AnyLayer) -> Option<Vec<[u8; 3]>> {
    let [r, g, b] = ["R", "G", "B"].map(|channel| samples(layer, channel).map(numbers));
    let (r, g, b) = (r?, g?, b?);
    let pixel = |place: usize| tone_map([r[place], g[place], b[place]].map(|value| value as f32));
    Some((0..r.len()).map(pixel).collect())
}

/// Where pictures of differences go.
struct Pictures<'a> {
    out: Option<&'a Path>,
    file: &'a str,
    layer: &'a str,
    width: usize,
}

impl Pictures<'_> {
    /// Writes `000300_left_flip.png`, say, where pictures are wanted.
    fn write(&self, what: &str, pixels: impl ExactSizeIterator<Item = [u8; 3]>) -> Result<()> {
        let Some(out) = self.out else { return Ok(()) };
        let height = pixels.len() / self.width.max(1);
        let mut image = RgbImage::new(self.width as u32, height as u32);
        image.pixels_mut().zip(pixels).for_each(|(place, pixel)| *place = Rgb(pixel));
        let stem = self.file.trim_end_matches(".exr");
        write_png(&out.join(format!("{stem}_{}_{what}.png", self.layer)), &image)
    }
}

/// Where the pictures of a run go below a directory: by its path below that of its set.
pub(super) fn directory_of(out: &Path, set: &Path, run: &Path) -> PathBuf {
    match run.strip_prefix(set) {
        Ok(below) if !below.as_os_str().is_empty() => out.join(below),
        _ => out.join(run.file_name().unwrap_or_default()),
    }
}

impl ImageComparison {
    /// Whether integers differ.
    pub fn integers_differ(&self) -> bool {
        self.channels.iter().any(|channel| channel.exact && channel.pixels_differing > 0)
    }

    /// Whether anything differs, or could not be compared.
    pub fn differs(&self) -> bool {
        !self.not_compared.is_empty() || self.channels.iter().any(|channel| channel.pixels_differing > 0)
    }

    fn knows(&self, channel: &str) -> bool {
        self.not_compared.iter().any(|known| known == channel)
            || self.channels.iter().any(|known| known.channel == channel)
    }
}

impl fmt::Display for ImageComparison {
    /// Such as `000300.exr left: R differs in 7 pixels (largest 0.01, rms 0.0002), FLIP 0.0001 (largest 0.2)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let differing = self.channels.iter().filter(|channel| channel.pixels_differing > 0);
        let mut parts: Vec<String> = differing
            .map(|channel| {
                let ChannelComparison { channel, pixels_differing, largest, root_mean_square, .. } = channel;
                format!(
                    "{channel} differs in {pixels_differing} pixels (largest {largest:.3e}, rms {root_mean_square:.3e})"
                )
            })
            .collect();
        if !self.not_compared.is_empty() {
            parts.push(format!("{} not compared", self.not_compared.join(", ")));
        }
        if let Some(Flip { mean, largest }) = self.flip {
            parts.push(format!("FLIP {mean:.4} (largest {largest:.4})"));
        }
        write!(f, "{} {}: {}", self.file, self.layer, parts.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::ExrLayout;
    use crate::output::{testing::view, write_exr};

    fn write(run: &Path, change: impl Fn(&mut crate::measure::ViewPixels)) {
        let mut views = [view("left", 8, 5), view("right", 8, 5)];
        change(&mut views[1]);
        write_exr(&run.join("frames/000300.exr"), &views, ExrLayout::Multipart).unwrap();
    }

    #[test]
    fn channels_are_compared_exactly_or_by_how_far_they_lie_apart() {
        let root = tempfile::tempdir().unwrap();
        let [a, b, out] = ["a", "b", "out"].map(|name| root.path().join(name));
        write(&a, |_| ());
        write(&b, |view| {
            view.depth[5] += 0.5;
            view.depth[6] = f32::INFINITY;
            view.light_count[3] += 1;
            view.color[7] = [half::f16::ONE; 4];
        });
        fs::write(a.join("frames/000301.exr"), "only one side has it").unwrap();
        let compared = compare([&a, &b], Some(&out)).unwrap();
        let [left, right] = compared.as_slice() else { panic!("two layers: {compared:?}") };
        assert!(
            !left.differs()
                && left.flip == Some(Flip { mean: 0.0, largest: 0.0 })
                && left.channels.len() == 8
        );
        let channel = |name: &str| right.channels.iter().find(|channel| channel.channel == name).unwrap();
        let depth = channel("Z");
        assert_eq!((depth.exact, depth.pixels_differing, depth.largest), (false, 2, 0.5));
        assert!((depth.root_mean_square - (0.25_f64 / 39.0).sqrt()).abs() < 1e-9, "infinity is left out");
        assert!(channel("light_count").exact && channel("light_count").pixels_differing == 1);
        assert!(right.integers_differ() && right.differs() && right.flip.unwrap().largest > 0.1, "{right}");
        let mask = image::open(out.join("000300_right_light_count.png")).unwrap().to_rgb8();
        assert_eq!((mask.get_pixel(3, 0).0, mask.get_pixel(4, 0).0), ([255; 3], [0; 3]));
        let names: Vec<_> = fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert!(names.len() == 2 && names.contains(&"000300_right_flip.png".into()), "{names:?}");
        assert!(right.to_string().starts_with("000300.exr right: "), "{right}");
    }

    #[test]
    fn views_in_one_part_are_those_in_parts() {
        let root = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| root.path().join(name));
        write(&a, |_| ());
        let mut views = [view("left", 8, 5), view("right", 8, 5)];
        views[1].light_count[3] += 1;
        write_exr(&b.join("frames/000300.exr"), &views, ExrLayout::Multiview).unwrap();
        let compared = compare([&a, &b], None).unwrap();
        let [left, right] = compared.as_slice() else { panic!("two layers: {compared:?}") };
        assert!((left.layer.as_str(), right.layer.as_str()) == ("left", "right"));
        assert!(!left.differs() && left.channels.len() == 8, "{left}");
        let differing: Vec<&str> =
            right.channels.iter().filter(|c| c.pixels_differing > 0).map(|c| c.channel.as_str()).collect();
        assert_eq!((differing, right.channels.len()), (vec!["light_count"], 8));
    }

    #[test]
    fn what_is_no_image_is_refused_by_name() {
        let root = tempfile::tempdir().unwrap();
        let run = root.path();
        write(run, |_| ());
        fs::write(run.join("frames/000300.exr"), "no image").unwrap();
        assert!(compare([run, run], None).unwrap_err().to_string().contains("000300.exr: is no EXR image"));
    }

    #[test]
    fn images_of_other_sizes_are_told_and_not_compared() {
        let root = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "b"].map(|name| root.path().join(name));
        for (run, width) in [(&a, 8), (&b, 4)] {
            write_exr(&run.join("frames/000300.exr"), &[view("mono", width, 5)], ExrLayout::Multipart)
                .unwrap();
        }
        let compared = compare([&a, &b], None).unwrap();
        assert!(compared[0].differs() && compared[0].not_compared.len() == 8 && compared[0].flip.is_none());
    }
}
