//! Keeps when the stages of chosen frames ran.

use crate::config::ExrFrames;
use crate::measure::{FrameTrace, StageSpan};
use crate::pass::{ScopeSpan, ScopeTree};
use crate::vk::Limits;

/// The spans of the traced frames of all temporal runs of one method.
pub struct Tracer<'a> {
    wanted: &'a ExrFrames,
    /// (Run, frame) of every frame kept.
    frames: Vec<(u32, u32)>,
    /// The spans of each of them, one frame's behind the other's.
    spans: Vec<ScopeSpan>,
}

impl<'a> Tracer<'a> {
    /// Room for the `wanted` of `frames` in `runs` runs with `stages` stages each, so that keeping them allocates
    /// nothing.
    pub fn new(wanted: &'a ExrFrames, frames: impl Iterator<Item = u32>, runs: u32, stages: usize) -> Self {
        let count = frames.filter(|&frame| wanted.contains(frame)).count() * runs as usize;
        Self { wanted, frames: Vec::with_capacity(count), spans: Vec::with_capacity(count * stages) }
    }

    /// Keeps a frame's spans if it is wanted.
    pub fn keep(&mut self, run: u32, frame: u32, spans: impl Iterator<Item = ScopeSpan>) {
        if self.wanted.contains(frame) {
            self.frames.push((run, frame));
            self.spans.extend(spans);
        }
    }

    /// Lets go what was kept of a run, which is made again.
    pub fn forget(&mut self, run: u32) {
        let stages = self.spans.len() / self.frames.len().max(1);
        let mut owners = self.frames.iter().flat_map(|(owner, _)| std::iter::repeat_n(*owner, stages));
        self.spans.retain(|_| owners.next() != Some(run));
        self.frames.retain(|(owner, _)| *owner != run);
    }

    /// The whole trace on two clocks. That of the host starts with the first stage. That of the device cannot be
    /// compared with it; its first stage is put where the first frame's recording ended, before which it did not run.
    pub fn finish(&self, tree: &ScopeTree, limits: &Limits) -> Vec<FrameTrace> {
        let Some(first) = self.spans.first() else { return vec![] };
        let cpu_origin = first.cpu_start;
        let gpu_origin = first.gpu_ticks.map_or(0, |ticks| ticks[0]);
        let lead = first.cpu_time.as_nanos() as u64;
        let mask = u64::MAX >> (64 - limits.timestamp_valid_bits.clamp(1, 64));
        let gpu_ns = |tick: u64| {
            let ticks = tick.wrapping_sub(gpu_origin) & mask;
            lead + (ticks as f64 * limits.timestamp_period_ns).round() as u64
        };
        let span = |(path, span): (&str, &ScopeSpan)| {
            let start = span.cpu_start.duration_since(cpu_origin).as_nanos() as u64;
            StageSpan {
                stage: path.to_owned(),
                gpu_ns: span.gpu_ticks.map(|ticks| ticks.map(gpu_ns)),
                cpu_ns: [start, start + span.cpu_time.as_nanos() as u64],
            }
        };
        let frames = self.frames.iter().zip(self.spans.chunks(tree.paths().len()));
        frames
            .map(|(&(run, frame), spans)| FrameTrace {
                run,
                frame,
                stages: tree.paths().zip(spans).map(span).collect(),
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    #[test]
    fn of_a_run_that_is_made_again_the_second_time_is_kept() {
        let span = |milliseconds| ScopeSpan {
            cpu_start: Instant::now(),
            cpu_time: Duration::from_millis(milliseconds),
            gpu_ticks: None,
        };
        let mut tracer = Tracer::new(&ExrFrames::All, [7, 9].into_iter(), 2, 2);
        for (run, frame) in [(0, 7), (0, 9), (1, 7), (1, 9)] {
            tracer.keep(run, frame, [span(1), span(2)].into_iter());
        }
        tracer.forget(0);
        tracer.keep(0, 7, [span(3), span(4)].into_iter());
        assert_eq!(tracer.frames, [(1, 7), (1, 9), (0, 7)]);
        let times: Vec<u128> = tracer.spans.iter().map(|span| span.cpu_time.as_millis()).collect();
        assert_eq!(times, [1, 2, 1, 2, 3, 4]);
    }
}
