//! E11 and E13: lists that do not depend on the view, and how many there are.

use super::compared::{Place, deviation, in_every_scene, title};
use crate::measure::Purpose;
use crate::methods::{KINDS, Method};
use crate::report::claim::{Findings, Number, Outcome, milliseconds, number};
use crate::report::enhuber::evaluation::{lights, name};
use crate::report::results::{FrameGroups, ResultSet, Run, Setting, metric};

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
    let times = deviation(run).map(|ms| milliseconds("standard deviation of the frame time", ms));
    let numbers = [number("least", least), number("most", most)].into_iter().chain(times);
    let same = Outcome { holds: least == most, margin: least - most };
    findings.compare_in(place.name(), described("light indices of a frame"), numbers.collect(), same);
    if let [first, others @ ..] = &run.groups[..] {
        let alike = |groups: &&FrameGroups| groups.clusterings == first.clusterings;
        let differing = others.iter().filter(|groups| !alike(groups)).count() as f64;
        let numbers =
            vec![number("frames", run.groups.len() as f64), number("that differ from the first", differing)];
        let same = Outcome { holds: differing == 0.0, margin: -differing };
        findings.compare_in(place.name(), described("groups by lights"), numbers, same);
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
        let here = [sparse, dense].into_iter().filter_map(|run| {
            let kib = list_memory(run)? / 1024.0;
            Some(Number { name: format!("{}, lists by offsets", name(run.method)), value: kib, unit: "KiB" })
        });
        let ratio = number("ratio", sparse_lists / dense_lists);
        let told = numbers.into_iter().chain([ratio]).chain(here).collect();
        let outcome = Outcome::within(sparse_lists / dense_lists, [0.0, 0.5]);
        findings.compare_in(place.name(), format!("most lists of a frame, {}", lights(many)), told, outcome);
    })
}

/// What the lists of the frame that needs most take on the device, bytes; `None` of a run that does not tell.
fn list_memory(run: &Run) -> Option<f64> {
    let rows = run.memory.iter().filter(|row| row.purpose == Purpose::Lists.name());
    let bytes: u64 = rows.map(|row| row.most).sum();
    (bytes > 0).then_some(bytes as f64)
}

/// The method of another kind with the same sizes.
fn as_dense(method: Method, kind: &str) -> Option<Method> {
    KINDS.iter().find(|known| known.name == kind).map(|known| known.with_sizes(&method.sizes()))
}
