//! Columns of histograms, from the bottom of a panel up, on a logarithmic axis: a lone thing is seen beside thousands.

use super::Column;
use super::draw::Axes;
use super::scale::Scale;
use super::svg::{Svg, place};
use crate::report::format::grouped;

/// What the axis begins at, so that a count of 1 is seen.
const BOTTOM: f64 = 0.6;
/// How far above the highest column the axis reaches, as a factor.
const ABOVE: f64 = 1.5;

/// The axis of counts of such columns, in a panel from `top` to `bottom`: those of all panels, so that these compare.
pub fn counts<'a>(columns: impl Iterator<Item = &'a Column>, [top, bottom]: [f64; 2]) -> Scale {
    let most = columns.map(|column| column.count).max().unwrap_or(1);
    Scale { logarithmic: true, domain: [BOTTOM, most as f64 * ABOVE], range: [bottom, top] }
}

/// The columns, each with what it counts as a tip.
pub fn draw(svg: &mut Svg, columns: &[Column], Axes { x, y }: &Axes) {
    let bottom = y.at(BOTTOM);
    for column in columns {
        let ([left, right], top) = (column.x.map(|end| x.at(end)), y.at(column.count as f64));
        // A gap tells neighbours apart where there is room for one.
        let gap = if right - left > 3.0 { 0.5 } else { 0.0 };
        let [left, top, width, height] = [left + gap, top, right - left - 2.0 * gap, bottom - top].map(place);
        let class = format!("mark-area f-{}", column.color);
        svg.open(
            "rect",
            &[("class", &class), ("x", &left), ("y", &top), ("width", &width), ("height", &height)],
        );
        svg.holding("title", &[], &format!("{}: {}", column.label, grouped(column.count)));
        svg.close("rect");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_of_one_is_seen_and_the_most_fits() {
        let column = |count| Column { label: "0".into(), x: [0.0, 1.0], count, color: "blue" };
        let axis = counts([column(1), column(4000)].iter(), [10.0, 110.0]);
        assert!(axis.at(1.0) < 105.0 && axis.at(4000.0) > 10.0, "{axis:?}");
        assert!(counts([].iter(), [10.0, 110.0]).domain[1] > BOTTOM);
    }
}
