//! Times of one metric, of every temporal run.

use super::blocks;
use super::measured::{Measured, Resampled};
use super::noise::Halves;
use super::sample::deviation;
use super::splits::splits;

/// Times of one metric: of each temporal run, of each stage that the metric sums, of each frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Samples {
    frames: usize,
    /// By run: frames of the first stage, frames of the second.
    runs: Vec<Vec<f64>>,
}

impl Samples {
    /// Of runs, each of which holds the frames of its first stage, then those of the next. `None` where runs differ in
    /// length, or hold no whole number of stages, or a time is missing (not finite), or there is nothing.
    pub fn new(frames: usize, runs: Vec<Vec<f64>>) -> Option<Self> {
        let length = runs.first()?.len();
        let is_whole = |run: &Vec<f64>| run.len() == length && run.iter().all(|time| time.is_finite());
        let fits = frames > 0 && length > 0 && length.is_multiple_of(frames);
        (fits && runs.iter().all(is_whole)).then_some(Self { frames, runs })
    }

    /// How many temporal runs there are.
    pub fn runs(&self) -> usize {
        self.runs.len()
    }

    /// The first of its runs, so many: minima over different numbers of runs do not compare.
    pub fn first(&self, runs: usize) -> Self {
        Self { frames: self.frames, runs: self.runs[..runs.min(self.runs.len())].to_vec() }
    }

    /// Of each frame the sum over stages of the minimum over runs.
    pub fn minima(&self) -> Vec<f64> {
        self.minima_over(&(0..self.runs()).collect::<Vec<_>>())
    }

    /// The same of either half of the runs, for each way of splitting them.
    pub fn halves(&self) -> Halves<Vec<f64>> {
        let pairs = splits(self.runs()).into_iter().map(|split| split.map(|half| self.minima_over(&half)));
        Halves { runs: self.runs(), pairs: pairs.collect() }
    }

    /// The mean over frames, with what tells its noise.
    pub fn measure(&self) -> Measured {
        self.number(|frames| self.mean(frames), blocks::means)
    }

    /// The standard deviation over frames, which are the whole population, with what tells its noise. What frames differ
    /// by because of the noise of measuring is part of it.
    pub fn deviation(&self) -> Measured {
        self.number(deviation, blocks::deviations)
    }

    /// A number of all frames, and the same of halves of the runs or, of one run, of its blocks.
    fn number(&self, of: impl Fn(&[f64]) -> f64, of_blocks: impl Fn(&[f64]) -> Option<Vec<f64>>) -> Measured {
        let minima = self.minima();
        let resampled = match self.runs() {
            1 => of_blocks(&minima)
                .map_or(Resampled::Nothing, |drawn| Resampled::Frames { frames: self.frames, drawn }),
            _ => Resampled::Runs(self.halves().map(|frames| of(frames))),
        };
        Measured::new(of(&minima), resampled)
    }

    fn mean(&self, frames: &[f64]) -> f64 {
        frames.iter().sum::<f64>() / self.frames as f64
    }

    /// The same as [`Self::minima`] over some of the runs, by their numbers.
    pub fn minima_over(&self, chosen: &[usize]) -> Vec<f64> {
        let Some((first, others)) = chosen.split_first() else { return vec![] };
        let mut least = self.runs[*first].clone();
        for run in others {
            // The shape that compilers turn into one instruction; no time is NaN.
            least.iter_mut().zip(&self.runs[*run]).for_each(|(a, b)| *a = if *b < *a { *b } else { *a });
        }
        let (sums, stages) = least.split_at_mut(self.frames);
        for stage in stages.chunks(self.frames) {
            sums.iter_mut().zip(stage).for_each(|(sum, time)| *sum += time);
        }
        least.truncate(self.frames);
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minima_are_taken_per_stage_before_stages_are_summed() {
        let samples = Samples::new(2, vec![vec![1.0, 8.0, 10.0, 20.0], vec![2.0, 4.0, 5.0, 30.0]]).unwrap();
        assert_eq!(samples.minima(), [6.0, 24.0]);
        assert_eq!(samples.measure().value, 15.0);
        assert_eq!(samples.halves().pairs, [[vec![11.0, 28.0], vec![7.0, 34.0]]]);
        assert_eq!(samples.first(1).minima(), [11.0, 28.0]);
    }

    #[test]
    fn deviations_are_of_the_frames_of_the_minima_and_of_each_half() {
        let samples = Samples::new(2, vec![vec![1.0, 9.0], vec![3.0, 5.0]]).unwrap();
        let deviation = samples.deviation();
        assert_eq!(deviation.value, 2.0, "of 1 and 5");
        // One run's is 4, the other's 1.
        assert!((deviation.noise().unwrap().deviation - 3.0 / 2.0_f64.sqrt()).abs() < 1e-12);
        let one = Samples::new(64, vec![(0..64).map(|place| f64::from(place % 8)).collect()]).unwrap();
        assert!((one.deviation().value - 5.25_f64.sqrt()).abs() < 1e-12);
        let interval = one.deviation().interval().unwrap();
        assert!(interval.half() < 1e-9 && (interval.low - 5.25_f64.sqrt()).abs() < 1e-9, "whole periods");
    }

    #[test]
    fn what_is_not_whole_is_no_sample() {
        assert_eq!(Samples::new(2, vec![]), None);
        assert_eq!(Samples::new(2, vec![vec![1.0; 2], vec![1.0; 4]]), None);
        assert_eq!(Samples::new(2, vec![vec![1.0; 3]]), None);
        assert_eq!(Samples::new(1, vec![vec![f64::NAN]]), None);
        assert_eq!(Samples::new(1, vec![vec![]]), None);
    }
}
