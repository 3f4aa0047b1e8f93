//! G1 to G3: one clustering a view against one for all.

use super::is_far;
use crate::methods::Space;
use crate::report::claim::{Findings, Outcome, mean, mean_where, milliseconds, number};
use crate::report::gelderen::flies_the_street;
use crate::report::results::{ResultSet, Run, Setting, TUNED, encl, indi, method_name, metric};

/// Runs of one lighting by Indi and by Encl.
struct Pair<'a> {
    indi: &'a Run,
    encl: &'a Run,
}

fn stereo(set: &ResultSet) -> Vec<&Setting> {
    set.settings().into_iter().filter(|setting| setting.is_stereo()).collect()
}

fn pairs<'a>(set: &'a ResultSet, setting: &'a Setting, space: Space) -> Vec<Pair<'a>> {
    let others = set.of_method(setting, encl(space));
    let pair = |indi: &'a Run| {
        let encl = others.iter().copied().find(|run| run.lighting == indi.lighting)?;
        Some(Pair { indi, encl })
    };
    set.of_method(setting, indi(space)).into_iter().filter_map(pair).collect()
}

impl Pair<'_> {
    fn name(&self, what: &str) -> String {
        format!("{what}, {}, {}", method_name(self.indi.method, false), self.indi.lighting.label)
    }

    /// Means of a metric by Indi and Encl over the frames that `include` takes.
    fn means(&self, metric: &str, include: impl Fn(u32) -> bool) -> Option<[f64; 2]> {
        Some([mean_where(self.indi, metric, &include)?, mean_where(self.encl, metric, &include)?])
    }
}

pub(super) fn visible_clusters(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    for setting in stereo(set) {
        for pair in TUNED.iter().flat_map(|&space| pairs(set, setting, space)) {
            let Some([by_indi, by_encl]) = pair.means(metric::VISIBLE, |_| true) else { continue };
            let ratio = by_encl / by_indi;
            let numbers = vec![number("Indi", by_indi), number("Encl", by_encl), number("ratio", ratio)];
            findings.compare(
                pair.indi,
                pair.name("visible clusters"),
                numbers,
                Outcome::within(ratio, [0.4, 0.6]),
            );
        }
    }
    needs_pairs(&mut findings);
    findings
}

pub(super) fn lighting_computations(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    for setting in stereo(set) {
        for pair in pairs(set, setting, TUNED[0]) {
            lower(&mut findings, &pair, metric::COMPUTATIONS, "lighting computations");
        }
    }
    if findings.evidence.is_empty() {
        findings.lack("stereo runs of Indi and Encl Persp 64");
    }
    findings
}

pub(super) fn clustering_time(set: &ResultSet) -> Findings {
    let mut findings = Findings::default();
    let mut far_compared = false;
    for setting in stereo(set) {
        for space in TUNED {
            let pairs = pairs(set, setting, space);
            for pair in &pairs {
                lower(&mut findings, pair, metric::CLUSTER, "clustering time");
                if matches!(space, Space::Ortho { .. }) && flies_the_street(setting) {
                    far_compared |= saves_more_afar(&mut findings, pair);
                }
            }
            saves_most_at_100_000(&mut findings, &pairs);
        }
    }
    needs_pairs(&mut findings);
    if !findings.evidence.iter().any(|evidence| evidence.comparison.starts_with("time saved by lighting")) {
        findings.lack("stereo runs under 100 000 lights and under fewer");
    }
    if !far_compared {
        findings.lack(
            "timed stereo runs of Ortho 4 on the street's recording, within and without frames 530 to 630",
        );
    }
    findings
}

/// Whether the mean by Encl is below that by Indi.
fn lower(findings: &mut Findings, pair: &Pair<'_>, metric: &str, what: &str) {
    let Some([by_indi, by_encl]) = pair.means(metric, |_| true) else {
        return findings.lack(format!("temporal runs of {}", pair.indi.method));
    };
    let make = if metric == metric::CLUSTER { milliseconds } else { number };
    let numbers = vec![
        make("Indi".to_owned(), by_indi),
        make("Encl".to_owned(), by_encl),
        number("ratio", by_encl / by_indi),
    ];
    findings.compare(pair.indi, pair.name(what), numbers, Outcome::above(by_indi, by_encl));
}

/// Compares the saving at far geometry with that elsewhere; whether there were data to.
fn saves_more_afar(findings: &mut Findings, pair: &Pair<'_>) -> bool {
    let saving = |far: bool| {
        let [by_indi, by_encl] = pair.means(metric::CLUSTER, |frame| is_far(frame) == far)?;
        Some(by_indi - by_encl)
    };
    let (Some(far), Some(near)) = (saving(true), saving(false)) else { return false };
    let numbers =
        vec![milliseconds("saved at frames 530 to 630", far), milliseconds("saved at the others", near)];
    findings.compare(
        pair.indi,
        pair.name("time saved with far geometry"),
        numbers,
        Outcome::above(far, near),
    );
    true
}

/// Compares the saving at 100 000 lights with that at fewer.
fn saves_most_at_100_000(findings: &mut Findings, pairs: &[Pair<'_>]) {
    let saved = |pair: &Pair<'_>| Some(mean(pair.indi, metric::CLUSTER)? - mean(pair.encl, metric::CLUSTER)?);
    let mut savings: Vec<(u32, f64)> =
        pairs.iter().filter_map(|pair| Some((pair.indi.lighting.count?, saved(pair)?))).collect();
    savings.sort_by_key(|(count, _)| *count);
    let Some(&(_, most)) = savings.iter().find(|(count, _)| *count == 100_000) else { return };
    let others = || savings.iter().filter(|(count, _)| *count != 100_000);
    if others().count() == 0 {
        return;
    }
    let numbers =
        savings.iter().map(|(count, saved)| milliseconds(format!("saved at {count} lights"), *saved));
    let second = others().map(|(_, saved)| *saved).fold(f64::NEG_INFINITY, f64::max);
    let comparison = format!("time saved by lighting, {}", method_name(pairs[0].indi.method, false));
    findings.compare(pairs[0].indi, comparison, numbers.collect(), Outcome::above(most, second));
}

fn needs_pairs(findings: &mut Findings) {
    if findings.evidence.is_empty() {
        findings.lack("stereo runs of Persp 64, Ortho 4 or Displ 64 32, both Indi and Encl");
    }
}
