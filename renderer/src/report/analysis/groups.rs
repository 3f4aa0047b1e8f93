//! How many lights groups of fragments hold, beside a picture of where (Enhuber, section 4.4.1.2, figures 4.10 and 4.11).
//!
//! ```text
//! histograms.csv ─> FrameGroups ──binned──> columns ─┐
//! frames/NNNNNN_heat.png ────────────────────────────┴─> a row of panels a frame ─> figure a method
//! ```
//!
//! A group is what shares a list: a cluster, a tile, a cell, a model. Bins are [`WIDTH`] wide. Where all groups have lists, most
//! of which may be empty, groups without lights have a bin of their own.

use super::methods;
use crate::Result;
use crate::methods::Method;
use crate::report::chart::{Chart, Column, Plot};
use crate::report::figure::{self, Drawn, Figure, Wanted};
use crate::report::pictures::{Kind, shown};
use crate::report::results::{FrameGroups, ResultSet, Run, Setting, lightings, method_name};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// Numbers of lights in a bin.
pub const WIDTH: u32 = 25;

const WANTED: Wanted<'static> = Wanted {
    id: "analysis-groups",
    title: "Lights per group",
    caption: "Left: the lights of each pixel's group, blended with the frame: blue for none to red for 150, green for more. Right: \
              how many groups hold so many lights, in bins of 25; groups without lights stand apart (grey) where all \
              groups have lists. Of the frames with pictures, those of least and of most depth discontinuity, under the most lights.",
    missing: "needs frames with pictures (replay --exr)",
};

/// Groups that hold from so many to so many lights, both included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bin {
    /// Least lights.
    pub from: u32,
    /// Most lights.
    pub to: u32,
    /// Groups, at least 1.
    pub groups: u64,
}

/// The bins that hold something, ascending: 1 to 25, 26 to 50 and so on. No lights are a bin of their own where `apart`, else they
/// belong to the first.
pub fn binned<'a>(counts: impl IntoIterator<Item = &'a (u32, u64)>, apart: bool) -> Vec<Bin> {
    let mut bins: BTreeMap<u32, Bin> = BTreeMap::new();
    for &(lights, groups) in counts {
        let place = lights.div_ceil(WIDTH).max(u32::from(!apart));
        let (from, to) = match place {
            0 => (0, 0),
            1 => (u32::from(apart), WIDTH),
            place => ((place - 1) * WIDTH + 1, place.saturating_mul(WIDTH)),
        };
        bins.entry(place).or_insert(Bin { from, to, groups: 0 }).groups += groups;
    }
    bins.into_values().collect()
}

/// The bins of a frame of a run, over clusterings; empty where nothing is known of it.
pub fn bins(run: &Run, frame: u32) -> Vec<Bin> {
    let known = run.groups.iter().find(|groups| groups.frame == frame);
    binned(known.into_iter().flat_map(|groups| groups.clusterings.iter().flatten()), run.lists_all)
}

/// Of a frame of a run, the picture of lights per pixel's group, and the histogram of groups by lights.
///
/// # Errors
/// The picture cannot be read.
pub fn panels(run: &Run, frame: u32) -> Result<[Option<Plot>; 2]> {
    let picture = run.pictures.iter().find(|picture| picture.frame == frame);
    let heat = picture.and_then(|picture| picture.heat.as_deref());
    let alt = format!("Lights of each pixel's group in frame {frame} by {}", run.method);
    let heat = heat.map(|path| shown(path, frame, alt, Kind::Photo)).transpose()?;
    let columns: Vec<Column> = bins(run, frame).into_iter().map(column).collect();
    Ok([heat, (!columns.is_empty()).then_some(Plot::Columns(columns))])
}

fn column(Bin { from, to, groups }: Bin) -> Column {
    let (label, left, color) = match (from, to) {
        (0, 0) => ("0".to_owned(), -f64::from(WIDTH), "grey"),
        _ => (format!("{from}-{to}"), f64::from(from.saturating_sub(1)), "blue"),
    };
    Column { label, x: [left, f64::from(to)], count: groups, color }
}

