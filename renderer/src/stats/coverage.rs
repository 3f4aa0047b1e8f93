//! Whether intervals hold the truth as often as they say, on noise of known making.

use super::{Line, Measured, Samples};
use rand_core::Rng;
use rand_pcg::Pcg32;

const TRIALS: u64 = 500;
const FRAMES: usize = 40;

/// What 95 % intervals may cover: beside what chance does over 500 trials, they are made a little too wide.
const COVERED: std::ops::RangeInclusive<f64> = 0.90..=0.98;

/// Noise of a machine, relative to a time.
struct Noise {
    random: Pcg32,
}

impl Noise {
    fn seeded(seed: u64) -> Self {
        Self { random: Pcg32::new(seed, 7) }
    }

    fn uniform(&mut self) -> f64 {
        (f64::from(self.random.next_u32()) + 0.5) / 4_294_967_296.0
    }

    /// A standard normal variable (Box and Muller).
    fn gauss(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }

    /// A slow wave over runs and frames in their order, of a random phase and about one period a run.
    fn drift(&mut self, runs: usize, depth: f64) -> Vec<Vec<f64>> {
        let phases = [self.uniform(), self.uniform()].map(|phase| phase * std::f64::consts::TAU);
        let wave = |place: usize| {
            let turn = place as f64 / FRAMES as f64;
            depth * ((turn * 6.1 + phases[0]).sin() + (turn * 2.3 + phases[1]).sin()) / 2.0
        };
        (0..runs).map(|run| (0..FRAMES).map(|frame| wave(run * FRAMES + frame)).collect()).collect()
    }

    /// Runs of frames that take `scale` times 5 to 9 ms, with noise of each frame and, given, of all methods alike.
    fn samples(&mut self, scale: f64, deviation: f64, drift: &[Vec<f64>]) -> Samples {
        let base = |frame: usize| scale * (7.0 + 2.0 * (frame as f64 / 9.0).sin());
        let runs = drift.iter().map(|run| {
            let noisy = |(frame, drift): (usize, &f64)| {
                base(frame) * (1.0 + drift) * (1.0 + deviation * self.gauss())
            };
            run.iter().enumerate().map(noisy).collect()
        });
        let runs = runs.collect();
        Samples::new(FRAMES, runs).unwrap()
    }
}

/// How many of the trials hold the truth.
fn covered(trial: impl Fn(&mut Noise) -> bool) -> f64 {
    let held = (0..TRIALS).filter(|&seed| trial(&mut Noise::seeded(seed))).count();
    held as f64 / TRIALS as f64
}

fn still(runs: usize) -> Vec<Vec<f64>> {
    vec![vec![0.0; FRAMES]; runs]
}

#[test]
fn ratios_paired_by_frame_cover_the_truth_whatever_drifts_for_both() {
    for runs in [2, 3, 5, 8, 12] {
        let part = covered(|noise| {
            let drift = noise.drift(runs, 0.2);
            let [a, b] = [1.0, 1.3].map(|scale| noise.samples(scale, 0.02, &drift).measure());
            b.ratio_to(&a).unwrap().contains(1.3)
        });
        assert!(COVERED.contains(&part), "{runs} runs: {part}");
    }
}

#[test]
fn pairing_makes_ratios_of_what_drifts_narrow() {
    let mut noise = Noise::seeded(3);
    let drift = noise.drift(6, 0.2);
    let [a, b] = [1.0, 1.3].map(|scale| noise.samples(scale, 0.02, &drift).measure());
    let paired = b.ratio_to(&a).unwrap().half() / 1.3;
    let alone = a.interval().unwrap().half() / a.value;
    assert!(paired < alone / 3.0, "{paired} {alone}");
}

#[test]
fn means_cover_what_repetitions_give_on_average() {
    // What the least of so many standard normal variables is on average.
    for (runs, least) in [(2, -0.5642), (3, -0.8463), (5, -1.1630), (10, -1.5388)] {
        let truth = Samples::new(FRAMES, vec![still_times()]).unwrap().measure().value * (1.0 + 0.03 * least);
        let part = covered(|noise| {
            noise.samples(1.0, 0.03, &still(runs)).measure().interval().unwrap().contains(truth)
        });
        assert!(COVERED.contains(&part), "{runs} runs: {part}");
    }
}

