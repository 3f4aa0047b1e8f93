//! Patterns made of pieces: stones, bricks, sheets, planks, tesserae.

use super::super::maths::{fractal, hash, mix, smoothstep};
use super::super::texture::Texel;
use super::{blend, shade};

/// One piece of a running bond: its number and the distance to its nearest edge.
struct Piece {
    column: i32,
    row: i32,
    /// Distance to the nearest edge, in tile sides.
    edge: f32,
    /// Position inside the piece, 0..1.
    inside: [f32; 2],
}

/// Cuts the tile into `rows` courses of `columns` pieces, every other course moved by `shift` of a piece.
fn bond([u, v]: [f32; 2], [columns, rows]: [i32; 2], shift: f32) -> Piece {
    let row = (v * rows as f32).floor();
    let moved = u * columns as f32 + if row as i32 % 2 == 0 { 0.0 } else { shift };
    let column = moved.floor();
    let inside = [moved - column, v * rows as f32 - row];
    let gap = |inside: f32, count: i32| inside.min(1.0 - inside) / count as f32;
    Piece {
        column: (column as i32).rem_euclid(columns),
        row: row as i32,
        edge: gap(inside[0], columns).min(gap(inside[1], rows)),
        inside,
    }
}

impl Piece {
    fn random(&self, seed: u32) -> f32 {
        hash(self.column, self.row, seed)
    }
}

/// Stones of `bond` with joints `joint` wide: colour by piece and grain, rounded edges.
fn stones(piece: &Piece, joint: f32, [stone, mortar]: [[f32; 3]; 2], grain: f32) -> Texel {
    let body = smoothstep(joint * 0.5, joint * 1.6, piece.edge);
    let tone = 0.86 + 0.2 * piece.random(3) + 0.22 * (grain - 0.5);
    let color = blend(shade(mortar, 0.9 + 0.2 * grain), shade(stone, tone), body);
    Texel::new(color, mix(0.95, 0.72, body)).raised(body * joint * 0.6 + grain * joint * 0.25)
}

pub(super) fn setts(u: f32, v: f32) -> Texel {
    let grain = fractal(u, v, 16, 4, 11);
    let piece = bond([u, v], [10, 14], 0.5);
    let warm = blend([0.36, 0.36, 0.38], [0.44, 0.40, 0.36], piece.random(5));
    let texel = stones(&piece, 0.011, [warm, [0.19, 0.18, 0.16]], grain);
    Texel { roughness: texel.roughness - 0.18 * piece.random(9), ..texel }
}

pub(super) fn paving(u: f32, v: f32) -> Texel {
    let grain = fractal(u, v, 24, 4, 21);
    stones(&bond([u, v], [3, 4], 0.5), 0.006, [[0.60, 0.58, 0.54], [0.33, 0.31, 0.29]], grain)
}

pub(super) fn ashlar(u: f32, v: f32) -> Texel {
    let grain = fractal(u, v, 12, 5, 31);
    let streaks = fractal(u, v * 0.25 + 0.1, 16, 3, 37);
    let texel = stones(&bond([u, v], [3, 7], 0.5), 0.0045, [[0.82, 0.76, 0.64], [0.58, 0.52, 0.43]], grain);
    Texel { color: shade(texel.color, 0.9 + 0.12 * streaks), ..texel }
}

pub(super) fn brick(u: f32, v: f32) -> Texel {
    let grain = fractal(u, v, 32, 3, 41);
    let piece = bond([u, v], [6, 18], 0.5);
    let clay = blend([0.55, 0.29, 0.20], [0.66, 0.41, 0.29], piece.random(2));
    stones(&piece, 0.007, [clay, [0.62, 0.58, 0.52]], grain)
}

pub(super) fn glazed(u: f32, v: f32) -> Texel {
    let grain = fractal(u, v, 24, 3, 47);
    let piece = bond([u, v], [6, 16], 0.5);
    let blue = blend([0.10, 0.24, 0.56], [0.16, 0.47, 0.66], piece.random(13));
    let golden = piece.row == 7 && piece.column % 2 == 0;
    let glaze = if golden { [0.85, 0.62, 0.22] } else { blue };
    let texel = stones(&piece, 0.006, [glaze, [0.30, 0.27, 0.24]], grain);
    Texel { roughness: texel.roughness - 0.42 * (1.0 - 0.5 * grain), ..texel }
}

pub(super) fn zinc(u: f32, v: f32) -> Texel {
    let piece = bond([u, v], [4, 1], 0.0);
    let seam = 1.0 - smoothstep(0.0, 0.016, piece.inside[0].min(1.0 - piece.inside[0]) / 4.0);
    let weather = fractal(u, v, 6, 5, 51);
    let color = blend([0.44, 0.48, 0.53], [0.58, 0.61, 0.63], weather);
    let texel = Texel::new(shade(color, 1.0 - 0.15 * seam), 0.42 + 0.25 * weather).raised(seam * 0.012);
    Texel { metal: 0.65, ..texel }
}

