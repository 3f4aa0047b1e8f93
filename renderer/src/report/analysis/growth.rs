//! How times grow with the number of lights: least-squares lines (Enhuber, figure 4.13).

use super::{Part, cells, methods};
use crate::methods::Method;
use crate::output::with_interval;
use crate::report::chart::palette::NAMED;
use crate::report::chart::{Bar, Chart, Key, Look, Plot, Series};
use crate::report::figure::{self, Drawn, Figure, Wanted};
use crate::report::results::{ResultSet, Setting, method_name};
use crate::report::tables::{Row, Table};
use crate::stats::{Line, Measured};

/// Through fewer numbers of lights a line says nothing.
const FEWEST: usize = 3;
/// Microseconds in a millisecond.
const MICRO: f64 = 1000.0;

const LINES: Wanted<'static> = Wanted {
    id: "analysis-lines",
    title: "Time over lights",
    caption: "Mean GPU time (ms) at each number of lights (dots), and the least-squares lines through them. Every lighting of a \
              known number is a point, whatever else its lights differ by.",
    missing: "needs temporal runs of a method at three numbers of lights or more",
};

const BARS: Wanted<'static> = Wanted {
    id: "analysis-slopes",
    title: "Slope and offset over lights",
    caption: "Of the lines above, each panel with its own axis. The black line is the 95 % interval of measuring, cut off where \
              it reaches far.",
    ..LINES
};

/// A line of a method in a setting.
pub struct Fit {
    /// The method.
    pub method: Method,
    /// What of the frame it is of.
    pub part: Part,
    /// Milliseconds over lights.
    line: Line,
    /// (lights, milliseconds), fewest lights first.
    points: Vec<[f64; 2]>,
}

impl Fit {
    /// Microseconds a light.
    pub fn slope(&self) -> Measured {
        Measured::combine([&self.line.slope], |[slope]| MICRO * slope)
    }

    /// Milliseconds of no lights.
    pub fn offset(&self) -> Measured {
        self.line.offset.clone()
    }
}

/// The lines of a setting's methods, three a method.
pub fn fits(set: &ResultSet, setting: &Setting) -> Vec<Fit> {
    let of_method = |method| Part::EVERY.into_iter().filter_map(move |part| fit(set, setting, method, part));
    methods(set, setting).into_iter().flat_map(of_method).collect()
}

fn fit(set: &ResultSet, setting: &Setting, method: Method, part: Part) -> Option<Fit> {
    let runs = set.of_method(setting, method).into_iter();
    let mut measured: Vec<(f64, Measured)> =
        runs.filter_map(|run| Some((f64::from(run.lighting.count?), part.mean(run)?))).collect();
    measured.sort_by(|a, b| a.0.total_cmp(&b.0));
    let counts = measured.chunk_by(|a, b| a.0 == b.0).count();
    let line = Line::through(&measured).filter(|_| counts >= FEWEST)?;
    Some(Fit { method, part, line, points: measured.iter().map(|(x, y)| [*x, y.value]).collect() })
}

/// Of each setting, the lines, and then slopes and offsets.
pub fn figures(set: &ResultSet) -> Vec<Figure> {
    let draw = |chart: fn(&Setting, &[Fit]) -> Chart| {
        let drawn = set.settings().into_iter().filter_map(|setting| {
            let fits = fits(set, setting);
            (!fits.is_empty()).then(|| Drawn { setting, chart: chart(setting, &fits), remark: String::new() })
        });
        drawn.collect::<Vec<_>>()
    };
    let mut found = figure::figures(&LINES, draw(lines));
    found.extend(figure::figures(&BARS, draw(bars)));
    found
}

