//! Whether timestamps mean anything: a stage's time grows with its own work alone, and the device's clock runs as the
//! host's does.

use super::cases::{PERSP, frustum_grid, rain, random_bits};
use super::{Context, Verdict};
use crate::Result;
use crate::buffers::BufferName;
use crate::config::{Assign, Test};
use crate::engine::workbench::{Case, Workbench, given};
use crate::measure::Capacities;
use crate::passes::{Eyes, assign, cull, depth, probes};
use std::fmt;
use std::time::Instant;

/// How often each is timed; the least time counts.
const REPEATS: u32 = 4;

/// How often as long a stage takes for ten times its work: a fixed part does not grow, and machines have other work.
const OWN: std::ops::Range<f64> = 4.0..40.0;
/// How often as long a stage takes beside a heavier one.
const BESIDE: std::ops::Range<f64> = 0.0..3.0;

/// How the times of two stages grew, one of compute and one of rasterisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// By ten times the stage's own work: compute, raster.
    pub own: [f64; 2],
    /// By ten times the other's.
    pub beside: [f64; 2],
}

impl Growth {
    /// The stage that grew otherwise than its work, if one did. Times are of a machine with other work.
    pub fn fault(&self) -> Option<String> {
        ["compute", "raster"].into_iter().zip(self.own.iter().zip(&self.beside)).find_map(
            |(stage, (&own, &beside))| {
                if !OWN.contains(&own) {
                    return Some(format!(
                        "stage {stage} takes {own:.1} times as long for ten times its work"
                    ));
                }
                (!BESIDE.contains(&beside))
                    .then(|| format!("stage {stage} takes {beside:.1} times as long beside a heavier one"))
            },
        )
    }
}

impl fmt::Display for Growth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { own: [compute, raster], beside: [compute_beside, raster_beside] } = self;
        write!(
            f,
            "ten times the work takes {compute:.1} (compute) and {raster:.1} times (raster) as long, {compute_beside:.1} \
             and {raster_beside:.1} times beside the other's"
        )
    }
}

fn capacities() -> Capacities {
    Capacities { visible_clusters: 40_000, light_indices: 16, ..Capacities::default() }
}

/// The times of stages grow with their own work.
pub fn bracket(context: &mut Context) -> Result<Verdict> {
    Ok(match busy(context)? {
        None => no_timestamps(),
        Some(bench) => {
            let growth = tenfold(bench)?;
            Verdict::of(growth.fault(), || growth.to_string())
        }
    })
}

fn no_timestamps() -> Verdict {
    Verdict::Wrong("the device has no timestamps on its queue: nothing can be timed, only counted".into())
}

/// A workbench with work on it; `None` where the device has no timestamps.
fn busy(context: &mut Context) -> Result<Option<&mut Workbench>> {
    let (lights, grid) = (rain(1000)?, frustum_grid([32, 32, 32]));
    let case = Case { method: PERSP, grid, lights: &lights, capacities: capacities() };
    let bench = context.bench((Assign::Brute, Test::Auto), case)?;
    if bench.session.context.require_timestamps().is_err() {
        return Ok(None);
    }
    bench.compact(&random_bits(grid.cluster_count(), 1, 3))?;
    Ok(Some(bench))
}

/// Makes each of two stages ten times as heavy, on a workbench with many visible clusters.
///
/// # Errors
/// Whatever fails on the device.
pub fn tenfold(bench: &mut Workbench) -> Result<Growth> {
    let [compute, raster] = staged_times(bench, 1, 1)?;
    let [heavy_compute, light_raster] = staged_times(bench, 10, 1)?;
    let [light_compute, heavy_raster] = staged_times(bench, 1, 10)?;
    Ok(Growth {
        own: [heavy_compute / compute, heavy_raster / raster],
        beside: [light_compute / compute, light_raster / raster],
    })
}

/// Turns of the loop that is a stage's compute, and threads that make them.
const TURNS: u32 = 60_000;
const THREADS: u32 = 64 * 256;

