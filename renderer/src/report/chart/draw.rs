//! A chart as SVG.

use super::layout::Layout;
use super::marks;
use super::palette::{self, VIRIDIS, hex, logarithmic};
use super::scale::{Scale, decades, nice_top, ticks};
use super::svg::{Anchor, Svg, place};
use super::{Chart, Heat, Picture, Plot};
use super::{bars, columns};
use crate::report::bins;
use crate::report::format::{grouped, short};

/// Room that a tick label of the x axis needs.
const TICK_ROOM: f64 = 48.0;
/// About how many ticks a y axis has.
const Y_TICKS: usize = 4;

/// Axes of one panel with numbers.
pub struct Axes {
    /// Frames or metres.
    pub x: Scale,
    /// Amounts.
    pub y: Scale,
}

impl Chart {
    /// The chart as an SVG element for the page, which brings the colours. `id` tells it from others there.
    pub fn svg(&self, id: &str, title: &str) -> String {
        self.draw(id, title, None)
    }

    /// The chart as an SVG file of its own, in the light colours.
    pub fn svg_file(&self, id: &str, title: &str) -> String {
        let css = palette::plain_rules();
        format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}", self.draw(id, title, Some(&css)))
    }

    fn draw(&self, id: &str, title: &str, css: Option<&str>) -> String {
        let layout = Layout::of(self);
        let [width, height] = layout.size.map(place);
        let mut svg = Svg::default();
        let view_box = format!("0 0 {width} {height}");
        svg.open(
            "svg",
            &[
                ("xmlns", &"http://www.w3.org/2000/svg"),
                ("class", &"chart"),
                ("viewBox", &view_box),
                ("width", &width),
                ("height", &height),
                ("role", &"img"),
            ],
        );
        svg.holding("title", &[], title);
        if let Some(css) = css {
            svg.style(css);
            svg.rect("f-page", [0.0, 0.0, layout.size[0], layout.size[1]]);
        }
        self.draw_legend(&mut svg, &layout, id);
        self.draw_headings(&mut svg, &layout);
        for (row, column, plot) in self.drawn() {
            self.draw_panel(&mut svg, &layout, (row, column), plot);
        }
        svg.close("svg");
        svg.finish()
    }

    fn draw_legend(&self, svg: &mut Svg, layout: &Layout, id: &str) {
        for &(index, [x, y]) in &layout.keys {
            let key = &self.legend[index];
            let middle = y + 10.0;
            let areas = self
                .drawn()
                .any(|(_, _, plot)| matches!(plot, Plot::Stack(_) | Plot::Bars(_) | Plot::Columns(_)));
            if areas {
                svg.rect(&format!("f-{}", key.look.color), [x + 10.0, middle - 6.0, 12.0, 12.0]);
            } else {
                svg.path(&marks::line_class(key.look), &format!("M{} {}h24", place(x), place(middle)));
            }
            svg.label([x + 30.0, middle + 4.0], Anchor::Start, "label", &key.label);
        }
        if let Some(heat) = self.drawn().find_map(|(_, _, plot)| heat_of(plot)) {
            color_bar(svg, heat.most, id);
        }
    }

    fn draw_headings(&self, svg: &mut Svg, layout: &Layout) {
        for (column, heading) in self.columns.iter().enumerate() {
            let [left, _, width, _] = layout.panel(0, column);
            svg.label([left + width / 2.0, layout.heading], Anchor::Middle, "head", heading);
        }
        for (row, label) in self.rows.iter().enumerate().filter(|(_, label)| !label.is_empty()) {
            let [_, top, _, height] = layout.panel(row, 0);
            let (x, y) = (place(13.0), place(top + height / 2.0));
            let turn = format!("rotate(-90 {x} {y})");
            let attributes: [(&str, &dyn std::fmt::Display); 5] =
                [("x", &x), ("y", &y), ("text-anchor", &"middle"), ("class", &"label"), ("transform", &turn)];
            svg.holding("text", &attributes, label);
        }
    }

    fn draw_panel(&self, svg: &mut Svg, layout: &Layout, (row, column): (usize, usize), plot: &Plot) {
        let frame = layout.panel(row, column);
        let place_in_chart = format!("{row},{column}");
        svg.open("g", &[("class", &"panel"), ("data-panel", &place_in_chart)]);
        if let Plot::Picture(picture) = plot {
            draw_picture(svg, picture, frame);
            svg.close("g");
            return;
        }
        svg.rect("back", frame);
        if let Plot::Bars(all) = plot {
            bars::draw(svg, all, frame);
            svg.close("g");
            return;
        }
        let axes = self.axes(plot, frame);
        let is_last = (row + 1..self.rows.len()).all(|below| self.panel(below, column).is_none());
        self.x_axis(svg, axes.x, frame, is_last);
        match plot {
            Plot::Lines(series) => {
                y_axis(svg, axes.y, frame);
                marks::lines(svg, series, axes.x, axes.y);
                self.draw_notes(svg, row * self.columns.len() + column, frame);
            }
            Plot::Stack(stack) => {
                marks::stack(svg, &stack.parts, axes.x, axes.y);
                y_axis(svg, axes.y, frame);
            }
            Plot::Heat(heat) => draw_heat(svg, heat, axes.x, frame),
            Plot::Columns(all) => {
                y_axis(svg, axes.y, frame);
                columns::draw(svg, all, &axes);
            }
            Plot::Bars(_) | Plot::Picture(_) => {}
        }
        svg.close("g");
    }

    /// Frame numbers are not shortened: 1500, not 1.5k.
    fn x_tick(&self, value: f64) -> String {
        if value.fract() == 0.0 && !self.logarithmic { format!("{value:.0}") } else { short(value) }
    }

    fn draw_notes(&self, svg: &mut Svg, panel: usize, [left, top, ..]: [f64; 4]) {
        for (line, note) in self.notes.get(panel).into_iter().flatten().enumerate() {
            let at = [left + 8.0, top + 15.0 + 13.0 * line as f64];
            svg.label(at, Anchor::Start, &format!("f-{}", note.look.color), &note.label);
        }
    }

    /// The axes of a panel that is no picture, in `frame` (left, top, width, height).
    pub(super) fn axes(&self, plot: &Plot, [left, top, width, height]: [f64; 4]) -> Axes {
        if let (true, Plot::Lines(series)) = (self.logarithmic, plot) {
            let y = ends(series.iter().flat_map(|s| s.points.iter().map(|p| p[1])), 0.0);
            return Axes {
                x: Scale { logarithmic: true, domain: self.x_domain(), range: [left, left + width] },
                // Remarks stand above the lines.
                y: Scale { logarithmic: true, domain: [y[0] / 2.0, y[1] * 8.0], range: [top + height, top] },
            };
        }
        if let Plot::Columns(_) = plot {
            let all = self.drawn().filter_map(|(_, _, plot)| match plot {
                Plot::Columns(columns) => Some(columns),
                _ => None,
            });
            let x = Scale { logarithmic: false, domain: self.x_domain(), range: [left, left + width] };
            return Axes { x, y: columns::counts(all.flatten(), [top, top + height]) };
        }
        let most = match plot {
            Plot::Lines(series) => {
                nice_top(series.iter().flat_map(|s| &s.points).map(|p| p[1]).fold(0.0, f64::max), Y_TICKS)
            }
            Plot::Stack(stack) => nice_top(stack.top, Y_TICKS),
            Plot::Heat(heat) => heat.rows as f64,
            Plot::Bars(_) | Plot::Columns(_) | Plot::Picture(_) => 1.0,
        };
        Axes {
            x: Scale { logarithmic: false, domain: self.x_domain(), range: [left, left + width] },
            y: Scale { logarithmic: false, domain: [0.0, most], range: [top + height, top] },
        }
    }

    /// From the least x of the chart to the greatest; columns of heat maps are as wide as they are apart.
    fn x_domain(&self) -> [f64; 2] {
        let ends = self.drawn().map(|(_, _, plot)| match plot {
            Plot::Lines(series) => ends(series.iter().flat_map(|s| s.points.iter().map(|p| p[0])), 0.0),
            Plot::Stack(stack) => ends(stack.parts.iter().flat_map(|s| s.points.iter().map(|p| p[0])), 0.0),
            Plot::Heat(heat) => ends(heat.x.iter().copied(), half_step(&heat.x)),
            Plot::Columns(all) => ends(all.iter().flat_map(|column| column.x), 0.0),
            Plot::Bars(_) | Plot::Picture(_) => [f64::INFINITY, f64::NEG_INFINITY],
        });
        let [low, high] = ends
            .fold([f64::INFINITY, f64::NEG_INFINITY], |all, one| [all[0].min(one[0]), all[1].max(one[1])]);
        if low < high {
            [low, high]
        } else if low == high {
            if self.logarithmic { [low / 2.0, high * 2.0] } else { [low - 1.0, high + 1.0] }
        } else {
            [0.0, 1.0]
        }
    }

    fn x_axis(&self, svg: &mut Svg, x: Scale, [left, top, width, height]: [f64; 4], is_last: bool) {
        let bottom = top + height;
        for tick in axis_ticks(x, (width / TICK_ROOM) as usize) {
            let at = x.at(tick);
            svg.path("grid", &format!("M{} {}V{}", place(at), place(top), place(bottom)));
            if is_last {
                svg.label([at, bottom + 15.0], Anchor::Middle, "tick", &self.x_tick(tick));
            }
        }
        svg.path("axis", &format!("M{} {}H{}", place(left), place(bottom), place(left + width)));
        if is_last {
            svg.label([left + width / 2.0, bottom + 32.0], Anchor::Middle, "note", &self.x_label);
        }
    }
}

