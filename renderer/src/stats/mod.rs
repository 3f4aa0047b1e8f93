//! Statistics over the frames of a run, and how far its times can be trusted.
//!
//! ```text
//! times[run][stage][frame] ──> Samples ──┬─> measure ────────> Measured ──┬─> interval        (of a mean)
//!                                        ├─> deviation ──────────^        ├─> ratio_to        (paired)
//!                                        │    (splits of the runs, or,    ├─> combine         (of any function)
//!                                        │     of one run, blocks)        ├─> Line            (slope, offset)
//!                                        └─> halves (per frame)           └─> Noise ──> with  (of two sets)
//! ```
//!
//! # What an interval speaks of
//!
//! The time that is told of a frame is its minimum over the temporal runs, summed over views; that of a run, the mean
//! of those over the frames. An interval says within what the same number would lie in 95 % of repetitions with as
//! many temporal runs: it is the noise of measuring.
//!
//! **Frames are not resampled.** The frames of a recording are a fixed set of which all are measured, not a sample of
//! others: a mean over the very same frames does not vary for a different choice of them, and neighbours resemble each
//! other, so resampling them says how much the scene changes along the way and not how well it was measured. Runs are
//! resampled instead, each with all its frames: what shifts a run as a whole, and drift within it, is kept.
//!
//! **Minima are not bootstrapped by drawing with replacement.** That is known to fail for extremes (Bickel and Freedman,
//! *Some Asymptotic Theory for the Bootstrap*, 1981): no resample can go below the least value, and two thirds of them
//! contain it. Instead the runs are split at random into disjoint halves, as in balanced half-samples and in subsampling
//! (McCarthy 1969; Politis and Romano 1994), and the number is computed of each half. The variance over repetitions with
//! half the runs is half the mean square of the difference of two halves, without bias and whatever the distribution. All
//! runs together vary less than half of them, by how much depends on the noise (not at all to a factor of two), so that is
//! not counted on: the intervals are rather too wide than too narrow. Their width is by Student's distribution with as many
//! degrees of freedom as there are runs less one: two runs tell very little, and the intervals say so.
//!
//! **Ratios are paired** by frame and by run: both methods lose the same runs to the same half. What two methods that
//! were timed in turn have in common (a clock that rises, another's load) cancels. Of two sets that were measured apart
//! nothing is common but the frames, and the variances of the logarithms add (Welch 1947). What differs between the two
//! occasions as a whole is in no interval: no number of runs within one of them shows it.
//!
//! **One run** has no second to differ from. Its interval is by resampling blocks of neighbouring frames (Künsch 1989;
//! circular, of √n frames), which tells of the frames and not of measuring, and is said to be of them
//! ([`Basis::Frames`]).
//!
//! Everything is seeded: equal times give equal intervals, on any number of threads. The cost is a minimum per time
//! and split, of which there are at most 100: 30 methods of 670 frames and 20 runs take less than
//! a second.

mod blocks;
mod line;
mod measured;
mod noise;
mod sample;
mod samples;
mod splits;
mod student;

#[cfg(test)]
mod coverage;

pub use line::Line;
pub use measured::{Basis, Measured};
pub use noise::{Halves, Interval, LEVEL, Noise};
pub use sample::{Statistics, mean, percentile, slope};
pub use samples::Samples;
pub use splits::{Split, splits};
