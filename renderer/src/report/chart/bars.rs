//! Bars across a panel, each below a line that names it, with a whisker for the interval of the whole.

use super::Bar;
use super::scale::{Scale, ticks};
use super::svg::{Anchor, Svg, place};
use crate::report::format::short;

/// From one bar to the next.
const PITCH: f64 = 34.0;
/// Of a bar.
const THICKNESS: f64 = 11.0;
/// Above the first line.
const ABOVE: f64 = 4.0;
/// Room that a tick label needs.
const TICK_ROOM: f64 = 56.0;
/// A panel is as high as so many bars at least, for the label beside it.
const FEWEST: usize = 3;
/// How far beyond the bars whiskers are shown, in lengths of the longest.
const WHISKERS: f64 = 0.5;

/// Height of a panel of so many bars.
pub fn height(bars: usize) -> f64 {
    2.0 * ABOVE + PITCH * bars.max(FEWEST) as f64
}

/// The bars in `frame` (left, top, width, height), with an axis of their own.
pub fn draw(svg: &mut Svg, bars: &[Bar], [left, top, width, height]: [f64; 4]) {
    let x = Scale { logarithmic: false, domain: domain(bars), range: [left, left + width] };
    let bottom = top + height;
    for tick in ticks(x.domain[0], x.domain[1], (width / TICK_ROOM) as usize) {
        let at = x.at(tick);
        svg.path("grid", &format!("M{} {}V{}", place(at), place(top), place(bottom)));
        svg.label([at, bottom + 13.0], Anchor::Middle, "tick", &short(tick));
    }
    for (row, bar) in bars.iter().enumerate() {
        draw_bar(svg, bar, x, top + ABOVE + PITCH * row as f64);
    }
    svg.path("axis", &format!("M{} {}V{}", place(x.at(0.0)), place(top), place(bottom)));
}

fn draw_bar(svg: &mut Svg, bar: &Bar, x: Scale, top: f64) {
    svg.label(
        [x.range[0] + 6.0, top + 11.0],
        Anchor::Start,
        "label",
        &format!("{}: {}", bar.label, bar.told),
    );
    let (top, mut from) = (top + 15.0, 0.0);
    for (key, value) in &bar.parts {
        let ends = [from, from + value].map(|end| x.at(end));
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        svg.rect(&format!("mark-area f-{}", key.look.color), [low, top, high - low, THICKNESS]);
        from += value;
    }
    if let Some(interval) = bar.interval {
        let [low, high] = [interval.low, interval.high].map(|end| x.at(end.clamp(x.domain[0], x.domain[1])));
        let middle = top + THICKNESS / 2.0;
        let d = format!("M{} {}H{}", place(low), place(middle), place(high));
        svg.path("whisker", &d);
    }
}

/// From 0, or below where a bar is, to beyond the longest bar. Whiskers that reach very far are cut off.
fn domain(bars: &[Bar]) -> [f64; 2] {
    let wholes = || bars.iter().map(|bar| bar.parts.iter().map(|part| part.1).sum::<f64>());
    let reach = wholes().fold(0.0, |most: f64, whole| most.max(whole.abs()));
    let whiskers = || bars.iter().filter_map(|bar| bar.interval);
    let low = wholes().fold(0.0, f64::min);
    let high = wholes().fold(0.0, f64::max);
    // Where no bar goes to the left, the axis does not: whiskers end at 0 there.
    let least = whiskers().filter(|_| low < 0.0).map(|interval| interval.low).fold(low, f64::min);
    let most = whiskers().map(|interval| interval.high).fold(high, f64::max);
    let (least, most) = (least.max(low - WHISKERS * reach), most.min(high + WHISKERS * reach));
    if least < most { [least, most + 0.03 * (most - least)] } else { [0.0, 1.0] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::chart::{Key, Look};
    use crate::stats::Interval;

    fn bar(parts: &[f64], interval: Option<[f64; 2]>) -> Bar {
        let key = Key { label: "part".into(), look: Look::plain("blue") };
        Bar {
            label: "a".into(),
            told: String::new(),
            parts: parts.iter().map(|&value| (key.clone(), value)).collect(),
            interval: interval.map(|[low, high]| Interval { low, high }),
        }
    }

    #[test]
    fn axes_hold_bars_and_the_near_part_of_whiskers() {
        let round = |bars: &[Bar]| domain(bars).map(|end| (end * 1e6).round() / 1e6);
        assert_eq!(round(&[bar(&[1.0, 9.0], Some([-3.0, 12.0]))]), [0.0, 12.36]);
        assert_eq!(round(&[bar(&[10.0], Some([-300.0, 500.0]))]), [0.0, 15.45]);
        assert_eq!(round(&[bar(&[-2.0], Some([-2.5, -1.5])), bar(&[8.0], None)]), [-2.5, 8.315]);
        assert_eq!(domain(&[]), [0.0, 1.0]);
    }
}
