//! Patterns with holes: ironwork, leaves, cloth, screens.

use super::super::maths::{fractal, hash, mix, noise, sin_cos, smoothstep};
use super::super::texture::Texel;
use super::{blend, shade};

/// Distance of `(x, y)` from a circle.
fn from_circle(x: f32, y: f32, radius: f32) -> f32 {
    ((x * x + y * y).sqrt() - radius).abs()
}

/// A balcony panel one tile wide: rails, bars, a ring between each pair of bars.
pub(super) fn ironwork(u: f32, v: f32) -> Texel {
    let x = (u * 4.0).fract() - 0.5;
    let bar = 0.5 - x.abs() < 0.075;
    let rail = !(0.05..=0.94).contains(&v) || (v - 0.80).abs() < 0.018;
    let ring = from_circle(x, (v - 0.42) * 2.2, 0.30) < 0.07;
    let small = from_circle(x, (v - 0.87) * 4.0, 0.2) < 0.1;
    let scroll = v < 0.2 && from_circle(x, (v - 0.05) * 3.0, 0.34) < 0.08;
    let iron = bar || rail || ring || small || scroll;
    let rust = fractal(u, v, 16, 3, 301);
    let color = blend([0.07, 0.08, 0.08], [0.16, 0.15, 0.13], rust);
    let texel = Texel::new(color, 0.45 + 0.2 * rust).raised(if iron { 0.02 } else { 0.0 });
    Texel { metal: 0.5, ..texel.covering(if iron { 1.0 } else { 0.0 }) }
}

/// Ellipses thrown over the tile, later ones on top.
pub(super) fn leaves(u: f32, v: f32) -> Texel {
    let mut texel = Texel::new([0.22, 0.34, 0.12], 0.75).covering(0.0);
    for k in 0..26 {
        let random = |salt: u32| hash(k, 17, salt);
        let (dx, dy) = (u - mix(0.14, 0.86, random(1)), v - mix(0.14, 0.86, random(2)));
        if dx * dx + dy * dy > 0.15 * 0.15 {
            continue;
        }
        let (sin, cos) = sin_cos(f64::from(random(3)));
        let (along, across) = (dx * cos + dy * sin, dy * cos - dx * sin);
        let length = mix(0.10, 0.15, random(4));
        let (a, b) = (along / length, across / (length * 0.52));
        if a * a + b.abs() < 1.0 {
            let tone = mix(0.75, 1.25, random(5)) * mix(0.8, 1.0, smoothstep(0.0, 0.15, b.abs()));
            let green = blend([0.20, 0.36, 0.10], [0.42, 0.48, 0.16], random(6));
            texel = Texel::new(shade(green, tone), 0.6).raised(0.02 - 0.02 * b * b);
        }
    }
    texel
}

/// Awning cloth: six stripes, with a scalloped lower edge.
pub(super) fn stripes(u: f32, v: f32) -> Texel {
    let stripe = (u * 6.0).fract();
    let lobe = (stripe - 0.5) * 2.0;
    let hem = 0.10 * lobe * lobe;
    let weave = noise(u * 128.0, v * 128.0, 128, 311);
    let red = ((u * 6.0) as u32).is_multiple_of(2);
    let color = if red { [0.92, 0.92, 0.90] } else { [0.96, 0.90, 0.78] };
    let tone = if red { 0.55 } else { 1.0 };
    Texel::new(shade(color, tone * (0.88 + 0.12 * weave)), 0.9).raised(0.001 * weave).covering(if v < hem {
        0.0
    } else {
        1.0
    })
}

/// A long cloth with a border, a sun, and a frayed hem.
pub(super) fn banner(u: f32, v: f32) -> Texel {
    let fray = 0.03 + 0.05 * noise(u * 24.0, 0.5, 24, 321) + 0.08 * (u - 0.5).abs();
    let (x, y) = (u - 0.5, (v - 0.62) * 2.6);
    let radius = (x * x + y * y).sqrt();
    let gold = radius < 0.17
        || from_circle(x, y, 0.24) < 0.02
        || (u - 0.5).abs() > 0.43 && (u - 0.5).abs() < 0.47
        || (v * 24.0).fract() < 0.3 && v < 0.26 && v > 0.14;
    let weave = fractal(u, v, 64, 2, 322);
    let color = if gold { [0.82, 0.62, 0.22] } else { [0.50, 0.09, 0.08] };
    Texel::new(shade(color, 0.8 + 0.3 * weave), 0.85).raised(0.002 * weave).covering(if v < fray {
        0.0
    } else {
        1.0
    })
}

/// Hanging stems with leaves to both sides; the upper part is denser.
pub(super) fn vines(u: f32, v: f32) -> Texel {
    const STEMS: i32 = 7;
    let mut texel = Texel::new([0.22, 0.32, 0.12], 0.8).covering(0.0);
    for stem in 0..STEMS {
        let end = 0.05 + 0.5 * hash(stem, 1, 331);
        let sway = 0.03 * (noise(v * 6.0, stem as f32, 6, 332) - 0.5);
        let x = u - (stem as f32 + 0.5) / STEMS as f32 - sway;
        if v > end && x.abs() < 0.008 {
            texel = Texel::new([0.26, 0.20, 0.10], 0.9);
        }
        let (step, along) = ((v * 16.0).floor(), (v * 16.0).fract() - 0.5);
        let random = |salt: u32| hash(stem, step as i32, salt);
        let side = mix(0.03, 0.055, random(334)) * if (step as i32 + stem) % 2 == 0 { 1.0 } else { -1.0 };
        let (a, b) =
            ((x - side) / 0.055, (along + mix(-0.15, 0.15, random(335))) / mix(0.3, 0.42, random(336)));
        if v > end && a * a + b * b < 1.0 {
            let tone = mix(0.7, 1.3, random(333));
            texel = Texel::new(shade([0.26, 0.42, 0.14], tone), 0.65).raised(0.012 * (1.0 - a * a));
        }
    }
    texel
}

/// A pierced stone screen of interlocking circles.
pub(super) fn lattice(u: f32, v: f32) -> Texel {
    let (x, y) = ((u * 3.0).fract() - 0.5, (v * 3.0).fract() - 0.5);
    let corner = from_circle(0.5 - x.abs(), 0.5 - y.abs(), 0.42);
    let stone = from_circle(x, y, 0.36) < 0.09 || corner < 0.07 || x.abs() > 0.44 || y.abs() > 0.44;
    let grain = fractal(u, v, 16, 3, 341);
    Texel::new(shade([0.78, 0.70, 0.58], 0.85 + 0.25 * grain), 0.8)
        .raised(if stone { 0.02 } else { 0.0 } + 0.002 * grain)
        .covering(if stone { 1.0 } else { 0.0 })
}