/// Dots and lines: a panel a part of the frame.
pub fn lines(setting: &Setting, fits: &[Fit]) -> Chart {
    let named: Vec<(Method, Key)> = fits
        .iter()
        .filter(|fit| fit.part == Part::All)
        .enumerate()
        .map(|(index, fit)| (fit.method, key(setting, fit.method, index)))
        .collect();
    let panel = |part| {
        let of_part = || fits.iter().filter(move |fit| fit.part == part);
        let look = |fit: &Fit| named.iter().find(|(method, _)| *method == fit.method).map(|(_, key)| key);
        // The dots come first: tips point at their numbers of lights.
        let dots = of_part().filter_map(|fit| Some(dots(fit, look(fit)?)));
        let fitted = of_part().filter_map(|fit| Some(fitted(fit, look(fit)?)));
        Plot::Lines(dots.chain(fitted).collect())
    };
    Chart {
        names: ["unit", "part", "method", "lights"],
        columns: Part::EVERY.map(|part| part.name().to_owned()).to_vec(),
        rows: vec!["ms".into()],
        panels: Part::EVERY.map(|part| Some(panel(part))).to_vec(),
        x_label: "lights".into(),
        legend: named.iter().map(|(_, key)| key.clone()).collect(),
        ..Chart::default()
    }
}

fn key(setting: &Setting, method: Method, index: usize) -> Key {
    let look = Look { dashed: index >= NAMED.len(), ..Look::plain(NAMED[index % NAMED.len()]) };
    Key { label: method_name(method, setting.is_stereo()), look }
}

fn dots(fit: &Fit, key: &Key) -> Series {
    let look = Look { dots: true, dashed: false, ..key.look };
    Series { name: key.label.clone(), look, points: fit.points.clone() }
}

/// The line at the numbers of lights, as far as it is above 0.
fn fitted(fit: &Fit, key: &Key) -> Series {
    let ends = [fit.points.first(), fit.points.last()].map(|end| end.map_or(0.0, |point| point[0]));
    let crossing = -fit.line.offset.value / fit.line.slope.value;
    let mut points: Vec<[f64; 2]> = fit.points.iter().map(|[x, _]| [*x, fit.line.at(*x)]).collect();
    points.retain(|point| point[1] > 0.0);
    if ends[0] < crossing && crossing < ends[1] {
        points.push([crossing, 0.0]);
    }
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points.dedup();
    Series { name: format!("{}, line", key.label), look: key.look, points }
}

/// Slopes, and offsets below: a panel a part of the frame.
pub fn bars(setting: &Setting, fits: &[Fit]) -> Chart {
    let panel = |part, of: fn(&Fit) -> Measured| {
        let bar = |fit: &Fit| {
            let number = of(fit);
            Bar {
                label: method_name(fit.method, setting.is_stereo()),
                told: told(&number),
                parts: vec![(fit.part.key(), number.value)],
                interval: number.interval(),
            }
        };
        Some(Plot::Bars(fits.iter().filter(|fit| fit.part == part).map(bar).collect()))
    };
    let panels = [Fit::slope as fn(&Fit) -> Measured, Fit::offset]
        .into_iter()
        .flat_map(|of| Part::EVERY.map(|part| panel(part, of)));
    Chart {
        names: ["number", "part", "series", "method"],
        columns: Part::EVERY.map(|part| part.name().to_owned()).to_vec(),
        rows: vec!["Slope (µs a light)".into(), "Offset (ms)".into()],
        panels: panels.collect(),
        ..Chart::default()
    }
}

fn told(number: &Measured) -> String {
    let sign = if number.value < 0.0 { "−" } else { "" };
    format!("{sign}{}", with_interval(number.value.abs(), number.interval(), [0, 4]))
}

/// A row a method, part and setting.
pub fn table(set: &ResultSet) -> Table {
    let rows = set.settings().into_iter().flat_map(|setting| {
        let row = |fit: Fit| Row {
            setting: setting.to_string(),
            labels: vec![method_name(fit.method, setting.is_stereo()), fit.part.name().into()],
            numbers: [cells(&fit.slope()), cells(&fit.offset())]
                .concat()
                .into_iter()
                .chain([Some(fit.line.off)])
                .collect(),
        };
        fits(set, setting).into_iter().map(row)
    });
    Table {
        id: "analysis-lines",
        title: "Least-squares lines over lights",
        caption: "Of the mean times at each number of lights, all of which weigh alike. The ends are those of the 95 % interval of \
                  measuring: slope and offset of the line through the same numbers of lights, made again with halves of the \
                  temporal runs, of which all points lose the same. Whether times follow a line is told by how far \
                  they lie off it (root mean square).",
        labels: &["method", "part"],
        groups: vec![
            ("slope µs a light", &["", "low", "high"]),
            ("offset ms", &["", "low", "high"]),
            ("off the line ms", &[""]),
        ],
        rows: rows.collect(),
    }
}
