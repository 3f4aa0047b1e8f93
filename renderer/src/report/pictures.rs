//! Rendered frames, and galleries of frames with the light counts of every method.

use super::figure::Figure;
use crate::methods::{Method, Sharing};
use crate::report::chart::{Chart, Picture as Shown, Plot};
use crate::report::data_uri;
use crate::report::results::{
    LightingName, Picture, ResultSet, Run, Setting, is_tuned, lightings, method_name,
};
use crate::{Error, Result};
use image::codecs::jpeg::JpegEncoder;
use image::imageops::FilterType;
use image::{ImageFormat, RgbImage};
use std::io::Cursor;
use std::path::Path;

/// Pictures are shown no wider, so that a page stays small.
const WIDEST: u32 = 960;
/// Frames of a gallery.
const GALLERY_FRAMES: usize = 2;

/// Frames in rows, lightings in columns, with a remark where other frames stand in for those wanted; `None` where
/// nothing was rendered to files.
pub fn frames(set: &ResultSet, setting: &Setting, wanted: &[u32]) -> Result<Option<(Chart, String)>> {
    let runs: Vec<&Run> = set.of(setting).filter(|run| !run.pictures.is_empty()).collect();
    let shown = nearest(wanted, &runs);
    if shown.is_empty() {
        return Ok(None);
    }
    let lightings = lightings(runs.iter().copied());
    let mut panels = vec![];
    for &frame in &shown {
        for lighting in &lightings {
            panels.push(rendered(&runs, lighting, frame)?);
        }
    }
    let remark = if shown.iter().all(|frame| wanted.contains(frame)) {
        String::new()
    } else {
        let wanted: Vec<String> = wanted.iter().map(u32::to_string).collect();
        format!(" The paper shows frame {}; of those rendered, the nearest is drawn.", wanted.join(" and "))
    };
    let chart = Chart {
        names: ["frame", "lighting", "picture", "number"],
        columns: lightings.iter().map(|lighting| lighting.label.clone()).collect(),
        rows: shown.iter().map(|frame| format!("Frame {frame}")).collect(),
        panels,
        ..Chart::default()
    };
    Ok(Some((chart, remark)))
}

/// Of every setting and lighting that has pictures: the frame, then lights per cluster by each tuned method.
///
/// # Errors
/// A picture cannot be read.
pub fn galleries(set: &ResultSet) -> Result<Vec<Figure>> {
    let mut found = vec![];
    for setting in set.settings_once() {
        for lighting in lightings(set.of(setting)) {
            let runs: Vec<&Run> =
                set.of(setting).filter(|run| run.lighting == lighting && !run.pictures.is_empty()).collect();
            let frames = nearest(&[300, 580][..GALLERY_FRAMES], &runs);
            if frames.is_empty() {
                continue;
            }
            found.push(Figure {
                id: format!("lights-{}", found.len() + 1),
                title: format!("Lights of each pixel's cluster, {}", lighting.label),
                caption: "The rendered frame, then how many lights the cluster of each pixel lists, by method: black for \
                          none, white for the most in that picture, dark grey where nothing was hit."
                    .into(),
                setting: setting.to_string(),
                chart: Some(gallery(&runs, &lighting, &frames)?),
            });
        }
    }
    Ok(found)
}

fn gallery(runs: &[&Run], lighting: &LightingName, frames: &[u32]) -> Result<Chart> {
    let mut chart = Chart {
        names: ["shown", "frame", "picture", "number"],
        columns: frames.iter().map(|frame| format!("Frame {frame}")).collect(),
        rows: vec!["Rendered".into()],
        ..Chart::default()
    };
    for &frame in frames {
        chart.panels.push(rendered(runs, lighting, frame)?);
    }
    let mut tuned: Vec<&&Run> = runs.iter().filter(|run| is_tuned(run.method)).collect();
    tuned.sort_by_key(|run| order(run.method));
    for run in tuned {
        chart.rows.push(method_name(run.method, run.setting.is_stereo()));
        for &frame in frames {
            let picture = run.pictures.iter().find(|picture| picture.frame == frame);
            let lights = picture.and_then(|picture| picture.lights.as_deref());
            let alt = format!("Lights per cluster in frame {frame} by {}", run.method);
            chart.panels.push(lights.map(|path| shown(path, frame, alt, Kind::Drawing)).transpose()?);
        }
    }
    Ok(chart)
}

