//! The page: one HTML file with its styles, script, drawings and numbers inside.

mod machine;
mod runs;
mod tables;

pub use runs::write_runs_csv;

use super::chart::palette;
use super::claim::{ByWay, Claim, Evidence, Verdict};
use super::figure::Figure;
use super::format::readable;
use super::paper::{Section, papers};
use super::results::ResultSet;
use super::tables::Table;
use crate::output::with_interval;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::fmt::Write;

/// How numbers come to be: name and explanation.
const METHOD_NOTES: [(&str, &str); 8] = [
    (
        "Times",
        "GPU time of each stage from timestamp queries around it. Every stage of every frame is timed in each temporal run; \
         the number drawn is its minimum over those runs. Nothing is counted while times are taken.",
    ),
    (
        "Counters",
        "One further run with counters in the shaders: visible clusters, light indices, intersection tests, lighting \
         computations. They depend on the replay alone and repeat exactly.",
    ),
    (
        "Clustering, shading, total",
        "Clustering is everything from the depth pass to the finished light lists, over all clusterings of the frame; \
         shading is over all views; total is the whole frame on the GPU.",
    ),
    (
        "Lighting computation",
        "One evaluation of one light for one fragment. Needed are those closer than the light's influence radius R₁.",
    ),
    (
        "Distributions",
        "Visible clusters by the length of their light list and by their fragments, of every frame of the counting run.",
    ),
    (
        "Doubtful times",
        "Of runs during which other processes took the CPUs (where those are the device, more than 5 % of them), a governor \
         or a performance level chose lower clocks, power or heat held them back, or clocks differed between temporal runs. \
         The machine is asked before and after each temporal run, never within one.",
    ),
    (
        "Intervals",
        "± is half the 95 % interval of the noise of measuring: the spread of the same number over halves of the temporal runs, \
         paired by frame and run for ratios and for the margins of claims, whose distance to their bound is undecided where \
         the interval straddles it. Of one run, it is that of its frames in blocks.",
    ),
    (
        "Statistics",
        "Over the frames of a run: mean, median, 95th percentile (linear between neighbours), standard deviation of the \
         frames as the whole population.",
    ),
];

/// What was made of the results.
#[derive(Debug, Clone, Copy, Default)]
pub struct Content<'a> {
    /// The papers' figures.
    pub figures: &'a [Figure],
    /// Further pictures.
    pub galleries: &'a [Figure],
    /// Times by method, lights and scene.
    pub analysis: Option<&'a Analysis>,
    /// The papers' claims.
    pub claims: &'a [Claim],
    /// Tables over several ways of assignment.
    pub tables: &'a [Table],
    /// The papers' own tables.
    pub paper_tables: &'a [Table],
}

/// A section of tables and drawings.
#[derive(Debug, Clone, Default)]
pub struct Analysis {
    /// Drawings, or notes of what is missing.
    pub figures: Vec<Figure>,
    /// Numbers.
    pub tables: Vec<Table>,
}

/// The whole page.
pub fn html(set: &ResultSet, content: &Content<'_>) -> String {
    let Content { figures, analysis, galleries, claims, tables, paper_tables } = *content;
    let mut body = String::new();
    header(&mut body, set);
    navigation(&mut body, set, content);
    claims_section(&mut body, set, claims);
    if !tables.is_empty() {
        tables::section(&mut body, tables);
    }
    if let Some(Analysis { figures, tables }) = analysis {
        section(&mut body, "analysis", "Analysis: assignment and shading");
        figures.iter().for_each(|figure| figure_element(&mut body, figure, false));
        tables.iter().for_each(|table| tables::element(&mut body, table));
        body.push_str("</section>\n");
    }
    for Section { heading, anchor, ids } in sections(set) {
        section(&mut body, anchor, heading);
        let belongs = |id: &str| ids.iter().any(|start| id.starts_with(start));
        let figures = figures.iter().filter(|figure| belongs(&figure.id));
        figures.for_each(|figure| figure_element(&mut body, figure, true));
        let tables = paper_tables.iter().filter(|table| belongs(table.id));
        tables.for_each(|table| tables::element(&mut body, table));
        body.push_str("</section>\n");
    }
    if !galleries.is_empty() {
        section(&mut body, "lights", "Lights per cluster, seen from the camera");
        galleries.iter().for_each(|figure| figure_element(&mut body, figure, false));
        body.push_str("</section>\n");
    }
    runs::section(&mut body, set);
    machine::section(&mut body, set);
    method_section(&mut body, set);
    let analysed = analysis.map_or(&[][..], |analysis| &analysis.figures);
    document(&body, &numbers(figures.iter().chain(analysed)))
}

/// The sections of the papers whose methods were run.
fn sections(set: &ResultSet) -> impl Iterator<Item = &'static Section> {
    papers(set).into_iter().flat_map(|paper| paper.sections)
}

