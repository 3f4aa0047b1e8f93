//! Loops of more turns than 16 bits count: lavapipe ends them after 65 535, in silence.

use super::cases::{PERSP, frustum_grid, rain};
use super::{Context, Verdict};
use crate::Result;
use crate::buffers::BufferName;
use crate::config::{Assign, Test};
use crate::engine::workbench::Case;
use crate::measure::Capacities;
use crate::passes::probes;

/// Turns that are asked for.
const TURNS: u32 = 200_000;
/// Turns that all shaders of the program may count on.
const NEEDED: u32 = 65_535;

/// Whether a long loop makes all its turns, and if not, at least those that the program needs.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let lights = rain(1)?;
    let capacities = Capacities { visible_clusters: 16, light_indices: 16, ..Capacities::default() };
    let case = Case { method: PERSP, grid: frustum_grid([2, 2, 2]), lights: &lights, capacities };
    let bench = context.bench((Assign::Brute, Test::Auto), case)?;
    let probe = bench.session.store.probe(&bench.variant, "selftest/loop.comp")?;
    bench.engine.bind(&bench.session, std::slice::from_ref(&probe))?;
    bench.upload(BufferName::Measurements, &[TURNS, 0, 0])?;
    bench.run(|r, frame| probes::compute(r, frame, &probe, 1))?;
    Ok(verdict(bench.download(BufferName::Measurements, 3)?[2]))
}

fn verdict(made: u32) -> Verdict {
    match made {
        TURNS => Verdict::Fine(format!("a loop of {TURNS} turns makes them all")),
        NEEDED..TURNS => Verdict::Note(format!("a loop of {TURNS} turns ends after {made}")),
        _ => Verdict::Wrong(format!(
            "a loop of {TURNS} turns makes {made}, less than the {NEEDED} that are needed"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_that_end_early_are_a_note_as_long_as_the_program_can_do_with_them() {
        assert!(matches!(verdict(TURNS), Verdict::Fine(_)));
        assert!(matches!(verdict(65_535), Verdict::Note(_)));
        assert!(matches!(verdict(1000), Verdict::Wrong(_)));
        assert!(matches!(verdict(TURNS + 1), Verdict::Wrong(_)));
    }
}
