//! The figures of a benchmark of light assignment: time over lights and over clusters, with the exponents of growth.

use super::chart::palette::NAMED;
use super::chart::{Chart, Key, Look, Plot, Series};
use super::results::method_name;
use crate::Result;
use crate::methods::Method;
use crate::output::write_whole;
use crate::stats::slope;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// One measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// How many lights.
    pub lights: u32,
    /// The method.
    pub method: Method,
    /// How lists were built: the way of assignment and the test.
    pub way: String,
    /// Frame of the recording.
    pub frame: u32,
    /// Of all clusterings.
    pub visible_clusters: u64,
    /// Milliseconds.
    pub gpu_ms: f64,
}

/// What the time is drawn over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Over {
    Lights,
    Clusters,
}

/// The exponent of one line.
struct Fit {
    panel: [String; 2],
    way: String,
    exponent: f64,
    points: usize,
}

/// Writes beside the table `csv` its figures `<stem>.svg`, over lights, and `<stem>_clusters.svg`, over visible
/// clusters, each where some line has two points; and `<stem>_exponents.csv`. Gives what was written.
///
/// # Errors
/// A file cannot be written.
pub fn write_figures(csv: &Path, samples: &[Sample]) -> Result<Vec<PathBuf>> {
    let stem = csv.file_stem().map_or_else(Default::default, |stem| stem.to_string_lossy().into_owned());
    let at = |suffix: &str| csv.with_file_name(format!("{stem}{suffix}"));
    let mut written = vec![];
    let mut exponents = vec![];
    for (over, suffix, title) in [
        (Over::Lights, ".svg", "Time of light assignment over lights"),
        (Over::Clusters, "_clusters.svg", "Time of light assignment over visible clusters"),
    ] {
        let Some((chart, fits)) = draw(samples, over) else { continue };
        write_whole(&at(suffix), |file| file.write_all(chart.svg_file("bench", title).as_bytes()))?;
        written.push(at(suffix));
        exponents.extend(fits.into_iter().map(|fit| (over, fit)));
    }
    if !exponents.is_empty() {
        write_whole(&at("_exponents.csv"), |file| write_exponents(file, &exponents))?;
        written.push(at("_exponents.csv"));
    }
    Ok(written)
}

fn write_exponents(out: &mut dyn Write, exponents: &[(Over, Fit)]) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record(["over", "row", "column", "way", "exponent", "points"])?;
    for (over, Fit { panel: [row, column], way, exponent, points }) in exponents {
        let (exponent, points) = (format!("{exponent:.4}"), points.to_string());
        csv.write_record([over.name(), row.as_str(), column, way, &exponent, &points])?;
    }
    csv.flush()
}

impl Over {
    fn name(self) -> &'static str {
        match self {
            Self::Lights => "lights",
            Self::Clusters => "visible clusters",
        }
    }

    /// Row and column of a sample's panel.
    fn panel(self, sample: &Sample) -> [String; 2] {
        let frame = format!("Frame {}", sample.frame);
        match self {
            Self::Lights => [method_name(sample.method, true), frame],
            Self::Clusters => {
                [sample.method.kind().title.to_owned(), format!("{frame}, {} lights", sample.lights)]
            }
        }
    }

    fn x(self, sample: &Sample) -> f64 {
        match self {
            Self::Lights => f64::from(sample.lights),
            Self::Clusters => sample.visible_clusters as f64,
        }
    }
}

/// Each once, in the order in which they come.
fn distinct<T: PartialEq>(all: impl Iterator<Item = T>) -> Vec<T> {
    all.fold(vec![], |mut found, item| {
        if !found.contains(&item) {
            found.push(item);
        }
        found
    })
}

