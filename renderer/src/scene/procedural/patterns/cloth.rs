//! Woven cloths.

use super::super::maths::{fractal, mix, noise, sin_cos, smoothstep};
use super::super::texture::Texel;
use super::shade;

/// A grey weave, to be dyed by a surface's colour, with lozenges of four petals in a smoother thread.
pub(super) fn damask(u: f32, v: f32) -> Texel {
    let weave = noise(u * 128.0, v * 128.0, 128, 421);
    let petal = |u: f32, v: f32| {
        let (x, y) = (u - u.floor() - 0.5, v - v.floor() - 0.5);
        let radius = (x * x + y * y).sqrt();
        let (along, across) = if x * x > y * y { (x.abs(), y.abs()) } else { (y.abs(), x.abs()) };
        let (lobe, _) = sin_cos(f64::from((along * 2.2).min(0.5)));
        smoothstep(0.0, 0.03, 0.16 * lobe - across).max(1.0 - smoothstep(0.02, 0.05, (radius - 0.44).abs()))
    };
    let figure = petal(2.0 * u, 2.0 * v).max(petal(2.0 * u + 0.5, 2.0 * v + 0.5) * 0.6);
    let tone = mix(0.72, 1.0, figure) * (0.86 + 0.2 * weave);
    Texel::new([tone; 3], mix(0.88, 0.5, figure)).raised(0.0015 * weave + 0.001 * figure)
}

/// White threads, denser in stripes along v.
pub(super) fn gauze(u: f32, v: f32) -> Texel {
    let weave = noise(u * 128.0, v * 128.0, 128, 431);
    let (wave, _) = sin_cos(f64::from(6.0 * v));
    let dense = smoothstep(0.5, 0.9, wave);
    let cloud = fractal(u, v, 6, 3, 432);
    Texel::new(shade([0.96, 0.93, 0.86], 0.88 + 0.14 * weave), 0.85)
        .raised(0.001 * weave)
        .covering(mix(0.30, 0.62, dense) + 0.12 * (cloud - 0.5))
}
