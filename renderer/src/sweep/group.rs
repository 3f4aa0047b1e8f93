//! Runs of one part that are timed in turn: which go together, and how far each is.

use super::Part;
use super::writer::Files;
use crate::config::Config;
use crate::measure::{Order, Precision, Timing};
use crate::output::PlannedRun;
use crate::replay::{Counted, Failed, Player, Seat, Watch};
use std::cell::Cell;
use std::rc::Rc;
use std::sync::atomic::AtomicBool;

/// Most runs of a group: an interruption costs what was measured of one.
pub(crate) const MOST: usize = 32;

/// Engines may take one part in so many of the device's own memory: scene and targets need some of it, and so do drivers and
/// other programs.
const MEMORY_SHARE: u64 = 2;

/// A run under way.
pub(super) struct Member<'o> {
    pub run: &'o PlannedRun,
    pub files: Files<'o>,
    pub tally: Rc<Tally>,
    /// Once it is counted, until it is written.
    pub counted: Option<Counted>,
}

/// How many frames of a run were submitted, of those that progress counts.
pub(super) struct Tally {
    frames: u64,
    /// Since the run, or timing it, was begun anew.
    done: Cell<u64>,
    /// The most of that so far, which progress shows.
    shown: Cell<u64>,
    /// How many counting took.
    counting: Cell<u64>,
}

impl Tally {
    /// Of a run that submits so many frames at most.
    pub fn new(frames: u64) -> Rc<Self> {
        Rc::new(Self { frames, done: Cell::new(0), shown: Cell::new(0), counting: Cell::new(0) })
    }

    /// One more; `show` is called where it is progress.
    pub fn step(&self, show: impl FnOnce()) {
        self.done.set(self.done.get() + 1);
        if self.done.get() > self.shown.get() {
            self.shown.set(self.done.get());
            show();
        }
    }

    /// Counting is over.
    pub fn counted(&self) {
        self.counting.set(self.done.get());
    }

    /// What was timed is timed anew.
    pub fn again(&self) {
        self.done.set(self.counting.get());
    }

    /// Frames that were not submitted.
    pub fn left(&self) -> u64 {
        self.frames.saturating_sub(self.shown.get())
    }
}

/// The most runs of a group.
pub(super) fn most(config: &Config) -> usize {
    match config.order {
        // Nothing is gained by waiting for others where nothing is timed.
        Order::Interleaved if !config.runs.is_none() => MOST,
        _ => 1,
    }
}

/// Whether a group that ends with `last` had better end there: the runs that come next, under other lights, do not all fit
/// in with it.
pub(super) fn ends_with(last: &PlannedRun, size: usize, next: &[&PlannedRun]) -> bool {
    let Some(first) = next.first() else { return false };
    let together = next.iter().take_while(|run| run.lights == first.lights).count();
    first.lights != last.lights && size + together > MOST
}

/// Whether the engines of a group and that of one more run are more than the device should hold.
pub(super) fn overfills(player: &Player, group: &[Member], more: &Member) -> bool {
    let bytes =
        |member: &Member| member.counted.as_ref().map_or(0, |counted| player.bytes(member.run, counted));
    let all: u64 = group.iter().chain([more]).map(bytes).sum();
    all > most_bytes(player)
}

/// What the engines of a group may take of the device's memory, bytes.
pub(crate) fn most_bytes(player: &Player) -> u64 {
    player.device_bytes() / MEMORY_SHARE
}

/// Times a group.
pub(super) fn time(player: &mut Player, group: &mut [Member], interrupt: &AtomicBool) -> Result<(), Failed> {
    let steps: Vec<_> = group
        .iter()
        .map(|member| {
            let (tally, audience) = (member.tally.clone(), member.files.audience);
            move || tally.step(|| audience.advance())
        })
        .collect();
    let watches: Vec<Watch> = steps.iter().map(|progress| Watch { interrupt, progress }).collect();
    let seats = group.iter_mut().zip(&watches).map(|(member, watch)| Seat {
        run: member.run,
        counted: &mut member.counted,
        watch,
        sink: &mut member.files,
    });
    player.time(seats.collect())
}

/// What is good to know of how the runs of a group were timed.
pub(super) fn notes(part: &Part, timed: &[(&PlannedRun, &Timing)]) -> Vec<String> {
    let disturbed: usize = timed.iter().map(|(_, timing)| timing.disturbed.len()).sum();
    let again = (disturbed > 0).then(|| format!("{} made again: disturbed as a whole", temporal(disturbed)));
    let reached: Vec<(&PlannedRun, &Precision)> =
        timed.iter().filter_map(|(run, timing)| Some((*run, timing.reached.as_ref()?))).collect();
    let turns = timed.first().map_or(0, |(_, timing)| timing.runs as usize);
    let percent = part.config.precision;
    let precise = reached.iter().filter(|(_, precision)| precision.precise).count();
    let auto = (!reached.is_empty()).then(|| match widest(&reached) {
        Some((run, precision)) if precise < reached.len() => format!(
            "{} of each of {}: {precise} within {percent} %; {} is the farthest from it, {}",
            temporal(turns),
            text_of(reached.len()),
            part.full_name(run),
            text_of_precision(precision),
        ),
        _ => format!("{} of each of {}: all within {percent} %", temporal(turns), text_of(reached.len())),
    });
    auto.into_iter().chain(again).collect()
}