/// Persp, Ortho, Displ; Indi before Encl.
pub fn order(method: Method) -> (usize, bool) {
    let Method::Grid(grid) = method else { return (usize::MAX, false) };
    let place = crate::report::results::TUNED.iter().position(|&tuned| tuned == grid.space);
    (place.unwrap_or(usize::MAX), grid.sharing == Sharing::Encl)
}

/// The frame under a lighting, by whichever method rendered it: all methods give the same image.
fn rendered(runs: &[&Run], lighting: &LightingName, frame: u32) -> Result<Option<Plot>> {
    let found = runs
        .iter()
        .filter(|run| run.lighting == *lighting)
        .find_map(|run| Some((run, run.pictures.iter().find(|picture| picture.frame == frame)?)));
    let Some((run, Picture { image, .. })) = found else { return Ok(None) };
    let alt = format!("Frame {frame} of {} under {}", run.setting.scene, lighting.label);
    shown(image, frame, alt, Kind::Photo).map(Some)
}

/// Of the frames that have pictures, those nearest to the wanted ones, each once.
pub fn nearest(wanted: &[u32], runs: &[&Run]) -> Vec<u32> {
    let frames = || runs.iter().flat_map(|run| &run.pictures).map(|picture| picture.frame);
    let mut found: Vec<u32> = wanted
        .iter()
        .filter_map(|&wanted| frames().min_by_key(|&frame| (frame.abs_diff(wanted), frame)))
        .collect();
    found.dedup();
    found
}

/// What becomes of a picture's colours on the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// They may lose a little.
    Photo,
    /// They stay as they are.
    Drawing,
}

/// An image file, made as small as a page needs.
pub fn shown(path: &Path, frame: u32, alt: String, kind: Kind) -> Result<Plot> {
    let cannot = |error: image::ImageError| Error::file(path, format!("cannot be read: {error}"));
    let image = image::open(path).map_err(cannot)?.into_rgb8();
    let filter = if kind == Kind::Photo { FilterType::Triangle } else { FilterType::Nearest };
    encoded(&fit(image, filter), kind, &path.display().to_string(), (frame, alt))
}

/// An image as a page holds it; `file` is where it came from, for the CSV.
///
/// # Errors
/// It cannot be encoded.
pub fn encoded(image: &RgbImage, kind: Kind, file: &str, (frame, alt): (u32, String)) -> Result<Plot> {
    let (width, height) = image.dimensions();
    let mut bytes = Cursor::new(vec![]);
    let (written, media) = match kind {
        Kind::Photo => {
            let encoder = JpegEncoder::new_with_quality(&mut bytes, 88);
            (image.write_with_encoder(encoder), "image/jpeg")
        }
        Kind::Drawing => (image.write_to(&mut bytes, ImageFormat::Png), "image/png"),
    };
    written.map_err(|error| Error::Internal(format!("{file}: cannot be encoded for the page: {error}")))?;
    let uri = data_uri(media, bytes.get_ref());
    Ok(Plot::Picture(Shown { uri, size: [width, height], alt, file: file.to_owned(), frame }))
}

fn fit(image: RgbImage, filter: FilterType) -> RgbImage {
    let (width, height) = image.dimensions();
    if width <= WIDEST {
        return image;
    }
    let height = (u64::from(height) * u64::from(WIDEST) / u64::from(width)).max(1) as u32;
    image::imageops::resize(&image, WIDEST, height, filter)
}