fn heat_of(plot: &Plot) -> Option<&Heat> {
    if let Plot::Heat(heat) = plot { Some(heat) } else { None }
}

fn ends(values: impl Iterator<Item = f64>, room: f64) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value - room), high.max(value + room)]
    })
}

/// Half the distance of neighbouring columns.
pub fn half_step(x: &[f64]) -> f64 {
    match x {
        [first, .., last] => (last - first) / (x.len() - 1) as f64 / 2.0,
        _ => 0.5,
    }
}

fn axis_ticks(Scale { logarithmic, domain: [low, high], .. }: Scale, wanted: usize) -> Vec<f64> {
    if logarithmic { decades(low, high) } else { ticks(low, high, wanted) }
}

fn y_axis(svg: &mut Svg, y: Scale, [left, _, width, _]: [f64; 4]) {
    for tick in axis_ticks(y, Y_TICKS) {
        let at = y.at(tick);
        if tick > 0.0 {
            svg.path("grid", &format!("M{} {}h{}", place(left), place(at), place(width)));
        }
        svg.label([left - 6.0, at + 4.0], Anchor::End, "tick", &short(tick));
    }
}

fn draw_heat(svg: &mut Svg, heat: &Heat, x: Scale, [left, top, width, height]: [f64; 4]) {
    let row_height = height / heat.rows.max(1) as f64;
    let half = half_step(&heat.x);
    if let (Some(first), Some(last)) = (heat.x.first(), heat.x.last()) {
        let (from, to) = (x.at(first - half), x.at(last + half));
        let (uri, [from, top, width, height]) =
            (marks::heat_image(heat), [from, top, to - from, height].map(place));
        svg.empty(
            "image",
            &[
                ("class", &"mark-heat heat"),
                ("x", &from),
                ("y", &top),
                ("width", &width),
                ("height", &height),
                ("preserveAspectRatio", &"none"),
                ("href", &uri),
            ],
        );
    }
    let mut free_above = f64::INFINITY;
    for value in std::iter::once(0).chain((0..63).map(|power| 1_u64 << power)) {
        let row = bins::row(value);
        if row >= heat.rows {
            break;
        }
        let at = top + height - (row as f64 + 0.5) * row_height;
        if at + 13.0 <= free_above {
            svg.label([left - 6.0, at + 4.0], Anchor::End, "tick", &binary(value));
            svg.path("axis", &format!("M{} {}h-3", place(left), place(at)));
            free_above = at;
        }
    }
    if let Some((value, meaning)) = heat.mark.as_ref().filter(|(value, _)| bins::row(*value) < heat.rows) {
        let at = top + height - (bins::row(*value) as f64 + 1.0) * row_height;
        svg.path("mark", &format!("M{} {}h{}", place(left), place(at), place(width)));
        svg.label([left + width - 4.0, at - 4.0], Anchor::End, "note", meaning);
    }
}