fn temporal(runs: usize) -> String {
    if runs == 1 { "1 temporal run".into() } else { format!("{runs} temporal runs") }
}

fn text_of(runs: usize) -> String {
    if runs == 1 { "1 run".into() } else { format!("{runs} runs") }
}

fn text_of_precision(precision: &Precision) -> String {
    let percent =
        |percent: Option<f64>| percent.map_or("unknown".into(), |percent| format!("±{percent:.1} %"));
    let Precision { mean_percent, base, ratio_percent, .. } = precision;
    format!("mean {}, ratio to {base} {}", percent(*mean_percent), percent(*ratio_percent))
}

fn widest<'r>(reached: &[(&'r PlannedRun, &'r Precision)]) -> Option<(&'r PlannedRun, &'r Precision)> {
    let width = |precision: &Precision| {
        let known = |percent: Option<f64>| percent.unwrap_or(f64::INFINITY);
        known(precision.mean_percent).max(known(precision.ratio_percent))
    };
    reached.iter().copied().max_by(|(_, a), (_, b)| width(a).total_cmp(&width(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Runs;
    use crate::lights::Lighting;
    use crate::output::planned_runs;
    use crate::sweep::parts;

    fn config(lights: &[u32], methods: usize) -> Config {
        Config {
            lights: lights.iter().map(|&count| Lighting::with_count(count)).collect(),
            methods: (1..=methods).map(|pixels| format!("indi-persp-{pixels}").parse().unwrap()).collect(),
            ..Config::default()
        }
    }

    #[test]
    fn a_group_ends_where_the_next_lighting_would_be_parted() {
        let ends = |methods: usize| {
            let runs = planned_runs(&config(&[1, 2], methods));
            let next: Vec<&PlannedRun> = runs[methods..].iter().collect();
            ends_with(&runs[methods - 1], methods, &next)
        };
        assert_eq!([ends(MOST / 2), ends(MOST / 2 + 1)], [false, true]);
        let one = planned_runs(&config(&[1], MOST));
        let next: Vec<&PlannedRun> = one[1..].iter().collect();
        assert!(!ends_with(&one[0], 1, &next), "more of the same lighting may follow up to the most");
        assert!(!ends_with(&one[0], 1, &[]));
    }

    #[test]
    fn nobody_waits_for_others_in_sequence_or_where_nothing_is_timed() {
        assert_eq!(most(&Config::default()), MOST);
        assert_eq!(most(&Config { order: Order::Sequential, ..Config::default() }), 1);
        assert_eq!(most(&Config { runs: Runs::Fixed(0), ..Config::default() }), 1);
    }

    #[test]
    fn a_frame_that_is_rendered_again_is_no_progress() {
        let tally = Tally::new(10);
        let shown = Cell::new(0);
        let step = || tally.step(|| shown.set(shown.get() + 1));
        (0..3).for_each(|_| step());
        tally.counted();
        (0..4).for_each(|_| step());
        tally.again();
        (0..5).for_each(|_| step());
        assert_eq!((shown.get(), tally.left()), (8, 2));
    }

    #[test]
    fn notes_tell_what_was_reached_and_what_was_made_again() {
        let part = &parts(&config(&[1], 2)).unwrap()[0];
        let timing = |percent: f64, disturbed: usize| Timing {
            runs: 7,
            disturbed: vec![Default::default(); disturbed],
            reached: Some(Precision {
                mean_percent: Some(percent),
                base: "indi-persp-1".into(),
                ratio_percent: Some(0.5),
                precise: percent <= 2.0,
            }),
            ..Timing::default()
        };
        let told = |timings: [Timing; 2]| notes(part, &part.runs.iter().zip(&timings).collect::<Vec<_>>());
        assert_eq!(
            told([timing(1.0, 0), timing(2.0, 0)]),
            ["7 temporal runs of each of 2 runs: all within 2 %"]
        );
        assert_eq!(
            told([timing(1.0, 1), timing(3.25, 0)]),
            [
                "7 temporal runs of each of 2 runs: 1 within 2 %; indi-persp-2 is the farthest from it, mean ±3.2 %, \
                 ratio to indi-persp-1 ±0.5 %",
                "1 temporal run made again: disturbed as a whole"
            ]
        );
        assert_eq!(told([Timing::default(), Timing::default()]), Vec::<String>::new());
    }
}