/// The chart with the exponents of its lines; `None` where no line has two points.
fn draw(samples: &[Sample], over: Over) -> Option<(Chart, Vec<Fit>)> {
    let usable = |sample: &&Sample| over.x(sample) > 0.0 && sample.gpu_ms > 0.0;
    let samples: Vec<&Sample> = samples.iter().filter(usable).collect();
    let ways = distinct(samples.iter().map(|sample| sample.way.as_str()));
    let look = |way: &str| {
        let index = ways.iter().position(|known| *known == way).unwrap_or_default();
        Look { dashed: index >= NAMED.len(), ..Look::plain(NAMED[index % NAMED.len()]) }
    };
    let [rows, columns] =
        [0, 1].map(|part| distinct(samples.iter().map(|sample| over.panel(sample)[part].clone())));
    let mut chart = Chart {
        names: ["row", "column", "way", over.name()],
        x_label: format!("{} (time in ms)", over.name()),
        legend: ways.iter().map(|way| Key { label: (*way).into(), look: look(way) }).collect(),
        logarithmic: true,
        ..Chart::default()
    };
    let mut fits = vec![];
    for (row, column) in rows.iter().flat_map(|row| columns.iter().map(move |column| (row, column))) {
        let panel = [row.clone(), column.clone()];
        let own: Vec<&Sample> =
            samples.iter().copied().filter(|sample| over.panel(sample) == panel).collect();
        let lines: Vec<Series> = ways
            .iter()
            .map(|way| Series { name: (*way).into(), look: look(way), points: points(&own, way, over) })
            .filter(|line| line.points.len() > 1)
            .collect();
        let fitted: Vec<Fit> = lines.iter().filter_map(|line| fit(line, &panel)).collect();
        let note = |fit: &Fit| Key { label: format!("exponent {:.2}", fit.exponent), look: look(&fit.way) };
        chart.notes.push(fitted.iter().map(note).collect());
        fits.extend(fitted);
        chart.panels.push((!lines.is_empty()).then_some(Plot::Lines(lines)));
    }
    (chart.rows, chart.columns) = (rows, columns);
    (!fits.is_empty()).then_some((chart, fits))
}

fn points(samples: &[&Sample], way: &str, over: Over) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = samples
        .iter()
        .filter(|sample| sample.way == way)
        .map(|sample| [over.x(sample), sample.gpu_ms])
        .collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points
}

/// Least squares of the logarithm of time over that of x; `None` where x does not vary.
fn fit(line: &Series, panel: &[String; 2]) -> Option<Fit> {
    let logarithms: Vec<(f64, f64)> = line.points.iter().map(|[x, y]| (x.ln(), y.ln())).collect();
    let exponent = slope(&logarithms)?;
    Some(Fit { panel: panel.clone(), way: line.name.clone(), exponent, points: logarithms.len() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::testing::assert_well_formed;

    /// A time that grows with the lights to the power of `exponent` and with the square of the clusters.
    fn sample(way: &str, exponent: f64, lights: u32, (method, visible_clusters): (&str, u64)) -> Sample {
        Sample {
            lights,
            method: method.parse().unwrap(),
            way: way.into(),
            frame: 300,
            visible_clusters,
            gpu_ms: 1e-6 * f64::from(lights).powf(exponent) * (visible_clusters as f64).powi(2),
        }
    }

    fn samples() -> Vec<Sample> {
        let methods = [("indi-persp-16", 900), ("indi-persp-64", 100), ("indi-ortho-4", 50)];
        let of_way = |way, exponent| {
            methods.into_iter().flat_map(move |method| {
                [1000, 10_000, 100_000].map(|lights| sample(way, exponent, lights, method))
            })
        };
        of_way("brute, hs", 1.0).chain(of_way("hierarchy, hs", 0.5)).collect()
    }

    #[test]
    fn exponents_are_those_of_the_times() {
        let (chart, fits) = draw(&samples(), Over::Lights).unwrap();
        assert_eq!((chart.rows.len(), chart.columns.as_slice()), (3, &["Frame 300".to_owned()][..]));
        for Fit { way, exponent, points, .. } in &fits {
            let expected = if way == "brute, hs" { 1.0 } else { 0.5 };
            assert!((exponent - expected).abs() < 1e-9 && *points == 3, "{way}: {exponent}");
        }
        assert_eq!(fits.len(), 6);
        let (chart, fits) = draw(&samples(), Over::Clusters).unwrap();
        // One Ortho grid alone has nothing to be fitted to.
        assert!(fits.iter().all(|fit| fit.panel[0] == "Indi Persp" && (fit.exponent - 2.0).abs() < 1e-9));
        assert_eq!((fits.len(), chart.columns.len()), (6, 3));
    }

    #[test]
    fn figures_lie_beside_the_table_where_there_is_something_to_draw() {
        let directory = tempfile::tempdir().unwrap();
        let csv = directory.path().join("a.csv");
        let written = write_figures(&csv, &samples()).unwrap();
        assert_eq!(
            written,
            ["a.svg", "a_clusters.svg", "a_exponents.csv"].map(|name| directory.path().join(name))
        );
        let svg = std::fs::read_to_string(&written[0]).unwrap();
        assert_well_formed(&svg);
        assert!(svg.contains("exponent 0.50") && !svg.contains("NaN") && !svg.contains("inf"));
        assert_eq!(svg.matches("mark-line").count(), 6);
        let table = std::fs::read_to_string(&written[2]).unwrap();
        assert!(table.contains("lights,Indi Persp 64,Frame 300,\"brute, hs\",1.0000,3"), "{table}");
        assert!(write_figures(&csv, &samples()[..1]).unwrap().is_empty());
    }
}