pub(super) fn scales(u: f32, v: f32) -> Texel {
    let piece = bond([u, v], [8, 12], 0.5);
    let lap = 1.0 - piece.inside[1];
    let tone = 0.75 + 0.4 * piece.random(6) - 0.35 * smoothstep(0.82, 1.0, piece.inside[1]);
    let gap = smoothstep(0.0, 0.006, piece.inside[0].min(1.0 - piece.inside[0]) / 8.0);
    let grain = fractal(u, v, 32, 3, 61);
    let color = shade([0.62, 0.62, 0.64], tone * mix(0.6, 1.0, gap) * (0.85 + 0.3 * grain));
    Texel::new(color, 0.55 + 0.2 * grain).raised(0.02 * lap * gap)
}

pub(super) fn planks(u: f32, v: f32) -> Texel {
    let piece = bond([u, v], [6, 1], 0.0);
    let gap = smoothstep(0.0, 0.008, piece.inside[0].min(1.0 - piece.inside[0]) / 6.0);
    let fibre = fractal(u * 4.0 % 1.0, v, 16, 4, 71 + piece.column as u32);
    let color = blend([0.36, 0.22, 0.12], [0.58, 0.40, 0.24], fibre);
    let tone = mix(0.45, 0.85 + 0.3 * piece.random(8), gap);
    Texel::new(shade(color, tone), 0.62 + 0.2 * fibre).raised(0.006 * gap + 0.003 * fibre)
}

pub(super) fn mosaic(u: f32, v: f32) -> Texel {
    let piece = bond([u, v], [36, 36], 0.0);
    let centre = |k: i32| (k as f32 + 0.5) / 36.0 - 0.5;
    let (x, y) = (centre(piece.column), centre(piece.row));
    let radius = (x * x + y * y).sqrt();
    let ray = (x * x - y * y).abs() * 2.0 < x * y.abs() || (x * y).abs() * 6.0 < radius * radius;
    let base = match radius {
        r if r < 0.13 => [0.86, 0.66, 0.24],
        r if r < 0.34 && ray => [0.78, 0.36, 0.16],
        r if (0.36..0.40).contains(&r) => [0.16, 0.30, 0.42],
        _ if x.abs().max(y.abs()) > 0.46 => [0.20, 0.26, 0.34],
        _ => [0.80, 0.74, 0.62],
    };
    let body = smoothstep(0.0012, 0.004, piece.edge);
    let tone = 0.82 + 0.3 * piece.random(81);
    let color = blend([0.42, 0.38, 0.33], shade(base, tone), body);
    Texel::new(color, mix(0.9, 0.22 + 0.2 * piece.random(82), body)).raised(0.002 * body)
}

pub(super) fn stained(u: f32, v: f32) -> Texel {
    let piece = bond([u, v], [4, 8], 0.5);
    let lead = 1.0 - smoothstep(0.008, 0.013, piece.edge);
    const GLASS: [[f32; 3]; 5] =
        [[0.85, 0.25, 0.14], [0.92, 0.66, 0.16], [0.16, 0.42, 0.72], [0.20, 0.58, 0.38], [0.88, 0.84, 0.70]];
    let color = GLASS[(piece.random(91) * 4.999) as usize];
    let swirl = fractal(u, v, 12, 3, 92);
    let color = blend(shade(color, 0.8 + 0.35 * swirl), [0.06, 0.06, 0.07], lead);
    Texel::new(color, mix(0.08, 0.5, lead)).raised(0.004 * lead + 0.002 * swirl).covering(mix(0.5, 1.0, lead))
}

/// Tiles stand on their corners; the tile of the texture has two across its diagonals.
pub(super) fn chequers(u: f32, v: f32) -> Texel {
    const ACROSS: i32 = 4;
    let (a, b) = ((u + v) * ACROSS as f32 * 0.5, (u - v + 1.0) * ACROSS as f32 * 0.5);
    let (column, row) = (a.floor() as i32, b.floor() as i32);
    let gap = |x: f32| (x - x.floor()).min(x.ceil() - x);
    let body = smoothstep(0.008, 0.03, gap(a).min(gap(b)));
    let grain = fractal(u, v, 8, 5, 411);
    let vein = 1.0 - smoothstep(0.0, 0.05, (fractal(u, v, 4, 4, 415) - 0.5).abs());
    let dark = (column + row) % 2 == 0;
    let [stone, veined] = if dark {
        [[0.16, 0.13, 0.12], [0.36, 0.32, 0.28]]
    } else {
        [[0.82, 0.78, 0.70], [0.62, 0.56, 0.48]]
    };
    // Neighbouring tiles of the texture are one tile of stone, so the tone depends on the remainder alone.
    let tone = 0.9 + 0.16 * hash(column.rem_euclid(ACROSS / 2), row.rem_euclid(ACROSS / 2), 413);
    let color = blend([0.30, 0.27, 0.24], shade(blend(stone, veined, 0.6 * vein), tone), body);
    Texel::new(color, mix(0.8, 0.24 + 0.18 * grain, body)).raised(0.0025 * body)
}