/// Two stages of known work, first one of rasterisation, then one of compute, which waits for nothing that the first does;
/// each repeated as often as said. Milliseconds.
fn staged_times(bench: &mut Workbench, compute: u32, raster: u32) -> Result<[f64; 2]> {
    let probe = bench.session.store.probe(&bench.variant, "selftest/loop.comp")?;
    bench.engine.bind(&bench.session, std::slice::from_ref(&probe))?;
    bench.upload(BufferName::Measurements, &[TURNS, 0, 0])?;
    let mut best = [f64::INFINITY; 2];
    for _ in 0..REPEATS {
        bench.run(|r, frame| {
            r.scope("frame", |r| {
                cull::record(r, frame);
                r.scope("raster", |r| {
                    for _ in 0..raster {
                        depth::record(r, frame, Eyes::One(0));
                    }
                });
                r.scope("compute", |r| {
                    (0..compute).for_each(|_| probes::compute(r, frame, &probe, THREADS));
                });
            });
        })?;
        let times = bench.stage_times()?;
        for (stage, best) in ["frame/compute", "frame/raster"].iter().zip(&mut best) {
            let time = times.iter().find(|(path, _)| path == stage).map_or(f64::NAN, |(_, ms)| *ms);
            *best = best.min(time);
        }
    }
    Ok(best)
}

/// What the host must wait before its clock is compared, milliseconds: much more than it takes to submit.
const LONG_ENOUGH: f64 = 30.0;
/// Work is doubled so often, at most.
const DOUBLINGS: u32 = 12;
/// Parts of the host's time that the device's may be: submitting takes the rest, and clocks differ a little.
const CLOCK: std::ops::Range<f64> = 0.7..1.02;

/// A long stage takes as long by timestamps as by the host's clock.
pub fn clock(context: &mut Context) -> Result<Verdict> {
    let Some(bench) = busy(context)? else { return Ok(no_timestamps()) };
    let mut work = 1;
    for _ in 0..DOUBLINGS {
        let (wall, _) = walled(bench, work)?;
        if wall > LONG_ENOUGH {
            break;
        }
        work *= 2;
    }
    let mut nearest = (f64::NAN, f64::NAN);
    for _ in 0..REPEATS {
        let (wall, gpu) = walled(bench, work)?;
        let apart = |(wall, gpu): (f64, f64)| (gpu / wall - 1.0).abs();
        if nearest.0.is_nan() || apart((wall, gpu)) < apart(nearest) {
            nearest = (wall, gpu);
        }
    }
    let (wall, gpu) = nearest;
    let found = format!("{gpu:.2} ms by timestamps, {wall:.2} ms by the host's clock");
    Ok(if CLOCK.contains(&(gpu / wall)) { Verdict::Fine(found) } else { Verdict::Wrong(found) })
}

/// Milliseconds that the host waits for so much work, and that timestamps say.
fn walled(bench: &mut Workbench, work: u32) -> Result<(f64, f64)> {
    let start = Instant::now();
    bench.run(|r, frame| {
        r.scope("work", |r| (0..work).for_each(|_| assign::count_lights(r, frame, given())));
    })?;
    let wall = start.elapsed().as_secs_f64() * 1e3;
    let gpu = bench.stage_times()?.first().map_or(f64::NAN, |(_, ms)| *ms);
    Ok((wall, gpu))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stage_that_does_not_grow_with_its_work_is_named() {
        let fine = Growth { own: [9.0, 8.0], beside: [1.0, 1.2] };
        assert_eq!(fine.fault(), None);
        let fault = |growth: Growth| growth.fault().unwrap_or_default();
        assert!(fault(Growth { own: [9.0, 1.0], ..fine }).contains("raster takes 1.0 times"));
        assert!(fault(Growth { own: [f64::NAN, 8.0], ..fine }).contains("compute takes NaN"));
        assert!(
            fault(Growth { beside: [9.0, 1.0], ..fine }).contains("compute takes 9.0 times as long beside")
        );
    }
}