/// Powers of two: `512`, `4Ki`.
fn binary(value: u64) -> String {
    match value {
        v if v >= 1 << 20 && v.is_multiple_of(1 << 20) => format!("{}Mi", v >> 20),
        v if v >= 1 << 10 && v.is_multiple_of(1 << 10) => format!("{}Ki", v >> 10),
        v => v.to_string(),
    }
}

fn color_bar(svg: &mut Svg, most: u64, id: &str) {
    let (left, width) = (68.0, 240.0);
    let gradient = format!("viridis-{id}");
    svg.open("linearGradient", &[("id", &gradient)]);
    for (stop, color) in VIRIDIS.into_iter().enumerate() {
        let (offset, color) = (stop as f64 / (VIRIDIS.len() - 1) as f64, hex(color));
        svg.empty("stop", &[("offset", &offset), ("stop-color", &color)]);
    }
    svg.close("linearGradient");
    let fill = format!("url(#{gradient})");
    let attributes: [(&str, &dyn std::fmt::Display); 6] =
        [("class", &"heat"), ("x", &left), ("y", &2), ("width", &width), ("height", &10), ("fill", &fill)];
    svg.empty("rect", &attributes);
    let mut value = 1;
    while value <= most {
        let at = left + width * if most <= 1 { 0.0 } else { logarithmic(value, most) };
        svg.label([at, 25.0], Anchor::Middle, "tick", &grouped(value));
        value *= if most > 1_000_000 { 100 } else { 10 };
    }
    svg.label([left + width + 12.0, 11.0], Anchor::Start, "note", "clusters (none: no colour)");
}

fn draw_picture(svg: &mut Svg, picture: &Picture, frame: [f64; 4]) {
    let [x, y, width, height] = frame.map(place);
    svg.open(
        "image",
        &[
            ("class", &"mark-picture"),
            ("x", &x),
            ("y", &y),
            ("width", &width),
            ("height", &height),
            ("href", &picture.uri),
        ],
    );
    svg.holding("title", &[], &picture.alt);
    svg.close("image");
}
