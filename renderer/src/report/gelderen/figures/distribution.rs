//! How clusters are distributed, as heat maps: a column a lighting, a row a method (6.9, 6.10).

use crate::methods::Method;
use crate::report::chart::{Chart, Heat, Plot};
use crate::report::results::{Distribution, ResultSet, Run, Setting, TUNED, indi, lightings, method_name};

/// By lights.
pub fn lights(set: &ResultSet, setting: &Setting) -> Option<Chart> {
    let mut chart = heat_maps(set, setting, Distribution::Lights)?;
    chart.names = ["method", "lighting", "lights", "frame"];
    Some(chart)
}

/// By fragments.
pub fn fragments(set: &ResultSet, setting: &Setting) -> Option<Chart> {
    let mut chart = heat_maps(set, setting, Distribution::Fragments)?;
    chart.names = ["method", "lighting", "fragments", "frame"];
    Some(chart)
}

fn heat_maps(set: &ResultSet, setting: &Setting, distribution: Distribution) -> Option<Chart> {
    let mut chart = by_method(set, setting, |run| heat(run, distribution).map(Plot::Heat))?;
    let mut heats: Vec<&mut Heat> = chart
        .panels
        .iter_mut()
        .flatten()
        .filter_map(|plot| if let Plot::Heat(heat) = plot { Some(heat) } else { None })
        .collect();
    let rows = heats.iter().map(|heat| heat.rows).max().unwrap_or(1);
    let most = heats.iter().map(|heat| heat.most).max().unwrap_or(1);
    for heat in &mut heats {
        // A row above the last, so that what is marked there is seen.
        (heat.rows, heat.most) = (rows + 1, most);
    }
    Some(chart)
}

fn heat(run: &Run, distribution: Distribution) -> Option<Heat> {
    let counts = run.distributions.get(&distribution)?.clone();
    let limit = match run.method {
        method
            if method == indi(TUNED[0])
                && distribution == Distribution::Fragments
                && run.setting.msaa == 1 =>
        {
            Some((64 * 64 - 1, "64²".to_owned()))
        }
        _ => None,
    };
    let rows = counts.iter().map(Vec::len).max()?;
    let most = counts.iter().flatten().copied().max()?;
    let x = run.frames.numbers.iter().map(|&frame| f64::from(frame)).collect();
    Some(Heat { x, counts, rows, most, mark: limit })
}

/// A chart of the tuned Indi methods in rows and lightings in columns; `None` where no run has data.
pub fn by_method(set: &ResultSet, setting: &Setting, draw: impl Fn(&Run) -> Option<Plot>) -> Option<Chart> {
    let methods: Vec<Method> =
        TUNED.map(indi).into_iter().filter(|&m| !set.of_method(setting, m).is_empty()).collect();
    let lightings = lightings(set.of(setting).filter(|run| methods.contains(&run.method)));
    let mut chart = Chart {
        columns: lightings.iter().map(|lighting| lighting.label.clone()).collect(),
        x_label: "frame".into(),
        ..Chart::default()
    };
    for method in methods {
        let runs = set.of_method(setting, method);
        let row: Vec<Option<Plot>> = lightings
            .iter()
            .map(|lighting| runs.iter().find(|run| run.lighting == *lighting).and_then(|run| draw(run)))
            .collect();
        if row.iter().any(Option::is_some) {
            chart.rows.push(method_name(method, false));
            chart.panels.extend(row);
        }
    }
    (!chart.rows.is_empty()).then_some(chart)
}