/// The page around a body, with its styles and scripts; `data` is JSON of the numbers of figures.
pub(crate) fn document(body: &str, data: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n\
         <title>manylight report</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n{}{}{}</style>\n\
         <script>{}</script>\n</head>\n<body>\n{body}<div id=\"tip\" role=\"status\" hidden></div>\n\
         <script type=\"application/json\" id=\"numbers\">{data}</script>\n<script>{}</script>\n</body>\n</html>\n",
        palette::themes(),
        include_str!("page.css"),
        palette::rules(),
        include_str!("watch.js"),
        include_str!("page.js"),
    )
}

/// Numbers of all drawn figures for the tooltips, by figure; safe within a script element.
fn numbers<'a>(figures: impl Iterator<Item = &'a Figure>) -> String {
    let drawn = figures.filter_map(|figure| Some((figure.id.clone(), figure.chart.as_ref()?.hover_data())));
    Value::Object(drawn.collect::<Map<_, _>>()).to_string().replace('<', "\\u003c")
}

/// HTML of a text.
pub(crate) fn text(plain: &str) -> String {
    super::chart::escape(plain)
}

fn section(body: &mut String, anchor: &str, heading: &str) {
    // Writing to a string cannot fail, here and below.
    let _ = writeln!(body, "<section id=\"{anchor}\">\n<h2>{}</h2>", text(heading));
}

fn header(body: &mut String, set: &ResultSet) {
    let mut devices: BTreeMap<&[String; 3], usize> = BTreeMap::new();
    for run in &set.runs {
        *devices.entry(&run.device).or_default() += 1;
    }
    let _ = writeln!(
        body,
        "<header>\n<p class=\"eyebrow\">manylight report</p>\n<h1>Clustered light shading, measured</h1>"
    );
    let _ = writeln!(body, "<dl class=\"machine\">");
    let mut fact = |name: &str, value: &str| {
        let _ = writeln!(body, "<div><dt>{name}</dt><dd>{}</dd></div>", text(value));
    };
    for ([name, driver, api], runs) in &devices {
        let shared =
            if devices.len() > 1 { format!(" ({runs} of {} runs)", set.runs.len()) } else { String::new() };
        fact("Device", &format!("{name}{shared}"));
        fact("Driver", &format!("{driver}, Vulkan {api}"));
    }
    let revision: String = set.git_revision.chars().take(12).collect();
    fact("Program", &format!("manylight {} ({revision})", set.version));
    for setting in set.settings() {
        fact("Replay", &setting.to_string());
    }
    let started = set.runs.iter().map(|run| run.started.as_str());
    let (first, last) = (started.clone().min().unwrap_or_default(), started.max().unwrap_or_default());
    let seconds = set.runs.iter().map(|run| run.duration_s).sum::<f64>();
    let [first, last] = [first, last].map(minute);
    fact(
        "Measured",
        &format!("{} runs in {} s, started {first} to {last} UTC", set.runs.len(), readable(seconds)),
    );
    body.push_str("</dl>\n");
    warnings(body, set);
    body.push_str("</header>\n");
}

/// What makes times doubtful, or unfit to be compared.
fn warnings(body: &mut String, set: &ResultSet) {
    if machine::machines(set).len() > 1 {
        body.push_str("<p class=\"warning\">Runs come from several machines: times of different runs do not compare.</p>\n");
    }
    let doubtful = machine::doubtful(set).count();
    if doubtful > 0 {
        let _ = writeln!(
            body,
            "<p class=\"warning\">Times of {doubtful} of {} runs are doubtful: see <a href=\"#machine\">Machine</a>.</p>",
            set.runs.len()
        );
    }
}

/// Date and time to the minute of an RFC 3339 moment.
fn minute(moment: &str) -> String {
    moment.chars().take(16).map(|c| if c == 'T' { ' ' } else { c }).collect()
}

fn navigation(body: &mut String, set: &ResultSet, content: &Content<'_>) {
    body.push_str("<nav>\n<a href=\"#claims\">Claims</a>\n");
    if !content.tables.is_empty() {
        body.push_str("<a href=\"#ways\">Ways of assignment</a>\n");
    }
    if content.analysis.is_some() {
        body.push_str("<a href=\"#analysis\">Analysis</a>\n");
    }
    for Section { heading, anchor, .. } in sections(set) {
        let short = heading.split(':').next().unwrap_or(heading);
        let _ = writeln!(body, "<a href=\"#{anchor}\">{short}</a>");
    }
    if !content.galleries.is_empty() {
        body.push_str("<a href=\"#lights\">Lights per cluster</a>\n");
    }
    body.push_str("<a href=\"#runs\">All runs</a>\n<a href=\"#machine\">Machine</a>\n<a href=\"#method\">How measured</a>\n</nav>\n");
}

