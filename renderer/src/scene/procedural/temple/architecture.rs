//! Windows and vaults of the temple.

use glam::Vec3;

use super::super::Detail;
use super::super::architecture::{Arch, courses};
use super::super::maths::{Place, mix, sin_cos, smoothstep};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;
use super::BAY;

/// A bay of a hall's side wall from x 0 to [`BAY`], with a leaded window; seen from both sides.
pub(super) fn window_bay(detail: &Detail) -> Chunk {
    let arch = Arch { half: 0.9, spring: 4.4, band: 0.5 };
    let low = 2.2;
    let half = BAY / 2.0;
    let middle = Place::at(half, 0.0, 0.0);
    let mut chunk = Chunk::default();
    // The opening's foot is closed by a solid base, so the arch starts above it.
    chunk.append(&arch.wall([half, 9.2 - low], 0.6, Surface::TempleWall, detail), &Place::at(half, low, 0.0));
    let mut base = Mesh::default();
    let corner = Vec3::new(-half, 0.0, 0.3);
    let cells = [detail.cells(BAY), detail.cells(low)];
    base.relief(corner, [Vec3::X * BAY, Vec3::Y * low], cells, [0.0, 0.0], courses);
    let wall = chunk.on(Surface::TempleWall);
    wall.append(&base, &middle);
    wall.append(&base, &middle.turned(0.5));
    let sill = [[-0.3, low], [0.38, low - 0.1], [0.42, low], [0.42, low + 0.06], [-0.3, low + 0.08]];
    let mut ledge = Mesh::default();
    ledge.moulding(&sill[1..], [-1.3, 1.3], 1);
    let marble = chunk.on(Surface::Marble);
    marble.append(&ledge, &middle);
    marble.append(&ledge, &middle.turned(0.5));
    let cells = [1, detail.around(0.4, 4)];
    chunk.on(Surface::StainedGlass).surface(cells, |u, v| {
        let [x, y] = arch.outline(1.0 + v * 0.5);
        let (x, y) = if v == 0.0 { (-arch.half, arch.spring) } else { (x, y) };
        (Vec3::new(half + x * (1.0 - 2.0 * u), low + y, 0.0), [u, (y + low) * 0.25])
    });
    let pane = [Vec3::X * (2.0 * arch.half), Vec3::Y * arch.spring];
    chunk.on(Surface::StainedGlass).surface([1, 1], |u, v| {
        (
            Vec3::new(half - arch.half, low, 0.0) + pane[0] * u + pane[1] * v,
            [u, (v * arch.spring + low) * 0.25],
        )
    });
    chunk
}

/// One bay of an elliptic barrel vault along z from 0 to -[`BAY`], with a rib; `half` wide, `rise` high.
pub(super) fn vault_bay(half: f32, rise: f32, detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let point = |turn: f32, swell: f32| {
        let (sin, cos) = sin_cos(0.5 * f64::from(turn));
        Vec3::new((half + swell) * cos, (rise + swell) * sin, 0.0)
    };
    let cells = [detail.around(2.0, 12), detail.cells(BAY)];
    let length = 1.35 * (half + rise);
    chunk.on(Surface::TempleWall).surface(cells, |u, v| {
        let swell = if v > 0.0 && v < 1.0 && u > 0.0 && u < 1.0 { coffer(u, v) } else { 0.0 };
        (point(1.0 - u, swell) - Vec3::Z * (BAY * (1.0 - v)), [u * length, v * BAY])
    });
    let section = [[0.0, 0.35], [-0.28, 0.3], [-0.28, -0.3], [0.0, -0.35]];
    let segments = detail.around(1.6, 12);
    for span in section.windows(2) {
        chunk.on(Surface::Marble).surface([segments, 1], |u, v| {
            let swell = mix(span[0][0], span[1][0], v);
            let z = mix(span[0][1], span[1][1], v);
            (point(u, swell) + Vec3::Z * z, [u * length, v])
        });
    }
    chunk
}

/// Depth of square coffers, nine across a vault and three along a bay.
fn coffer(u: f32, v: f32) -> f32 {
    let inside = |x: f32| smoothstep(0.12, 0.2, 0.5 - ((x).fract() - 0.5).abs());
    0.22 * inside(u * 9.0).min(inside(v * 3.0))
}
