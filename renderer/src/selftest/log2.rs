//! Rounding of logarithms as the device makes them: coordinates along z against f64, in parts of what slices allow.

use super::cases::{ORTIZ, PERSP, frustum_grid, rain};
use super::{Context, Verdict};
use crate::Result;
use crate::buffers::BufferName;
use crate::config::{Assign, Test};
use crate::engine::workbench::Case;
use crate::measure::Capacities;
use crate::methods::Method;
use crate::passes::probes;

/// How many depths are tried.
const COUNT: u32 = 1024;

/// No coordinate is farther off than slices allow, by either way to find it.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let mut worst = 0.0_f64;
    for method in [PERSP, ORTIZ] {
        // What is no number is farther off than anything.
        let part = farthest(context, method)?;
        worst = if part.is_nan() { f64::INFINITY } else { worst.max(part) };
    }
    let found = format!("coordinates are off by {worst:.2} of what slices allow, at most");
    Ok(if worst <= 1.0 { Verdict::Fine(found) } else { Verdict::Wrong(found) })
}

/// How far off the farthest coordinate is, in parts of what is allowed; NaN where one is no number.
fn farthest(context: &mut Context, method: Method) -> Result<f64> {
    let lights = rain(1)?;
    let capacities = Capacities { visible_clusters: 16, light_indices: 16, ..Capacities::default() };
    let case = Case { method, grid: frustum_grid([2, 2, 60]), lights: &lights, capacities };
    let bench = context.bench((Assign::Brute, Test::Auto), case)?;
    let probe = bench.session.store.probe(&bench.variant, "selftest/log2.comp")?;
    bench.engine.bind(&bench.session, std::slice::from_ref(&probe))?;
    bench.upload(BufferName::Measurements, &depths().map(f32::to_bits).collect::<Vec<_>>())?;
    bench.run(|r, frame| probes::compute(r, frame, &probe, COUNT))?;
    let words = bench.download(BufferName::Measurements, 3 * COUNT as usize + 2)?;
    let floats: Vec<f64> = words.iter().map(|&word| f64::from(f32::from_bits(word))).collect();
    let (depths, rest) = floats.split_at(COUNT as usize);
    let (coordinates, rest) = rest.split_at(COUNT as usize);
    let (allowances, grid) = rest.split_at(COUNT as usize);
    let parts = depths.iter().zip(coordinates).zip(allowances).map(|((depth, coordinate), allowance)| {
        let exact = (depth / grid[0]).log2() * grid[1];
        (coordinate - exact).abs() / allowance
    });
    Ok(parts.fold(0.0, |worst: f64, part| if part.is_nan() { f64::NAN } else { worst.max(part) }))
}

/// Depths from the near to the far plane, metres; some on and beside powers of two of the near distance, where logarithms
/// change their exponent.
fn depths() -> impl Iterator<Item = f32> {
    (0..COUNT).map(|i| match i % 4 {
        0 => 0.4 * f32::powi(2.0, (i / 4 % 8) as i32),
        1 => (0.4 * f32::powi(2.0, (i / 4 % 8) as i32)).next_down().max(0.4),
        _ => 0.4 * 250f32.powf((i as f32 * 0.618_034).fract()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_lie_between_the_planes() {
        assert!(depths().all(|depth| (0.4..100.01).contains(&depth)));
        assert_eq!(depths().count(), COUNT as usize);
    }
}
