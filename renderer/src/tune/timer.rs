//! Runs of one scene timed side by side, nothing written.
//!
//! ```text
//! runs ─> prepared (not counted) ─> groups, the named run in each ─> frame times in turn ─> samples
//! ```

use crate::audience::Audience;
use crate::config::{Config, ExrFrames, FrameRange, Runs, Scopes};
use crate::inputs::Inputs;
use crate::measure::{FrameTimes, ViewPixels};
use crate::output::PlannedRun;
use crate::replay::{Counted, Failed, Player, RunResult, RunSink, Seat, Watch};
use crate::stats::{Samples, mean};
use crate::sweep::{MOST, most_bytes};
use crate::{Error, Result};
use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};

/// How long runs are timed.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// The frames.
    pub frames: FrameRange,
    /// How many of them there are.
    pub count: usize,
    /// How often.
    pub runs: Runs,
}

/// A device with a scene on it, for timing alone.
pub struct Timer<'a> {
    config: &'a Config,
    inputs: &'a Inputs,
    interrupt: &'a AtomicBool,
    audience: &'a dyn Audience,
    /// `None` after a failure, which may have lost the device.
    player: Option<Player<'a>>,
}

impl Effort {
    /// Every frame of a configuration, as often as it asks for.
    pub fn whole(config: &Config, frames: &[u32]) -> Self {
        Self { frames: config.frames, count: frames.len(), runs: config.runs }
    }

    /// So many of a configuration's frames, each in the middle of an equal share of them, twice.
    pub fn part(config: &Config, frames: &[u32], count: usize) -> Self {
        let (count, step) = (count.clamp(1, frames.len()), config.frames.step);
        let share = frames.len() / count;
        let first = frames[(share - 1) / 2];
        let step = step * share as u32;
        let end = Some(first + step * (count as u32 - 1) + 1);
        Self { frames: FrameRange { first, end, step }, count, runs: Runs::Fixed(2) }
    }

    /// A run with these frames, of which the time as a whole is taken and nothing else is kept.
    fn of(&self, run: &PlannedRun) -> PlannedRun {
        let nothing = || ExrFrames::List(vec![]);
        let config = Config {
            frames: self.frames,
            runs: self.runs,
            scopes: Scopes::Frame,
            exr: nothing(),
            trace: nothing(),
            ..run.config.clone()
        };
        PlannedRun { config, ..run.clone() }
    }
}

impl<'a> Timer<'a> {
    /// Opens the device; `config` asks for times.
    ///
    /// # Errors
    /// As [`Player::new`].
    pub fn new(
        (config, inputs): (&'a Config, &'a Inputs),
        (interrupt, audience): (&'a AtomicBool, &'a dyn Audience),
    ) -> Result<Self> {
        let player = Some(Player::new(config, inputs)?);
        Ok(Self { config, inputs, interrupt, audience, player })
    }

    /// Makes a run ready for all its frames.
    ///
    /// # Errors
    /// It cannot be played: its grids, buffers or shaders.
    pub fn prepare(&mut self, run: &PlannedRun) -> Result<Counted> {
        if self.interrupt.load(Ordering::Relaxed) {
            return Err(Error::Interrupted(String::new()));
        }
        self.player()?.prepare(run)
    }

    /// How slow each of some runs is: its mean frame time over that of `base`, which is timed in turn with it. Infinite
    /// where it could not be timed, which the audience is told of.
    ///
    /// # Errors
    /// What goes wrong with the base, or ends everything.
    pub fn scores(&mut self, base: &PlannedRun, runs: &[&PlannedRun], effort: &Effort) -> Result<Vec<f64>> {
        let mut scores = Vec::with_capacity(runs.len());
        let mut left = runs;
        while !left.is_empty() {
            let (group, rest) = left.split_at(self.fitting(base, left, effort)?);
            let all: Vec<&PlannedRun> = [base].into_iter().chain(group.iter().copied()).collect();
            let times: Vec<Option<f64>> = self.time(&all, effort)?.iter().map(mean_time).collect();
            let unit = times[0].unwrap_or(f64::NAN);
            scores.extend(times[1..].iter().map(|time| time.map_or(f64::INFINITY, |time| time / unit)));
            left = rest;
        }
        Ok(scores)
    }

    /// How many of some runs, at least one, go into a group with the base.
    fn fitting(&mut self, base: &PlannedRun, runs: &[&PlannedRun], effort: &Effort) -> Result<usize> {
        let mut free = most_bytes(self.player()?).saturating_sub(self.bytes(base, effort));
        let mut count = 0;
        for run in runs.iter().take(MOST - 1) {
            let bytes = self.bytes(run, effort);
            if bytes > free && count > 0 {
                break;
            }
            (free, count) = (free.saturating_sub(bytes), count + 1);
        }
        Ok(count)
    }

    /// What timing a run takes of memory at first; nothing where it cannot be timed.
    fn bytes(&mut self, run: &PlannedRun, effort: &Effort) -> u64 {
        let run = &effort.of(run);
        let Ok(player) = self.player() else { return 0 };
        player.prepare(run).map_or(0, |prepared| player.bytes(run, &prepared))
    }

