//! Frame time under few and many lights (4.12, 4.13): the analysis of every report, of the thesis's methods alone.

use crate::report::analysis;
use crate::report::chart::Chart;
use crate::report::enhuber::evaluation::{Evaluation, SEVEN, Scene};
use crate::report::results::{ResultSet, Run};

/// The numbers of lights of figure 4.12.
const COUNTS: [u32; 3] = [100, 1000, 10_000];

/// A panel a number of lights, a bar a method.
pub fn bars(set: &ResultSet, evaluation: &Evaluation<'_>, scene: &Scene<'_>) -> Option<Chart> {
    let is_shown = |run: &Run| run.lighting.count.is_some_and(|count| COUNTS.contains(&count));
    analysis::times(&chosen(set, evaluation, is_shown), &scene.setting)
}

/// Lines through all numbers of lights.
pub fn lines(set: &ResultSet, evaluation: &Evaluation<'_>, scene: &Scene<'_>) -> Option<Chart> {
    fitted(set, evaluation, scene).map(|fits| analysis::lines(&scene.setting, &fits))
}

/// Slopes and offsets of the lines.
pub fn slopes(set: &ResultSet, evaluation: &Evaluation<'_>, scene: &Scene<'_>) -> Option<Chart> {
    fitted(set, evaluation, scene).map(|fits| analysis::slopes_and_offsets(&scene.setting, &fits))
}

fn fitted(set: &ResultSet, evaluation: &Evaluation<'_>, scene: &Scene<'_>) -> Option<Vec<analysis::Fit>> {
    let fits = analysis::fits(&chosen(set, evaluation, |_| true), &scene.setting);
    (!fits.is_empty()).then_some(fits)
}

/// The runs of the methods that stand for the seven kinds.
fn chosen(set: &ResultSet, evaluation: &Evaluation<'_>, is_shown: impl Fn(&Run) -> bool) -> ResultSet {
    let methods = evaluation.chosen_of(&SEVEN);
    evaluation.results(set, |run| methods.contains(&run.method) && is_shown(run))
}
