//! E11 and E13: lists that do not depend on the view, and how many there are.

use super::compared::{Place, deviation, in_every_scene, title};
use crate::methods::{KINDS, Method};
use crate::report::claim::{Findings, Outcome, milliseconds, number};
use crate::report::enhuber::evaluation::{lights, name};
use crate::report::results::{ResultSet, Run, Setting, metric};

pub(super) fn whatever_the_view(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        for kind in ["g", "m"] {
            let standing = place
                .scene
                .runs
                .iter()
                .filter(|run| run.method.kind().name == kind && stand_still(&run.setting));
            let before = findings.evidence.len();
            standing.for_each(|run| same_lists(place, run, findings));
            if findings.evidence.len() == before {
                let kind = title(kind);
                findings.lack(format!(
                    "runs of {kind} over several frames, with lights that stand still, in {}",
                    place.scene.name()
                ));
            }
        }
    })
}

fn same_lists(place: Place<'_>, run: &Run, findings: &mut Findings) {
    let indices: Vec<f64> = run.frames.values(metric::INDICES).collect();
    if indices.len() < 2 {
        return;
    }
    let (least, most) = indices
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(least, most), value| (least.min(*value), most.max(*value)));
    let described = |what: &str| format!("{what}, {}, {}", name(run.method), run.lighting.label);
    let numbers = vec![number("least", least), number("most", most)];
    let same = Outcome { holds: least == most, margin: least - most };
    findings.compare_in(place.name(), described("light indices of a frame"), numbers, same);
    if let Some(deviation) = deviation(run) {
        let numbers = vec![milliseconds("standard deviation", deviation)];
        findings.compare_in(
            place.name(),
            described("frame times differ"),
            numbers,
            Outcome::above(deviation, 0.0),
        );
    }
}

/// Whether the lights of a setting are where they are in every frame.
fn stand_still(setting: &Setting) -> bool {
    let has = |option: &str| setting.options.iter().any(|known| known == option);
    (has("light source gamma") || has("light source volume")) && !has("light motion bounce")
}

pub(super) fn sparse(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let Some(many) = place.evaluation.many() else { return };
        let compared = ["dc-i", "dc-e"].into_iter().filter_map(|dense| {
            let sparse = place.run("sc-e", many)?;
            Some((sparse, place.scene.run(as_dense(sparse.method, dense)?, many)?))
        });
        // Implicit and measured bounds have as many lists.
        let Some((sparse, dense)) = compared.into_iter().next() else {
            let at = place.evaluation.chosen("sc-e").map_or_else(|| "SC-E".to_owned(), name);
            return findings.lack(format!(
                "runs of {at} and of DC-I or DC-E at the same size under {} in {}",
                lights(many),
                place.scene.name()
            ));
        };
        let most = |run: &Run| run.frames.values(metric::VISIBLE).fold(0.0, f64::max);
        let [sparse_lists, dense_lists] = [most(sparse), most(dense)];
        let numbers = [(sparse, sparse_lists), (dense, dense_lists)]
            .map(|(run, lists)| number(name(run.method), lists));
        let told = numbers.into_iter().chain([number("ratio", sparse_lists / dense_lists)]).collect();
        let outcome = Outcome::within(sparse_lists / dense_lists, [0.0, 0.5]);
        findings.compare_in(place.name(), format!("most lists of a frame, {}", lights(many)), told, outcome);
    })
}

/// The method of another kind with the same sizes.
fn as_dense(method: Method, kind: &str) -> Option<Method> {
    KINDS.iter().find(|known| known.name == kind).map(|known| known.with_sizes(&method.sizes()))
}