/// Frames of a run, a row each; `None` where nothing is known of them.
///
/// # Errors
/// A picture cannot be read.
pub fn chart(run: &Run, frames: &[u32]) -> Result<Option<Chart>> {
    let mut chart = Chart {
        names: ["frame", "shown", "lights", "from"],
        columns: vec![
            format!("{}: lights of each pixel's group", method_name(run.method, run.setting.is_stereo())),
            "Groups by how many lights they hold".into(),
        ],
        x_label: "lights".into(),
        ..Chart::default()
    };
    for &frame in frames {
        let panels = panels(run, frame)?;
        if panels.iter().any(Option::is_some) {
            chart.rows.push(format!("Frame {frame}"));
            chart.panels.extend(panels);
        }
    }
    Ok((!chart.rows.is_empty()).then_some(chart))
}

/// A figure a method and setting, under the most lights.
///
/// # Errors
/// A picture cannot be read.
pub fn figures(set: &ResultSet) -> Result<Vec<Figure>> {
    let mut drawn = vec![];
    for setting in set.settings_once() {
        for run in methods(set, setting).into_iter().filter_map(|method| most_lights(set, setting, method)) {
            if let Some(chart) = chart(run, &run.extremes())? {
                drawn.push(Drawn { setting, chart, remark: remark(run) });
            }
        }
    }
    Ok(figure::figures(&WANTED, drawn))
}

fn remark(run: &Run) -> String {
    let told = format!(" Here: {}, {}", method_name(run.method, run.setting.is_stereo()), run.lighting.label);
    match run.extremes()[..] {
        [least, most] => format!("{told}, frame {least} (least) and {most} (most)."),
        _ => format!("{told}."),
    }
}

/// The run of a method that groups, with pictures, under the most lights.
fn most_lights<'a>(set: &'a ResultSet, setting: &'a Setting, method: Method) -> Option<&'a Run> {
    let pictured = || set.of(setting).filter(move |run| run.method == method && !run.groups.is_empty());
    let lighting = lightings(pictured()).pop()?;
    pictured().find(|run| run.lighting == lighting)
}

