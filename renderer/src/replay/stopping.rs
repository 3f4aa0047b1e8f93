//! When enough temporal runs were made: pure.
//!
//! Either so many as were asked for; or, turn by turn, until of each run of a group the 95 % interval (see [`crate::stats`]) of
//! its mean frame time, and of the ratio of that to its base's, reaches no farther to either side than the precision asked
//! for, or the most turns were made. A run's base is the first of the group under the same lights. All go on until the last
//! is precise: ratios are paired turn by turn.
//!
//! Looking again after each turn finds a narrow interval by chance sooner than looking once: at least [`FEWEST_RUNS`] are
//! made, with fewer of which nobody knows either whether one of them was disturbed.

use super::disturbed::FEWEST_OTHERS;
use crate::config::{Config, Runs};
use crate::measure::Precision;
use crate::stats::{Interval, Measured, Samples};

/// As many turns are made at least, where that is left to precision.
const FEWEST_RUNS: u32 = FEWEST_OTHERS as u32 + 1;

/// How many temporal runs are made.
#[derive(Debug, Clone, Copy)]
pub struct Stopping {
    runs: Runs,
    percent: f64,
    most: u32,
}

/// The frame times of one run of a group.
#[derive(Debug, Clone)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// Which of the group it is compared with.
    pub base: usize,
    /// GPU milliseconds of every frame of every temporal run.
    pub runs: Vec<Vec<f64>>,
}

impl Stopping {
    /// What a configuration asks for.
    pub fn of(config: &Config) -> Self {
        Self { runs: config.runs, percent: config.precision, most: config.most_runs() }
    }

    /// Whether so many turns are as many as were asked for, where a number was.
    pub fn is_asked_for(&self, turns: u32) -> bool {
        self.runs == Runs::Fixed(turns)
    }

    /// How precisely the times of each of a group are known.
    pub fn precisions(&self, group: &[Series]) -> Vec<Precision> {
        let measured: Vec<Option<Measured>> = group.iter().map(Series::measure).collect();
        let of = |series: &Series, own: &Option<Measured>| self.precision(series, own, (group, &measured));
        group.iter().zip(&measured).map(|(series, own)| of(series, own)).collect()
    }

    /// Whether so many turns, which made a group so precise, are enough where that decides.
    pub fn is_enough(&self, turns: u32, group: &[Precision]) -> bool {
        let precise = turns >= FEWEST_RUNS && group.iter().all(|run| run.precise);
        self.runs == Runs::Auto && (precise || turns >= self.most)
    }

    fn precision(
        &self,
        series: &Series,
        own: &Option<Measured>,
        (group, measured): (&[Series], &[Option<Measured>]),
    ) -> Precision {
        let base = &measured[series.base];
        let mean_percent = own.as_ref().and_then(|own| percent(own.interval()?, own.value));
        let ratio_percent = own
            .as_ref()
            .zip(base.as_ref())
            .and_then(|(own, base)| percent(own.ratio_to(base)?, own.value / base.value));
        let narrow = |percent: Option<f64>| percent.is_some_and(|percent| percent <= self.percent);
        Precision {
            precise: narrow(mean_percent) && narrow(ratio_percent),
            mean_percent,
            base: group[series.base].name.clone(),
            ratio_percent,
        }
    }
}

impl Series {
    fn measure(&self) -> Option<Measured> {
        let frames = self.runs.first()?.len();
        Samples::new(frames, self.runs.clone()).map(|samples| samples.measure())
    }
}