    /// Whether runs fit into one group.
    ///
    /// # Errors
    /// There is no device any more.
    pub fn fit(&mut self, runs: &[&PlannedRun], effort: &Effort) -> Result<bool> {
        let bytes: u64 = runs.iter().map(|run| self.bytes(run, effort)).sum();
        Ok(runs.len() <= MOST && bytes <= most_bytes(self.player()?))
    }

    /// Times runs in turn, the first of which is the base; `None` where one could not be timed, which the audience is told of.
    ///
    /// # Errors
    /// What goes wrong with the base, or ends everything.
    pub fn time(&mut self, runs: &[&PlannedRun], effort: &Effort) -> Result<Vec<Option<Samples>>> {
        let runs: Vec<PlannedRun> = runs.iter().map(|run| effort.of(run)).collect();
        let mut left: Vec<usize> = (0..runs.len()).collect();
        loop {
            let group: Vec<&PlannedRun> = left.iter().map(|&number| &runs[number]).collect();
            match self.once(&group, effort) {
                Ok(times) => {
                    let mut samples = vec![None; runs.len()];
                    left.iter().zip(times).for_each(|(&number, times)| samples[number] = times);
                    return Ok(samples);
                }
                Err(Failed { seat, error }) if seat > 0 && is_its_own(&error) => {
                    self.audience.note(&format!("{} drops out: {error}", group[seat].name));
                    left.remove(seat);
                    self.player = None;
                }
                Err(Failed { error, .. }) => return Err(error),
            }
        }
    }

    fn once(&mut self, runs: &[&PlannedRun], effort: &Effort) -> Result<Vec<Option<Samples>>, Failed> {
        let (interrupt, audience) = (self.interrupt, self.audience);
        let most = effort.runs.fixed().unwrap_or(self.config.max_runs);
        let expected = (runs.len() * effort.count) as u64 * u64::from(most);
        audience.more(expected);
        let done = Cell::new(0);
        let watch = Watch {
            interrupt,
            progress: &|| {
                if done.get() < expected {
                    done.set(done.get() + 1);
                    audience.advance();
                }
            },
        };
        let player = self.player().map_err(|error| Failed { seat: 0, error })?;
        let mut counted = vec![];
        for (seat, run) in runs.iter().enumerate() {
            counted.push(Some(player.prepare(run).map_err(|error| Failed { seat, error })?));
        }
        let mut sinks: Vec<Sink> = runs.iter().map(|_| Sink { count: effort.count, samples: None }).collect();
        let seats = runs.iter().zip(&mut counted).zip(&mut sinks);
        let seats = seats.map(|((run, counted), sink)| Seat { run, counted, watch: &watch, sink });
        let timed = player.time(seats.collect());
        audience.skip(expected - done.get());
        timed.map(|()| sinks.into_iter().map(|sink| sink.samples).collect())
    }

    /// The player at hand, or a new one.
    fn player(&mut self) -> Result<&mut Player<'a>> {
        let player = match self.player.take() {
            Some(player) => player,
            None => Player::new(self.config, self.inputs)?,
        };
        Ok(self.player.insert(player))
    }

    /// Lets the device go.
    ///
    /// # Errors
    /// A validation message.
    pub fn finish(self) -> Result<()> {
        self.player.map_or(Ok(()), Player::finish)
    }
}

/// Whether an error is the run's that it met: a buffer that the device refuses, say.
pub fn is_its_own(error: &Error) -> bool {
    matches!(error, Error::Device(_) | Error::Input(_))
}

fn mean_time(samples: &Option<Samples>) -> Option<f64> {
    mean(samples.as_ref()?.minima())
}

/// Keeps frame times.
struct Sink {
    /// Frames of a temporal run.
    count: usize,
    samples: Option<Samples>,
}

impl RunSink for Sink {
    fn begin(&mut self, _: &PlannedRun) -> Result<()> {
        Ok(())
    }

    fn images(&mut self, _: u32, _: &[ViewPixels]) -> Result<()> {
        Ok(())
    }

    fn finish(&mut self, _: &PlannedRun, result: RunResult) -> Result<()> {
        let frame = |times: &FrameTimes| times.stages.first().map_or(f64::NAN, |stage| stage.gpu_ms);
        let runs = result.times.chunks(self.count).map(|run| run.iter().map(frame).collect()).collect();
        self.samples = Samples::new(self.count, runs);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_the_frames_are_spread_over_them() {
        let config = Config { frames: "100..400/20".parse().unwrap(), ..Config::default() };
        let frames = config.frame_numbers(500).unwrap();
        for count in 1..=20 {
            let part = Effort::part(&config, &frames, count);
            let chosen = part.frames.frames(500).unwrap();
            assert_eq!((chosen.len(), part.count), (count.min(15), count.min(15)));
            assert!(chosen.iter().all(|frame| frames.contains(frame)), "{chosen:?}");
        }
        assert_eq!(Effort::part(&config, &frames, 1).frames.first, 240);
        assert_eq!(Effort::part(&config, &frames, 15).frames.frames(500).unwrap(), frames);
    }
}
