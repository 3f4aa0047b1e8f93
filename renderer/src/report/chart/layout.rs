//! Where the parts of a chart are, in units of its view box.

use super::{Chart, Plot, bars};

/// Width of a chart of three columns; of fewer it is narrower.
const FULL_WIDTH: f64 = 1080.0;
/// Room for the label of a row.
const ROW_LABEL: f64 = 22.0;
/// Room for the labels of ticks beside a panel.
const TICK_LABEL: f64 = 46.0;
/// Room between a panel and what follows on the right.
const RIGHT: f64 = 16.0;
/// Room between rows.
const GAP: f64 = 18.0;
/// A line of legend or heading.
const LINE: f64 = 22.0;
/// Room for ticks and label below.
const BELOW: f64 = 40.0;

/// The measures of a chart.
#[derive(Debug, Clone)]
pub struct Layout {
    /// Whole width and height.
    pub size: [f64; 2],
    /// Legend entries: index of the key and its left top corner.
    pub keys: Vec<(usize, [f64; 2])>,
    /// Base line of the column headings.
    pub heading: f64,
    lefts: Vec<f64>,
    tops: Vec<f64>,
    panel: [f64; 2],
}

impl Layout {
    /// Lays a chart out.
    pub fn of(chart: &Chart) -> Self {
        let columns = chart.columns.len().max(1);
        // Nothing but pictures needs no room for axes.
        let pictures = chart.panels.iter().flatten().next().is_some()
            && chart.panels.iter().flatten().all(|plot| matches!(plot, Plot::Picture(_)));
        let width = match columns {
            1 => 800.0,
            2 => 960.0,
            _ => FULL_WIDTH,
        };
        let beside = if pictures { 0.0 } else { TICK_LABEL };
        let right = if pictures { 8.0 } else { RIGHT };
        let row_label = if chart.rows.iter().all(String::is_empty) { 0.0 } else { ROW_LABEL };
        let panel_width = (width - row_label) / columns as f64 - beside - right;
        let panel_height = panel_height(chart, panel_width);
        let (keys, legend) = place_keys(chart, width);
        let headed = chart.columns.iter().any(|heading| !heading.is_empty());
        let top = legend + if headed { LINE + 2.0 } else { 6.0 };
        let lefts =
            (0..columns).map(|k| row_label + beside + k as f64 * (panel_width + beside + right)).collect();
        let gap = if pictures { 8.0 } else { GAP };
        let tops = (0..chart.rows.len()).map(|k| top + k as f64 * (panel_height + gap)).collect();
        let rows = chart.rows.len() as f64;
        let below = if pictures { 4.0 } else { BELOW };
        let height = top + rows * (panel_height + gap) - gap + below;
        Self {
            size: [width, height],
            keys,
            heading: legend + 15.0,
            lefts,
            tops,
            panel: [panel_width, panel_height],
        }
    }

    /// Left, top, width and height of a panel.
    pub fn panel(&self, row: usize, column: usize) -> [f64; 4] {
        [self.lefts[column], self.tops[row], self.panel[0], self.panel[1]]
    }
}

/// Of a panel of columns, unless pictures beside it are higher.
const COLUMNS_HEIGHT: f64 = 160.0;

fn panel_height(chart: &Chart, width: f64) -> f64 {
    let pictures = chart.panels.iter().flatten().filter_map(|plot| match plot {
        Plot::Picture(picture) => {
            Some(width * f64::from(picture.size[1]) / f64::from(picture.size[0].max(1)))
        }
        _ => None,
    });
    // Slender pictures are shown as high as the broad ones beside them.
    let lowest = pictures.fold(f64::INFINITY, f64::min);
    let tallest = chart.panels.iter().flatten().map(|plot| match plot {
        Plot::Picture(_) => lowest,
        Plot::Columns(_) => COLUMNS_HEIGHT,
        Plot::Heat(_) => 190.0,
        Plot::Stack(_) => 140.0,
        Plot::Bars(all) => bars::height(all.len()),
        Plot::Lines(_) if chart.logarithmic || chart.rows.len() == 1 => 300.0,
        Plot::Lines(_) => 124.0,
    });
    tallest.fold(20.0, f64::max)
}

/// Flows the legend into lines; gives the entries and the height they take.
fn place_keys(chart: &Chart, width: f64) -> (Vec<(usize, [f64; 2])>, f64) {
    let (mut x, mut y) = (ROW_LABEL, 0.0);
    let mut keys = vec![];
    for (index, key) in chart.legend.iter().enumerate() {
        let needed = 34.0 + text_width(&key.label) + 20.0;
        if x + needed > width && x > ROW_LABEL {
            (x, y) = (ROW_LABEL, y + LINE);
        }
        keys.push((index, [x, y]));
        x += needed;
    }
    let has_heat = chart.panels.iter().flatten().any(|plot| matches!(plot, Plot::Heat(_)));
    let height = if has_heat {
        38.0
    } else if keys.is_empty() {
        0.0
    } else {
        y + LINE + 4.0
    };
    (keys, height)
}

/// About how wide a text of 12 units is.
pub fn text_width(text: &str) -> f64 {
    text.chars().count() as f64 * 6.6
}
