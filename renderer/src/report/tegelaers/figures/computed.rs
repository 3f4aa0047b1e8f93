//! What follows from formulas: how lights fade (2.12), the white material (3.1), the colours of heat maps (3.5).

use crate::Result;
use crate::output::cubehelix;
use crate::report::chart::{Chart, Key, Look, Plot, Series};
use crate::report::computed::picture;
use crate::report::figure::Figure;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Points a curve.
const POINTS: u32 = 241;
/// Where the lights of the curves end, and how far these are drawn, metres.
const RADIUS: f64 = 4.0;
const FARTHEST: f64 = 5.0;
/// Lights of the picture, their circle, height above the plane and radius, in halves of its height.
const LIGHTS: u32 = 12;
const CIRCLE: f64 = 0.62;
const ABOVE: f64 = 0.12;
const REACH: f64 = 0.6;
/// What the material shows without light, and how much lights add to it (section 3.1.3).
const AMBIENT: f64 = 0.1;
const LIT: f64 = 0.9;

/// All three.
///
/// # Errors
/// A picture cannot be encoded.
pub fn figures() -> Result<[Figure; 3]> {
    Ok([attenuation(), material()?, colors()?])
}

/// How a light of radius r fades: clamp(1 - d/r, 0, 1)^2. Section 2.4.5 of the thesis drops the difference and the formula of
/// section 3.1.3 the square; the listing of the shader has both.
fn fading(distance: f64, radius: f64) -> f64 {
    (1.0 - distance / radius).clamp(0.0, 1.0).powi(2)
}

/// A curve: what it is called, its colour, its value at a distance in metres.
type Curve = (&'static str, &'static str, fn(f64) -> f64);

const CURVES: [Curve; 3] = [
    ("1/(1 + d²)", "black", |d| 1.0 / (1.0 + d * d)),
    ("(1 - d/r)²", "blue", |d| fading(d, RADIUS)),
    ("(1 - d²/r²)²", "vermillion", |d| (1.0 - (d / RADIUS).powi(2)).max(0.0).powi(2)),
];

fn attenuation() -> Figure {
    let at = |point: u32| FARTHEST * f64::from(point) / f64::from(POINTS - 1);
    let series = CURVES.map(|(name, color, value)| Series {
        name: name.into(),
        look: Look::plain(color),
        points: (0..POINTS).map(at).map(|distance| [distance, value(distance)]).collect(),
    });
    Figure {
        id: "T2.12".into(),
        title: "How lights fade".into(),
        caption: format!(
            "Computed, not measured: a light fades by the square of the distance without ever ending, or so that it ends at its radius, \
             here r = {RADIUS} m. The thesis measures with the second, `attenuation tegelaers`."
        ),
        setting: String::new(),
        chart: Some(Chart {
            names: ["", "", "function", "distance"],
            columns: vec![String::new()],
            rows: vec![String::new()],
            x_label: "distance from the light (m)".into(),
            legend: series.iter().map(|s| Key { label: s.name.clone(), look: s.look }).collect(),
            panels: vec![Some(Plot::Lines(series.into()))],
            ..Chart::default()
        }),
    }
}

fn material() -> Result<Figure> {
    let alt = "A white plane under twelve lights of saturated hues";
    let plane = picture([480, 320], alt, |at| lit(DVec2::new(3.0 * at.x - 1.5, 1.0 - 2.0 * at.y)))?;
    Ok(pictured(
        ("T3.1", "The white material"),
        format!(
            "Computed, not measured: {AMBIENT} + {LIT} Σ tint max(0, n·l) f, with f the second of the curves above, on a plane under \
             {LIGHTS} lights of saturated hues."
        ),
        plane,
    ))
}

/// Display colour of the plane at a place.
fn lit(at: DVec2) -> DVec3 {
    let light = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(LIGHTS)).sin_cos();
        let to_light = (CIRCLE * DVec2::new(cos, sin) - at).extend(ABOVE);
        let distance = to_light.length();
        hue(f64::from(k) / f64::from(LIGHTS)) * (to_light.z / distance) * fading(distance, REACH)
    };
    AMBIENT + LIT * (0..LIGHTS).map(light).sum::<DVec3>()
}

/// A fully saturated colour; the hue is a part of the whole turn from red over green and blue.
fn hue(turn: f64) -> DVec3 {
    let channel = |shift: f64| (2.0 - 6.0 * ((turn + shift).rem_euclid(1.0) - 0.5).abs()).clamp(0.0, 1.0);
    DVec3::new(1.0 - channel(0.0), channel(1.0 / 6.0), channel(-1.0 / 6.0))
}

fn colors() -> Result<Figure> {
    let bar = picture([480, 32], "Colours from black over blue, green and red to white", |at| {
        DVec3::from_array(cubehelix(at.x).map(|byte| f64::from(byte) / 255.0))
    })?;
    Ok(pictured(
        ("T3.5", "The colours of heat maps"),
        "Computed, not measured: cubehelix (Green 2011; start 0.5, rotations -1.5, hue 1, gamma 1), which rises in lightness from \
         none on the left to all on the right."
            .into(),
        bar,
    ))
}

fn pictured((id, title): (&str, &str), caption: String, picture: Plot) -> Figure {
    let chart = Chart {
        names: ["", "", "picture", "number"],
        columns: vec![String::new()],
        rows: vec![String::new()],
        panels: vec![Some(picture)],
        ..Chart::default()
    };
    Figure { id: id.into(), title: title.into(), caption, setting: String::new(), chart: Some(chart) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_fade_as_the_listing_has_it() {
        let values = [0.0, 1.0, 2.0, 4.0, 9.0].map(|distance| fading(distance, RADIUS));
        assert_eq!(values, [1.0, 0.5625, 0.25, 0.0, 0.0]);
        let at_half = CURVES.map(|(_, _, value)| value(2.0));
        assert_eq!(at_half, [0.2, 0.25, 0.5625]);
    }

    #[test]
    fn the_material_is_dim_without_light_and_its_hues_are_saturated() {
        assert_eq!(lit(DVec2::splat(9.0)), DVec3::splat(AMBIENT));
        // Right below the first light, which is red.
        let below = lit(DVec2::new(CIRCLE, 0.0));
        assert!(below.x > 0.6 && below.x > below.y + 0.2, "{below}");
        for (turn, color) in
            [(0.0, [1.0, 0.0, 0.0]), (1.0 / 3.0, [0.0, 1.0, 0.0]), (2.0 / 3.0, [0.0, 0.0, 1.0])]
        {
            assert!(hue(turn).abs_diff_eq(DVec3::from_array(color), 1e-9), "{turn}: {}", hue(turn));
        }
        assert!(hue(1.0 / 6.0).abs_diff_eq(DVec3::new(1.0, 1.0, 0.0), 1e-9), "yellow: {}", hue(1.0 / 6.0));
    }
}
