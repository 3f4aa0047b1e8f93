//! Patterns without pieces: coats, glass, bark, cloth, water, fire.

use super::super::maths::{fractal, hash, mix, smoothstep};
use super::super::texture::Texel;
use super::{blend, shade};

pub(super) fn plaster(u: f32, v: f32) -> Texel {
    let (broad, fine) = (fractal(u, v, 4, 4, 101), fractal(u, v, 48, 3, 102));
    let tone = 0.84 + 0.16 * broad + 0.08 * (fine - 0.5);
    Texel::new(shade([0.93, 0.90, 0.84], tone), 0.85).raised(0.002 * fine + 0.002 * broad)
}

/// Metal as far as the material's factor says so.
pub(super) fn coat(u: f32, v: f32) -> Texel {
    let wear = fractal(u, v, 8, 4, 111);
    let tone = 0.86 + 0.14 * wear;
    Texel { metal: 1.0, ..Texel::new([tone; 3], 0.38 + 0.3 * wear).raised(0.0015 * wear) }
}

pub(super) fn bark(u: f32, v: f32) -> Texel {
    let ridges = fractal(u, v * 0.25, 24, 3, 121);
    let patches = fractal(u, v, 5, 3, 122);
    let color = blend([0.30, 0.24, 0.18], [0.55, 0.50, 0.40], 0.6 * ridges + 0.4 * patches);
    Texel::new(color, 0.92).raised(0.03 * ridges)
}

/// Painted frame with two rows of panes; the panes let most light through.
pub(super) fn casement(u: f32, v: f32) -> Texel {
    let beside = |x: f32, lines: &[f32], half: f32| lines.iter().any(|line| (x - line).abs() < half);
    let frame = beside(u, &[0.0, 1.0], 0.06)
        || beside(u, &[0.5], 0.045)
        || beside(v, &[0.0, 1.0], 0.04)
        || beside(v, &[0.33, 0.66], 0.014);
    if frame {
        return Texel::new([0.90, 0.89, 0.85], 0.55).raised(0.012);
    }
    let streak = fractal(u, v, 6, 3, 131);
    Texel::new([0.52 + 0.1 * streak, 0.60 + 0.08 * streak, 0.64], 0.06).covering(0.22 + 0.12 * streak)
}

pub(super) fn curtain(u: f32, v: f32) -> Texel {
    let fold = fractal(u, 0.5, 10, 3, 141);
    let tie = smoothstep(0.25, 0.5, (u - 0.5).abs());
    let light = mix(1.0, 0.35 + 0.5 * fold, tie) * (0.75 + 0.25 * v);
    let texel = Texel::new(shade([1.0, 0.78, 0.46], light), 0.9).raised(0.02 * fold);
    Texel { glow: 0.9, ..texel }
}

/// Rows of square glyphs, each a random symmetric set of strokes, as a sign from a distance.
pub(super) fn letters(u: f32, v: f32) -> Texel {
    const GLYPHS: f32 = 8.0;
    let board = Texel::new([0.12, 0.10, 0.09], 0.5);
    let (column, x) = ((u * GLYPHS).floor(), (u * GLYPHS).fract());
    let inside = (0.18..0.82).contains(&x) && (0.22..0.78).contains(&v);
    let cell = |value: f32, low: f32| ((value - low) / (1.0 - 2.0 * low) * 5.0) as i32;
    let (i, j) = (cell(x, 0.18), cell(v, 0.22));
    let mirrored = (i - 2).abs();
    let upright = mirrored == 2 && hash(column as i32, 0, 151) > 0.2;
    let bar = (j == 0 || j == 2 || j == 4) && hash(column as i32, j, 152) > 0.35;
    let stem = mirrored == 0 && hash(column as i32, 9, 153) > 0.6;
    if !(inside && (upright || bar || stem)) {
        return Texel { glow: 0.02, ..board };
    }
    Texel { glow: 1.0, ..Texel::new([1.0, 0.82, 0.52], 0.5).raised(0.01) }
}

pub(super) fn clear(u: f32, v: f32) -> Texel {
    let streak = fractal(u, v, 6, 2, 161);
    Texel::new([0.86, 0.92, 0.92], 0.04 + 0.05 * streak).covering(0.16 + 0.1 * streak)
}

pub(super) fn lamp(u: f32, v: f32) -> Texel {
    let milk = fractal(u, v, 6, 3, 171);
    Texel { glow: 0.8 + 0.2 * milk, ..Texel::new([1.0, 0.88, 0.66], 0.3) }
}

pub(super) fn marble(u: f32, v: f32) -> Texel {
    let warp = fractal(u, v, 4, 4, 181);
    let bands = (u + v) * 4.0 + warp * 3.0;
    let wave = (bands - bands.floor() - 0.5).abs() * 2.0;
    let vein = 1.0 - smoothstep(0.0, 0.16, wave);
    let cloud = fractal(u, v, 6, 4, 185);
    let color = blend([0.78, 0.72, 0.62], [0.90, 0.86, 0.78], cloud);
    Texel::new(blend(color, [0.56, 0.48, 0.40], 0.55 * vein), 0.34 + 0.22 * cloud).raised(0.0015 * cloud)
}

pub(super) fn water(u: f32, v: f32) -> Texel {
    let ripple = fractal(u, v, 6, 4, 191);
    let color = blend([0.05, 0.22, 0.26], [0.16, 0.42, 0.44], ripple);
    Texel::new(color, 0.05).raised(0.03 * ripple).covering(0.6 + 0.15 * ripple)
}

pub(super) fn embers(u: f32, v: f32) -> Texel {
    let heat = smoothstep(0.35, 0.75, fractal(u, v, 8, 4, 201));
    let color = blend([0.20, 0.05, 0.02], [1.0, 0.72, 0.26], heat);
    Texel { glow: 0.25 + 0.75 * heat, ..Texel::new(color, 0.9).raised(0.02 * heat) }
}

pub(super) fn meadow(u: f32, v: f32) -> Texel {
    let (patch, blades) = (fractal(u, v, 4, 4, 211), fractal(u, v, 64, 2, 212));
    let grass = blend([0.18, 0.26, 0.10], [0.38, 0.44, 0.20], blades);
    let earth = blend([0.40, 0.33, 0.24], [0.56, 0.50, 0.40], blades);
    let bare = 0.55 * smoothstep(0.45, 0.75, patch);
    Texel::new(blend(grass, earth, bare), 0.95).raised(0.01 * blades + 0.01 * patch)
}

pub(super) fn porcelain(u: f32, v: f32) -> Texel {
    let (swirl, ink) = (fractal(u, v, 6, 3, 441), fractal(u, v, 12, 3, 445));
    let figure = smoothstep(0.0, 0.04, (swirl - 0.5).abs() - 0.035);
    let color = blend([0.12, 0.20, 0.48], [0.90, 0.90, 0.86], figure);
    Texel::new(shade(color, 0.92 + 0.12 * ink), 0.12 + 0.08 * ink)
}