#[test]
fn slopes_and_offsets_of_lines_cover_what_repetitions_give_on_average() {
    // As above, of lines through times that grow evenly with x.
    for (runs, least) in [(2, -0.5642), (3, -0.8463), (5, -1.1630), (10, -1.5388)] {
        let base = Samples::new(FRAMES, vec![still_times()]).unwrap().measure().value * (1.0 + 0.03 * least);
        let line = |noise: &mut Noise| {
            let mut at = |x: f64| (x, noise.samples(1.0 + 0.2 * x, 0.03, &still(runs)).measure());
            Line::through(&[at(1.0), at(3.0), at(10.0), at(30.0)]).unwrap()
        };
        let slope = covered(|noise| line(noise).slope.interval().unwrap().contains(0.2 * base));
        let offset = covered(|noise| line(noise).offset.interval().unwrap().contains(base));
        // Minima of halves vary up to 1.2 times as much as those of all runs: the intervals are on the safe side.
        let safe = 0.93..=0.995;
        assert!(safe.contains(&slope) && safe.contains(&offset), "{runs} runs: {slope} {offset}");
    }
}

/// The frames of a run without noise.
fn still_times() -> Vec<f64> {
    (0..FRAMES).map(|frame| 7.0 + 2.0 * (frame as f64 / 9.0).sin()).collect()
}

#[test]
fn means_of_runs_that_shift_as_a_whole_cover_the_mean_of_repetitions() {
    for runs in [3, 5, 10] {
        let measure = |noise: &mut Noise| {
            let shifted: Vec<Vec<f64>> = (0..runs).map(|_| vec![0.03 * noise.gauss(); FRAMES]).collect();
            noise.samples(1.0, 0.01, &shifted).measure()
        };
        let trials: Vec<Measured> = (0..TRIALS).map(|seed| measure(&mut Noise::seeded(seed))).collect();
        let truth = super::mean(trials.iter().map(|trial| trial.value)).unwrap();
        let held = trials.iter().filter(|trial| trial.interval().unwrap().contains(truth)).count();
        let part = held as f64 / TRIALS as f64;
        assert!(COVERED.contains(&part), "{runs} runs: {part}");
    }
}

#[test]
fn sets_measured_apart_cover_the_ratio_of_their_times() {
    for runs in [3, 5, 10] {
        let part = covered(|noise| {
            let measure = |noise: &mut Noise, scale| {
                let shifted: Vec<Vec<f64>> = (0..runs).map(|_| vec![0.01 * noise.gauss(); FRAMES]).collect();
                noise.samples(scale, 0.03, &shifted).measure().ln()
            };
            let [a, b] = [measure(noise, 1.0), measure(noise, 1.05)];
            let noise = a.noise().unwrap().with(&b.noise().unwrap());
            (b.value - a.value - 1.05_f64.ln()).abs() <= noise.half_width(super::LEVEL)
        });
        // On the safe side twice: halves vary more than all runs, and so few degrees of freedom are understated.
        assert!((0.95..=1.0).contains(&part), "{runs} runs: {part}");
    }
}

/// `cargo test --release -- --ignored --nocapture cost_of` says what 30 methods of 670 frames and 20 runs take.
#[test]
#[ignore = "a measurement of time, not a check"]
fn cost_of_intervals() {
    let runs: Vec<Vec<f64>> = (0..20).map(|run| vec![1.0 + f64::from(run); 670 * 4]).collect();
    let samples = Samples::new(670, runs).unwrap();
    let begun = std::time::Instant::now();
    let measured: Vec<Measured> = (0..30).map(|_| samples.measure()).collect();
    assert_eq!(measured.len(), 30);
    println!("30 methods of four stages: {:?}", begun.elapsed());
}
