//! The search for one method under one lighting.

use super::halving::{Chains, Decision, decide, halve};
use super::ladder::{candidates, chain};
use super::timer::{Effort, Timer, is_its_own};
use crate::Result;
use crate::config::{Assign, Config, Test};
use crate::output::{PlannedRun, planned_runs};
use crate::stats::Samples;
use std::fmt;

/// What a search starts from.
pub struct Problem<'c> {
    /// The scene's configuration, with the ways and tests that are tried.
    pub config: &'c Config,
    /// One of it, with one lighting and one method.
    pub of: &'c Config,
    /// Numbers of the configuration's frames.
    pub frames: &'c [u32],
}

/// What a search found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The method as it was named, by its own test and the way of assignment that counts find cheapest.
    pub named: PlannedRun,
    /// What is fastest.
    pub best: PlannedRun,
    /// What comes next.
    pub runner_up: Option<PlannedRun>,
    /// Whether the next may be as fast.
    pub undecided: bool,
    /// How many candidates there were.
    pub tried: usize,
    /// How many combinations were left out: a test that does not serve the method, a grid or buffers that are too large.
    pub left_out: usize,
    /// How many candidates were not timed, for larger clusters were far too slow already.
    pub given_up: usize,
}

impl Found {
    /// What is to be compared: the method as named, and the best where that is another.
    pub fn compared(&self) -> Vec<&PlannedRun> {
        if same(&self.named, &self.best) { vec![&self.named] } else { vec![&self.named, &self.best] }
    }

    /// What is left of it by the times of [`Self::compared`], with those of what is left.
    pub fn settled(self, mut times: Vec<Option<Samples>>) -> (Self, Vec<Option<Samples>>) {
        let value = |times: &Option<Samples>| times.as_ref().map(|samples| samples.measure().value);
        let slower = matches!((times.first().map(value), times.get(1).map(value)), (Some(Some(named)), Some(Some(best))) if best >= named);
        if !slower {
            return (self, times);
        }
        times.truncate(1);
        let settled = Self { best: self.named.clone(), runner_up: Some(self.best), undecided: true, ..self };
        (settled, times)
    }
}

impl fmt::Display for Found {
    /// The winner in a line, before it is timed beside the method as named.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} wins", self.best.name, self.tried)?;
        match &self.runner_up {
            Some(next) if self.undecided => write!(f, ", undecided against {}", next.name),
            _ => Ok(()),
        }
    }
}

impl Problem<'_> {
    /// Searches.
    ///
    /// # Errors
    /// The method as named cannot be played; whatever ends everything.
    pub fn solve(&self, timer: &mut Timer) -> Result<Found> {
        let named = self.named(timer)?;
        let (runs, dropped) = candidates(&named, self.config);
        let mut playable = vec![];
        for run in &runs {
            match timer.prepare(run) {
                Ok(_) => playable.push(run.clone()),
                Err(error) if is_its_own(&error) => tracing::info!("{} is left out: {error}", run.name),
                Err(error) => return Err(error),
            }
        }
        let left_out = dropped + runs.len() - playable.len();
        if !playable.iter().any(|run| same(run, &named)) {
            playable.push(named.clone());
        }
        Candidates { problem: self, named, runs: playable, given_up: 0 }.search(timer, left_out)
    }

    /// The method as named: what an automatic assignment chooses is settled here, once.
    fn named(&self, timer: &mut Timer) -> Result<PlannedRun> {
        let of = |assign| {
            let Config { clusters, bounds, slices, .. } = &self.config;
            let config = Config {
                assign: vec![assign],
                test: vec![Test::Auto],
                clusters: clusters[..1].to_vec(),
                bounds: bounds[..1].to_vec(),
                slices: slices[..1].to_vec(),
                ..self.of.clone()
            };
            planned_runs(&config).remove(0)
        };
        let run = of(Assign::Auto);
        let counted = timer.prepare(&run)?;
        Ok(of(counted.assigner().into()))
    }
}

/// Whether two runs do the same.
fn same(a: &PlannedRun, b: &PlannedRun) -> bool {
    let ways = |run: &PlannedRun| {
        let Config { clusters, bounds, slices, .. } = run.config.clone();
        (run.assign, run.test, clusters, bounds, slices)
    };
    a.method == b.method && (!a.method.assigns() || ways(a) == ways(b))
}

