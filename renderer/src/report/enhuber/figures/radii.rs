//! How the radii of lights are distributed (4.1).

use crate::Result;
use crate::lights::{Corners, GammaLights, GammaRadii, GammaRecipe, LightMotion, LightSource, Lighting};
use crate::report::chart::{Chart, Key, Look, Plot, Series};
use crate::report::figure::Figure;

/// Drawn to this radius, metres.
const FARTHEST: f64 = 5.0;
/// Points of the curve.
const POINTS: u32 = 251;
/// Radii that are counted together, metres.
const BIN: f64 = 0.25;
/// Lights whose radii are counted.
const LIGHTS: u32 = 10_000;

/// The density that the thesis chooses, and what of it the program's lights have.
///
/// # Errors
/// Lights cannot be made.
pub fn figure() -> Result<Figure> {
    let radii = GammaRadii::default();
    let curve = Look::plain("blue");
    let dots = Look { dots: true, ..Look::plain("vermillion") };
    let named = [("density", curve, density_curve(&radii)), ("10 000 lights made", dots, counted(radii)?)];
    let legend = named.iter().map(|(label, look, _)| Key { label: (*label).into(), look: *look }).collect();
    let series = named.map(|(name, look, points)| Series { name: name.into(), look, points });
    Ok(Figure {
        id: "E4.1".into(),
        title: "Density of the lights' radii".into(),
        caption: format!(
            "Computed, not measured: the gamma distribution with the most frequent radius {} m and the mean {} m (shape {:.4}, \
             scale {} m); and the radii of 10 000 lights as the program makes them with the seed 1, counted in steps of {BIN} m.",
            radii.mode,
            radii.mean,
            radii.shape(),
            radii.scale()
        ),
        setting: String::new(),
        chart: Some(Chart {
            names: ["", "", "series", "radius"],
            columns: vec![String::new()],
            rows: vec![String::new()],
            x_label: "radius (m)".into(),
            panels: vec![Some(Plot::Lines(series.to_vec()))],
            legend,
            ..Chart::default()
        }),
    })
}

fn density_curve(radii: &GammaRadii) -> Vec<[f64; 2]> {
    let radius = |point: u32| FARTHEST * f64::from(point) / f64::from(POINTS - 1);
    (0..POINTS).map(radius).map(|radius| [radius, density(radii, radius)]).collect()
}

/// The distribution's density at a radius, one a metre (Enhuber equation 4.1).
fn density(radii: &GammaRadii, radius: f64) -> f64 {
    let (shape, scale) = (radii.shape(), radii.scale());
    radius.powf(shape - 1.0) * (-radius / scale).exp() / (libm::tgamma(shape) * scale.powf(shape))
}

/// The share of the made lights in each step, over its length.
fn counted(radii: GammaRadii) -> Result<Vec<[f64; 2]>> {
    let recipe = GammaRecipe { seed: 1, radii, motion: LightMotion::Static, moving: 1.0 };
    let within = Corners { min: [0.0; 3], max: [1.0; 3] };
    let mut lights = GammaLights::new(&recipe, &Lighting::with_count(LIGHTS), within, 0.0)?;
    let mut bins = vec![0_u32; (FARTHEST / BIN) as usize];
    for light in lights.at_frame(0).list {
        if let Some(bin) = bins.get_mut((f64::from(light.r1) / BIN) as usize) {
            *bin += 1;
        }
    }
    let share = |count: u32| f64::from(count) / f64::from(LIGHTS) / BIN;
    let middle = |bin: usize| (bin as f64 + 0.5) * BIN;
    Ok(bins.into_iter().enumerate().map(|(bin, count)| [middle(bin), share(count)]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_density_is_one_in_all_and_greatest_at_the_mode() {
        let radii = GammaRadii::default();
        let step = 1e-3;
        let at = |k: u32| (f64::from(k) + 0.5) * step;
        let whole: f64 = (0..40_000).map(|k| step * density(&radii, at(k))).sum();
        let mean: f64 = (0..40_000).map(|k| step * at(k) * density(&radii, at(k))).sum();
        assert!((whole - 1.0).abs() < 1e-4 && (mean - 1.0).abs() < 1e-4, "{whole} {mean}");
        let most = (1..5000).max_by(|a, b| density(&radii, at(*a)).total_cmp(&density(&radii, at(*b))));
        assert!((at(most.unwrap()) - 0.25).abs() < 2.0 * step);
    }

    #[test]
    fn lights_that_are_made_follow_the_density() {
        let radii = GammaRadii::default();
        for [radius, share] in counted(radii).unwrap() {
            // The mean of the density over a step; a share of 10 000 lights is known to 2 % of a light a metre.
            let parts = 100_u32;
            let within = |part: u32| radius + BIN * ((f64::from(part) + 0.5) / f64::from(parts) - 0.5);
            let expected =
                (0..parts).map(|part| density(&radii, within(part))).sum::<f64>() / f64::from(parts);
            assert!((share - expected).abs() < 0.06, "{radius} m: {share}, expected {expected}");
        }
    }
}
