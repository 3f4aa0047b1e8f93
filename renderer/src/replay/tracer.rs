//! Keeps when the stages of chosen frames ran.

use crate::config::ExrFrames;
use crate::measure::{FrameTrace, StageSpan};
use crate::pass::{ScopeSpan, ScopeTree};
use crate::vk::Limits;

/// The spans of the traced frames of all temporal runs of one method.
pub struct Tracer<'a> {
    wanted: &'a ExrFrames,
    /// Run, frame and number of spans of every frame kept.
    frames: Vec<(u32, u32, usize)>,
    /// The spans of each of them, one frame's behind the other's.
    spans: Vec<ScopeSpan>,
}

impl<'a> Tracer<'a> {
    /// Room for the `wanted` of `frames` in `runs` runs with up to `stages` stages each, so that keeping them allocates
    /// nothing.
    pub fn new(wanted: &'a ExrFrames, frames: impl Iterator<Item = u32>, runs: u32, stages: usize) -> Self {
        let count = frames.filter(|&frame| wanted.contains(frame)).count() * runs as usize;
        Self { wanted, frames: Vec::with_capacity(count), spans: Vec::with_capacity(count * stages) }
    }

    /// Keeps a frame's spans if it is wanted.
    pub fn keep(&mut self, run: u32, frame: u32, spans: impl Iterator<Item = ScopeSpan>) {
        if self.wanted.contains(frame) {
            let before = self.spans.len();
            self.spans.extend(spans);
            self.frames.push((run, frame, self.spans.len() - before));
        }
    }

    /// Lets go what was kept of a run, which is made again.
    pub fn forget(&mut self, run: u32) {
        let mut owners = self.frames.iter().flat_map(|&(owner, _, spans)| std::iter::repeat_n(owner, spans));
        self.spans.retain(|_| owners.next() != Some(run));
        self.frames.retain(|(owner, ..)| *owner != run);
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
        let span = |span: &ScopeSpan| {
            let start = span.cpu_start.duration_since(cpu_origin).as_nanos() as u64;
            StageSpan {
                stage: tree.path(span.scope).to_owned(),
                gpu_ns: span.gpu_ticks.map(|ticks| ticks.map(gpu_ns)),
                cpu_ns: [start, start + span.cpu_time.as_nanos() as u64],
            }
        };
        let mut rest = self.spans.as_slice();
        let of_frame = |&(run, frame, count): &(u32, u32, usize)| {
            let (spans, others) = rest.split_at(count);
            rest = others;
            FrameTrace { run, frame, stages: spans.iter().map(span).collect() }
        };
        self.frames.iter().map(of_frame).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pass::ScopeId;
    use std::time::{Duration, Instant};

    #[test]
    fn of_a_run_that_is_made_again_the_second_time_is_kept() {
        let span = |milliseconds| ScopeSpan {
            scope: ScopeId::default(),
            cpu_start: Instant::now(),
            cpu_time: Duration::from_millis(milliseconds),
            gpu_ticks: None,
        };
        let mut tracer = Tracer::new(&ExrFrames::All, [7, 9].into_iter(), 2, 2);
        // A frame may have a stage more than the others.
        for (run, frame) in [(0, 7), (0, 9), (1, 7), (1, 9)] {
            tracer.keep(run, frame, (1..3 + u64::from(frame == 7)).map(span));
        }
        tracer.forget(0);
        tracer.keep(0, 7, [span(4), span(5)].into_iter());
        assert_eq!(tracer.frames, [(1, 7, 3), (1, 9, 2), (0, 7, 2)]);
        let times: Vec<u128> = tracer.spans.iter().map(|span| span.cpu_time.as_millis()).collect();
        assert_eq!(times, [1, 2, 3, 1, 2, 4, 5]);
    }
}
