//! Attenuation curves (A.1).

use crate::cpu::attenuation;
use crate::lights::{Attenuation, Light};
use crate::report::chart::{Chart, Key, Look, Plot, Series, palette::NAMED};
use crate::report::figure::Figure;

/// Curves are drawn to this distance, metres.
const FARTHEST: f64 = 2.4;
/// Points a curve.
const POINTS: usize = 241;

/// The functions at the parameters of Gelderen's figure A.1.
pub fn figure() -> Figure {
    let light = Light::new([0.0; 3], [1.0; 3], 1.0, 0.25, 0.75);
    let look = |index: usize, function| Look {
        dashed: matches!(function, Attenuation::Lin | Attenuation::Stp),
        bold: function == Attenuation::default(),
        ..Look::plain(NAMED[index])
    };
    // The others are not the thesis's.
    let drawn = Attenuation::ALL.into_iter().filter(|function| *function != Attenuation::Tegelaers);
    let series: Vec<Series> = drawn
        .enumerate()
        .map(|(index, function)| Series {
            name: function.name().into(),
            look: look(index, function),
            points: (0..POINTS)
                .map(|k| FARTHEST * k as f64 / (POINTS - 1) as f64)
                .map(|distance| [distance, attenuation(function, &light, distance)])
                .collect(),
        })
        .collect();
    let chart = Chart {
        names: ["", "", "function", "distance"],
        columns: vec![String::new()],
        rows: vec![String::new()],
        x_label: "distance from the light (m)".into(),
        legend: series.iter().map(|s| Key { label: s.name.clone(), look: s.look }).collect(),
        panels: vec![Some(Plot::Lines(series))],
        ..Chart::default()
    };
    Figure {
        id: "A.1".into(),
        title: "Attenuation functions".into(),
        caption: "Computed, not measured: the attenuation of a light of intensity I = 1 with near radius R₀ = 0.75 and \
                  cut-off I₀ = 0.25, whose influence ends at R₁ = 2. The heavier line is the renderer's default; the \
                  broken ones serve debugging."
            .into(),
        setting: String::new(),
        chart: Some(chart),
    }
}