struct Candidates<'c> {
    problem: &'c Problem<'c>,
    named: PlannedRun,
    runs: Vec<PlannedRun>,
    given_up: usize,
}

impl Candidates<'_> {
    fn search(mut self, timer: &mut Timer, left_out: usize) -> Result<Found> {
        let few = halve(self.runs.len(), self.problem.frames.len(), |left, frames| {
            let effort = Effort::part(self.problem.of, self.problem.frames, frames);
            match left.len() == self.runs.len() {
                true => self.first_rung(timer, &effort),
                false => self.scores(timer, left, &effort),
            }
        })?;
        let Decision { best, runner_up, undecided } = self.decision(timer, &few)?;
        let run = |place: usize| self.runs[few[place]].clone();
        Ok(Found {
            best: run(best),
            runner_up: runner_up.map(run),
            undecided,
            tried: self.runs.len(),
            left_out,
            given_up: self.given_up,
            named: self.named,
        })
    }

    /// Scores of all, step by step from large clusters to small ones, so that a chain may end.
    fn first_rung(&mut self, timer: &mut Timer, effort: &Effort) -> Result<Vec<f64>> {
        let (mut scores, mut chains) = (vec![f64::INFINITY; self.runs.len()], Chains::default());
        let all: Vec<usize> = (0..self.runs.len()).collect();
        for step in all.chunk_by(|&a, &b| self.runs[a].method == self.runs[b].method) {
            let open = |number: &usize| chains.is_open(&chain(&self.runs[*number]));
            let tried: Vec<usize> = step.iter().copied().filter(open).collect();
            let found = self.scores(timer, &tried, effort)?;
            self.given_up += step.len() - tried.len();
            tried.iter().zip(&found).for_each(|(&number, &score)| scores[number] = score);
            let of = |(&number, score): (&usize, f64)| (chain(&self.runs[number]), score);
            chains.take(tried.iter().zip(found).map(of).collect());
        }
        Ok(scores)
    }

    /// Scores of some, by the named run as 1.
    fn scores(&self, timer: &mut Timer, some: &[usize], effort: &Effort) -> Result<Vec<f64>> {
        let is_named = |number: usize| same(&self.runs[number], &self.named);
        let others: Vec<&PlannedRun> =
            some.iter().filter(|&&number| !is_named(number)).map(|&number| &self.runs[number]).collect();
        let mut scores = timer.scores(&self.named, &others, effort)?.into_iter();
        let of = |&number: &usize| if is_named(number) { Some(1.0) } else { scores.next() };
        Ok(some.iter().filter_map(of).collect())
    }

    /// Which of the last few is fastest, by all frames.
    fn decision(&self, timer: &mut Timer, few: &[usize]) -> Result<Decision> {
        let alone = Decision { best: 0, runner_up: None, undecided: false };
        if few.len() < 2 {
            return Ok(alone);
        }
        let runs: Vec<&PlannedRun> = few.iter().map(|&number| &self.runs[number]).collect();
        let effort = Effort::whole(self.problem.of, self.problem.frames);
        let times = timer.time(&runs, &effort)?;
        let measured: Vec<_> = times.iter().map(|times| times.as_ref().map(Samples::measure)).collect();
        Ok(decide(&measured).unwrap_or(alone))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_faster_than_the_method_as_named_is_not_the_best() {
        let methods = ["indi-persp-64", "indi-persp-8"].map(|name| name.parse().unwrap());
        let runs = planned_runs(&Config { methods: methods.to_vec(), ..Config::default() });
        let found = || Found {
            named: runs[0].clone(),
            best: runs[1].clone(),
            runner_up: None,
            undecided: false,
            tried: 2,
            left_out: 0,
            given_up: 0,
        };
        let times = |best: f64| [2.0, best].map(|ms| Samples::new(1, vec![vec![ms]])).to_vec();
        let (kept, pair) = found().settled(times(1.0));
        assert_eq!((kept.best.name.as_str(), pair.len(), kept.undecided), ("indi-persp-8", 2, false));
        let (settled, pair) = found().settled(times(3.0));
        assert_eq!((settled.best.name.as_str(), pair.len(), settled.undecided), ("indi-persp-64", 1, true));
        assert_eq!(settled.runner_up.unwrap().name, "indi-persp-8");
    }
}