/// Half an interval in percent of the value it is of.
fn percent(interval: Interval, value: f64) -> Option<f64> {
    Some(100.0 * interval.half() / value).filter(|percent| percent.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_core::Rng;
    use rand_pcg::Pcg32;

    const FRAMES: usize = 20;

    /// Frame times of two methods in so many turns: each frame has noise of its own, each turn one that both share.
    fn group(turns: u32, (own, shared): (f64, f64)) -> Vec<Series> {
        let mut random = Pcg32::new(9, 9);
        let mut noise = |deviation: f64| {
            let sum: f64 = (0..12).map(|_| f64::from(random.next_u32()) / 4_294_967_296.0).sum();
            1.0 + deviation * (sum - 6.0)
        };
        let mut runs = [vec![], vec![]];
        for _ in 0..turns {
            let common = noise(shared);
            for (method, scale) in runs.iter_mut().zip([10.0, 7.0]) {
                method.push((0..FRAMES).map(|_| scale * common * noise(own)).collect());
            }
        }
        let series = |(name, runs): (&str, Vec<Vec<f64>>)| Series { name: name.into(), base: 0, runs };
        ["first", "second"].into_iter().zip(runs).map(series).collect()
    }

    /// After how many turns it is enough, and how precise the second method is then.
    fn stopped(stopping: &Stopping, noise: (f64, f64)) -> (u32, Precision) {
        let mut turns = 1..;
        turns
            .find_map(|turns| {
                let reached = stopping.precisions(&group(turns, noise));
                let enough = stopping.is_asked_for(turns) || stopping.is_enough(turns, &reached);
                enough.then(|| (turns, reached[1].clone()))
            })
            .unwrap()
    }

    fn auto(percent: f64, most: u32) -> Stopping {
        let config = Config { runs: Runs::Auto, precision: percent, max_runs: most, ..Config::default() };
        Stopping::of(&config)
    }

    #[test]
    fn a_given_number_is_made_whatever_the_noise() {
        let three = Stopping::of(&Config { runs: Runs::Fixed(3), ..Config::default() });
        assert_eq!(stopped(&three, (0.5, 0.5)).0, 3);
        assert_eq!(stopped(&three, (0.0, 0.0)).0, 3);
    }

    #[test]
    fn quiet_times_are_enough_after_the_fewest_runs() {
        let (turns, reached) = stopped(&auto(2.0, 20), (0.001, 0.001));
        assert_eq!((turns, reached.base.as_str(), reached.precise), (FEWEST_RUNS, "first", true));
        assert!(reached.mean_percent.unwrap() < 1.0 && reached.ratio_percent.unwrap() < 1.0, "{reached:?}");
    }

    #[test]
    fn noise_takes_more_runs_and_less_precision_fewer() {
        let noise = (0.02, 0.012);
        let [fine, coarse] = [1.0, 4.0].map(|percent| stopped(&auto(percent, 1000), noise));
        assert!(coarse.0 < fine.0 && fine.0 < 1000, "{coarse:?} {fine:?}");
        assert!(fine.1.precise && coarse.1.precise);
    }

    #[test]
    fn what_never_gets_precise_ends_and_says_so() {
        let (turns, reached) = stopped(&auto(0.01, 7), (0.2, 0.2));
        assert!(turns == 7 && !reached.precise && reached.mean_percent.unwrap() > 0.01, "{reached:?}");
    }

    #[test]
    fn what_both_share_widens_means_and_not_ratios() {
        let second = &auto(2.0, 20).precisions(&group(8, (0.001, 0.2)))[1];
        assert!(second.mean_percent.unwrap() > 2.0 && second.ratio_percent.unwrap() < 0.5, "{second:?}");
        assert!(!second.precise);
    }

    #[test]
    fn the_base_is_known_exactly_over_itself_and_times_that_are_missing_never() {
        let reached = auto(2.0, 20).precisions(&group(6, (0.01, 0.01)));
        assert_eq!(reached[0].ratio_percent, Some(0.0));
        let mut missing = group(6, (0.01, 0.01));
        missing[1].runs[2][3] = f64::NAN;
        let reached = auto(2.0, 20).precisions(&missing);
        assert!(!auto(2.0, 20).is_enough(6, &reached));
        assert!(!reached[1].precise && reached[1].mean_percent.is_none(), "{reached:?}");
    }
}
