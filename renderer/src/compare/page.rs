//! The comparison as a page that opens offline, in the style of the report.

use super::table::{interval, load};
use super::{Comparison, Comparisons, RunComparison, TimeComparison, Verdict};
use crate::Result;
use crate::output::write_whole;
use crate::report::{document, text};
use std::fmt::Write as _;
use std::path::Path;

/// Writes the page.
///
/// # Errors
/// The file cannot be written.
pub fn write_page(path: &Path, comparisons: &Comparisons) -> Result<()> {
    let page = html(comparisons);
    write_whole(path, |file| std::io::Write::write_all(file, page.as_bytes()))
}

fn html(comparisons: &Comparisons) -> String {
    let mut body = String::new();
    // Writing to a string cannot fail, here and below.
    let _ = writeln!(
        body,
        "<header>\n<p class=\"eyebrow\">manylight compare</p>\n<h1>{}</h1>\n<p>{}</p>\n</header>",
        comparisons.verdicts,
        text(&comparisons.about_times())
    );
    comparisons.all().for_each(|comparison| section(&mut body, comparison));
    document(&body, "{}")
}

fn section(body: &mut String, comparison: &Comparison) {
    let [a, b] = [&comparison.a, &comparison.b].map(|set| text(&set.directory));
    let _ = writeln!(body, "<section>\n<h2>{b} against {a}</h2>\n<dl class=\"machine\">");
    for (side, set) in [("A", &comparison.a), ("B", &comparison.b)] {
        let made =
            format!("{} runs by {} on {}", set.runs, set.programs.join(" and "), set.devices.join(" and "));
        let _ = writeln!(body, "<div><dt>{side}</dt><dd>{}</dd></div>", text(&made));
    }
    body.push_str("</dl>\n");
    if let Some(difference) = comparison.difference() {
        let _ = writeln!(body, "<p class=\"warning\">{}</p>", text(&difference));
    }
    body.push_str(
        "<div class=\"scroll\"><table class=\"ways\">\n<thead><tr><th class=\"lighting\">Metric</th>",
    );
    for heading in ["A", "B", "B/A", "Interval", "Verdict"] {
        let _ = write!(body, "<th>{heading}</th>");
    }
    body.push_str("</tr></thead>\n");
    comparison.runs.iter().for_each(|run| rows(body, run));
    body.push_str("</table></div>\n</section>\n");
}

fn rows(body: &mut String, run: &RunComparison) {
    let _ = writeln!(
        body,
        "<tbody><tr class=\"group\"><th colspan=\"6\"><span>{}</span></th></tr>",
        text(&run.run)
    );
    for counter in run.counters.iter().filter(|counter| counter.differs()) {
        let [a, b] = [counter.a, counter.b].map(|sum| sum.map_or("–".into(), |sum| sum.to_string()));
        let ratio = counter.ratio.map_or("–".into(), |ratio| format!("{ratio:.6}"));
        let verdict = format!("differs in {} of {} frames", counter.frames_differing, run.frames);
        row(body, [&counter.metric, &a, &b, &ratio, "", &verdict], "fails");
    }
    for image in &run.images {
        let (class, what) = match (image.integers_differ(), image.differs()) {
            (true, _) => ("fails", image.to_string()),
            (false, true) => ("open", image.to_string()),
            (false, false) => ("holds", format!("{} {}: equal", image.file, image.layer)),
        };
        let _ = writeln!(
            body,
            "<tr><td class=\"lighting {class}\" colspan=\"6\">image {}</td></tr>",
            text(&what)
        );
    }
    if let Some(load) = load(run) {
        let _ = writeln!(body, "<tr><td class=\"lighting open\" colspan=\"6\">{}</td></tr>", text(&load));
    }
    for time in &run.times {
        let TimeComparison { stage, a_ms, b_ms, ratio, verdict, .. } = time;
        let class = match verdict {
            Verdict::Faster => "holds",
            Verdict::Slower => "fails",
            Verdict::Same | Verdict::Undecided => "open",
        };
        let [a, b, ratio] = [a_ms, b_ms, ratio].map(|number| format!("{number:.3}"));
        row(body, [&format!("{stage} ms"), &a, &b, &ratio, &interval(time), &verdict.to_string()], class);
    }
    body.push_str("</tbody>\n");
}

fn row(body: &mut String, [metric, cells @ .., verdict]: [&str; 6], class: &str) {
    let _ = write!(body, "<tr><td class=\"lighting\">{}</td>", text(metric));
    for cell in cells {
        let _ = write!(body, "<td>{}</td>", text(cell));
    }
    let _ = writeln!(body, "<td class=\"verdict {class}\">{}</td></tr>", text(verdict));
}