fn figure_element(body: &mut String, figure: &Figure, numbered: bool) {
    let Figure { id, title, caption, setting, chart } = figure;
    let name = if numbered { format!("Figure {id}") } else { String::new() };
    let _ = writeln!(
        body,
        "<figure id=\"figure-{id}\" data-figure=\"{id}\" class=\"{}\">",
        chart.as_ref().map_or("absent", |_| "present")
    );
    let _ = writeln!(body, "<h3><span class=\"number\">{name}</span> {}</h3>", text(title));
    if !setting.is_empty() {
        let _ = writeln!(body, "<p class=\"setting\">{}</p>", text(setting));
    }
    if let Some(chart) = chart {
        let _ = writeln!(body, "<div class=\"canvas\">{}</div>", chart.svg(id, title));
    }
    let _ = writeln!(body, "<figcaption>{}</figcaption>\n</figure>", text(caption));
}

fn claims_section(body: &mut String, set: &ResultSet, claims: &[Claim]) {
    let names: Vec<&str> = papers(set).into_iter().map(|paper| paper.name).collect();
    section(body, "claims", &format!("Claims of {}", names.join(" and ")));
    body.push_str("<div class=\"claims\">\n");
    for claim in claims {
        let (class, sign) = sign(claim.verdict);
        let _ = writeln!(
            body,
            "<details class=\"claim\"><summary><span class=\"place\">{}</span><span class=\"words\">{}</span>\
             <span class=\"verdict {class}\"><i>{sign}</i> {}</span></summary>",
            claim.id,
            text(claim.claim),
            claim.verdict
        );
        let _ = writeln!(
            body,
            "<p class=\"criterion\"><b>Counts as holding when:</b> {}</p>",
            text(claim.criterion)
        );
        for missing in &claim.missing {
            let _ = writeln!(body, "<p class=\"criterion\"><b>Missing:</b> {}.</p>", text(missing));
        }
        evidence(body, &claim.evidence);
        claim.other_ways.iter().for_each(|other| other_way(body, other));
        body.push_str("</details>\n");
    }
    body.push_str("</div>\n</section>\n");
}

/// Class and sign of a verdict.
fn sign(verdict: Verdict) -> (&'static str, &'static str) {
    match verdict {
        Verdict::Holds => ("holds", "✓"),
        Verdict::DoesNotHold => ("fails", "✗"),
        Verdict::Undecided => ("open", "?"),
        Verdict::NotEnoughData => ("open", "–"),
    }
}

/// What another way of assignment says of the claim above.
fn other_way(body: &mut String, other: &ByWay) {
    let (class, sign) = sign(other.verdict);
    let _ = writeln!(
        body,
        "<p class=\"criterion\"><b>Lights assigned by {}:</b> <span class=\"verdict {class}\"><i>{sign}</i> {}</span></p>",
        text(&other.way),
        other.verdict
    );
    evidence(body, &other.evidence);
}

fn evidence(body: &mut String, evidence: &[Evidence]) {
    if evidence.is_empty() {
        return;
    }
    body.push_str("<div class=\"scroll\"><table class=\"evidence\">\n");
    let mut setting = "";
    for item in evidence {
        if item.setting != setting {
            setting = &item.setting;
            let _ = writeln!(body, "<tr><th colspan=\"3\">{}</th></tr>", text(setting));
        }
        let mut numbers: Vec<String> = item
            .numbers
            .iter()
            .map(|number| {
                format!(
                    "<span><em>{}</em> {} {}</span>",
                    text(&number.name),
                    readable(number.value),
                    number.unit
                )
            })
            .collect();
        let (class, sign) = match (item.decided, item.holds) {
            (false, _) => ("open", "? undecided"),
            (true, true) => ("holds", "✓ holds"),
            (true, false) => ("fails", "✗ fails"),
        };
        let margin = item.interval.map(|interval| {
            let shown = with_interval(item.margin, Some(interval), [0, 3]);
            format!("<span><em>margin</em> {shown}</span>")
        });
        numbers.extend(margin);
        let _ = writeln!(
            body,
            "<tr><td>{}</td><td class=\"numbers\">{}</td><td class=\"verdict {class}\">{sign}</td></tr>",
            text(&item.comparison),
            numbers.join(" ")
        );
    }
    body.push_str("</table></div>\n");
}

fn method_section(body: &mut String, set: &ResultSet) {
    section(body, "method", "How each number was made");
    body.push_str("<dl class=\"notes\">\n");
    for (name, note) in METHOD_NOTES {
        let _ = writeln!(body, "<div><dt>{name}</dt><dd>{note}</dd></div>");
    }
    let mut runs: Vec<u32> = set.runs.iter().map(|run| run.temporal_runs).collect();
    runs.sort_unstable();
    runs.dedup();
    let runs: Vec<String> = runs.iter().map(u32::to_string).collect();
    let _ = writeln!(
        body,
        "<div><dt>Here</dt><dd>Minima are over {} temporal runs; the table above says how many frames each run has.</dd></div>",
        runs.join(" or ")
    );
    body.push_str("</dl>\n</section>\n");
}