/// Every bin of every frame that has pictures, by clustering: `run,frame,clustering,from,to,groups`.
///
/// # Errors
/// The writer fails.
pub fn write_csv(out: impl Write, set: &ResultSet) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record(["run", "frame", "clustering", "from", "to", "groups"])?;
    for run in &set.runs {
        for FrameGroups { frame, clusterings } in &run.groups {
            for (clustering, counts) in clusterings.iter().enumerate() {
                for Bin { from, to, groups } in binned(counts, run.lists_all) {
                    csv.serialize((&run.name, frame, clustering, from, to, groups))?;
                }
            }
        }
    }
    csv.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::write_png;
    use crate::report::results::{Picture, metric};
    use crate::report::testing::{assert_well_formed, run, set};
    use image::RgbImage;
    use proptest::prelude::*;
    use std::path::Path;

    fn told(bins: &[Bin]) -> Vec<(u32, u32, u64)> {
        bins.iter().map(|bin| (bin.from, bin.to, bin.groups)).collect()
    }

    #[test]
    fn groups_without_lights_stand_apart_where_all_have_lists() {
        let counts = [(0, 7), (1, 2), (25, 3), (26, 4), (50, 1), (2259, 1)];
        let rest = [(26, 50, 5), (2251, 2275, 1)];
        assert_eq!(told(&binned(&counts, true)), [vec![(0, 0, 7), (1, 25, 5)], rest.to_vec()].concat());
        assert_eq!(told(&binned(&counts, false)), [vec![(0, 25, 12)], rest.to_vec()].concat());
        assert_eq!(told(&binned(&[(u32::MAX, 1)], true))[0].2, 1, "no number is too large");
        assert!(binned(&[], true).is_empty());
    }

    proptest! {
        #[test]
        fn every_group_is_in_the_bin_of_its_lights(counts in prop::collection::btree_map(0_u32..5000, 1_u64..9, 0..60), apart: bool) {
            let counts: Vec<(u32, u64)> = counts.into_iter().collect();
            let bins = binned(&counts, apart);
            prop_assert!(bins.windows(2).all(|pair| pair[0].to < pair[1].from));
            for bin in bins {
                let within = counts.iter().filter(|(lights, _)| (bin.from..=bin.to).contains(lights));
                prop_assert_eq!(within.map(|(_, groups)| groups).sum::<u64>(), bin.groups);
            }
        }
    }

    /// A run of `g-20` with pictures of two frames, of which the later jumps less in depth.
    fn pictured(directory: &Path) -> Run {
        let jumps = |name: &str, frame: u32| {
            (name == metric::DISCONTINUITY).then_some(if frame == 300 { 9.0 } else { 4.0 })
        };
        let mut run = run("g-20", 1, 1000, jumps);
        run.lists_all = true;
        for frame in [300, 580] {
            let image = directory.join(format!("{frame}_heat.png"));
            write_png(&image, &RgbImage::from_pixel(32, 18, image::Rgb([1, 2, 3]))).unwrap();
            let heat = Some(image.clone());
            run.pictures.push(Picture { frame, image, heat, ..Picture::default() });
            run.groups.push(FrameGroups {
                frame,
                clusterings: vec![vec![(0, 8000 - 40), (30, 40)], vec![(30, 2)]],
            });
        }
        run
    }

    #[test]
    fn a_method_has_its_frame_of_least_discontinuity_above_that_of_most() {
        let directory = tempfile::tempdir().unwrap();
        let run = pictured(directory.path());
        assert_eq!(run.extremes(), [580, 300]);
        let figures = figures(&set(vec![run])).unwrap();
        let figure = &figures[0];
        let chart = figure.chart.as_ref().unwrap();
        assert_eq!(chart.rows, ["Frame 580", "Frame 300"]);
        assert!(
            figure.caption.ends_with("Here: G 20, 1000 lights, frame 580 (least) and 300 (most)."),
            "{}",
            figure.caption
        );
        let [Some(Plot::Picture(picture)), Some(Plot::Columns(columns)), ..] = &chart.panels[..] else {
            panic!("both")
        };
        assert_eq!((picture.frame, picture.size), (580, [32, 18]));
        let labels: Vec<(&str, u64)> =
            columns.iter().map(|column| (column.label.as_str(), column.count)).collect();
        assert_eq!(labels, [("0", 7960), ("26-50", 42)], "over both clusterings");
        let svg = chart.svg_file(&figure.id, &figure.title);
        assert_well_formed(&svg);
        assert_eq!(svg.matches("class=\"mark-").count(), 2 * (1 + 2));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        let mut csv = vec![];
        chart.write_csv(&mut csv).unwrap();
        assert!(
            String::from_utf8(csv)
                .unwrap()
                .contains("\nFrame 300,Groups by how many lights they hold,26-50,25,42\n")
        );
    }

    #[test]
    fn the_table_has_every_clustering_and_nothing_is_drawn_of_nothing() {
        let directory = tempfile::tempdir().unwrap();
        let mut csv = vec![];
        write_csv(&mut csv, &set(vec![pictured(directory.path())])).unwrap();
        let text = String::from_utf8(csv).unwrap();
        assert!(
            text.starts_with("run,frame,clustering,from,to,groups\ng-20_1000,300,0,0,0,7960\n"),
            "{text}"
        );
        assert!(text.contains("\ng-20_1000,580,1,26,50,2\n"), "{text}");
        let without = figures(&set(vec![run("g-20", 1, 1000, |_, _| None)])).unwrap();
        assert!(without[0].chart.is_none() && without[0].caption.contains("--exr"));
    }
}
