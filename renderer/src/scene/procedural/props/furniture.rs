//! Street furniture.

use glam::Vec3;

use super::super::Detail;
use super::super::maths::{Place, sin_cos};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;

/// Adds `piece` `count` times around the y axis.
fn around(mesh: &mut Mesh, piece: &Mesh, count: u32) {
    for k in 0..count {
        mesh.append(piece, &Place::at(0.0, 0.0, 0.0).turned(f64::from(k) / f64::from(count)));
    }
}

/// A lamp post 4.4 m high with a glowing lantern.
pub(in super::super) fn lamp(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let segments = detail.around(0.8, 6);
    let post: &[[f32; 2]] = match detail.level {
        0 => &[[0.2, 0.0], [0.2, 0.25], [0.11, 0.5], [0.055, 0.9], [0.04, 3.3], [0.17, 3.45]],
        _ => &[
            [0.22, 0.0],
            [0.22, 0.12],
            [0.19, 0.16],
            [0.19, 0.34],
            [0.15, 0.4],
            [0.11, 0.55],
            [0.12, 0.6],
            [0.07, 0.75],
            [0.06, 1.1],
            [0.08, 1.14],
            [0.06, 1.18],
            [0.045, 2.9],
            [0.07, 2.95],
            [0.05, 3.0],
            [0.05, 3.2],
            [0.09, 3.3],
            [0.17, 3.42],
            [0.17, 3.46],
        ],
    };
    let iron = chunk.on(Surface::Iron);
    iron.lathe(post, segments, false);
    let cap = [[0.27, 3.98], [0.28, 4.02], [0.12, 4.2], [0.05, 4.26], [0.05, 4.32], [0.0, 4.44]];
    iron.lathe(&cap, segments, false);
    if detail.level > 0 {
        let mut rib = Mesh::default();
        rib.rod(
            [Vec3::new(0.17, 3.45, 0.0), Vec3::new(0.265, 4.0, 0.0)],
            [0.012, 0.012],
            4 + 2 * detail.level,
        );
        around(iron, &rib, 6);
        iron.rod([Vec3::new(-0.4, 3.1, 0.0), Vec3::new(0.4, 3.1, 0.0)], [0.02, 0.02], segments / 2);
    }
    chunk.on(Surface::LampGlass).lathe(&[[0.15, 3.46], [0.25, 3.98], [0.0, 3.99]], segments, false);
    chunk
}

/// A round café table, 0.72 m high, with two glasses and a bottle.
fn table(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let segments = detail.around(1.0, 8);
    let top = [[0.0, 0.69], [0.34, 0.69], [0.35, 0.70], [0.35, 0.715], [0.34, 0.72], [0.0, 0.72]];
    let top = if detail.level == 0 { &top[2..] } else { &top };
    chunk.on(Surface::Wood).lathe(top, segments, false);
    let iron = chunk.on(Surface::Iron);
    iron.lathe(&[[0.035, 0.02], [0.03, 0.69]], segments / 2, true);
    let mut foot = Mesh::default();
    foot.rod([Vec3::Y * 0.2, Vec3::new(0.26, 0.01, 0.0)], [0.02, 0.02], segments / 4 + 2);
    around(iron, &foot, 3);
    let glass = chunk.on(Surface::Tumbler);
    for (x, z) in [(0.14, 0.1), (-0.15, -0.06)] {
        glass.append(&tumbler(segments), &Place::at(x, 0.72, z));
    }
    let mut bottle = Mesh::default();
    bottle.lathe(&[[0.04, 0.0], [0.04, 0.18], [0.015, 0.24], [0.015, 0.3]], segments, true);
    glass.append(&bottle, &Place::at(0.02, 0.72, -0.16));
    chunk
}

fn tumbler(segments: u32) -> Mesh {
    let mut glass = Mesh::default();
    glass.lathe(&[[0.0, 0.005], [0.028, 0.005], [0.038, 0.12]], segments, false);
    glass
}

/// A wooden chair whose back is towards -z.
fn chair(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let wood = chunk.on(Surface::Wood);
    wood.block(Vec3::new(-0.2, 0.43, -0.2), Vec3::new(0.2, 0.46, 0.2), true);
    let slats = 1 + 2 * detail.level;
    for k in 0..slats {
        let y = 0.62 + 0.26 * k as f32 / slats as f32;
        let height = 0.2 / slats as f32;
        wood.block(Vec3::new(-0.19, y, -0.23), Vec3::new(0.19, y + height, -0.21), true);
    }
    let iron = chunk.on(Surface::Iron);
    let segments = detail.around(0.4, 4);
    for (x, z, top) in [(-0.18, 0.18, 0.44), (0.18, 0.18, 0.44), (-0.18, -0.2, 0.92), (0.18, -0.2, 0.92)] {
        iron.rod([Vec3::new(x * 1.1, 0.0, z * 1.1), Vec3::new(x, top, z)], [0.014, 0.014], segments);
    }
    chunk
}

/// A café table with two chairs.
pub(in super::super) fn terrace(detail: &Detail) -> Chunk {
    let mut chunk = table(detail);
    for turn in [0.24, 0.78] {
        let place = Place::at(0.0, 0.0, 0.0).turned(turn).then(&Place::at(0.0, 0.0, -0.6));
        chunk.append(&chair(detail), &place);
    }
    chunk
}

/// A parked scooter, 1.7 m long along x.
pub(in super::super) fn scooter(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let segments = detail.around(1.0, 8);
    for x in [-0.6, 0.6] {
        let mut tyre = Mesh::default();
        tyre.ring(0.18, 0.05, segments);
        let wheel = Place::at(x, 0.23, 0.0).tilted(0.25);
        chunk.on(Surface::Rubber).append(&tyre, &wheel);
        let mut hub = Mesh::default();
        hub.lathe(&[[0.0, -0.03], [0.13, -0.03], [0.13, 0.03], [0.0, 0.03]], segments, false);
        chunk.on(Surface::Chrome).append(&hub, &wheel);
    }
    let enamel = chunk.on(Surface::Enamel);
    let mut body = Mesh::default();
    body.ball(Vec3::ZERO, 0.24, 2.0, segments);
    enamel.append(&body, &Place::at(-0.45, 0.5, 0.0).turned(0.25).tilted(0.25));
    enamel.block(Vec3::new(-0.2, 0.24, -0.16), Vec3::new(0.34, 0.29, 0.16), true);
    let shield = |u: f32, v: f32| {
        let (sin, cos) = sin_cos(f64::from(u - 0.5) * 0.5);
        (Vec3::new(0.36 + 0.12 * cos - 0.05 * v, 0.28 + 0.6 * v, -0.24 * sin), [u * 0.5, v * 0.6])
    };
    let cells = [segments / 2, 2 + 4 * detail.level];
    enamel.surface(cells, shield);
    enamel.surface(cells, |u, v| {
        let (p, uv) = shield(1.0 - u, v);
        (p - Vec3::X * 0.015, uv)
    });
    let fender = [[0.0, 0.17], [0.1, 0.15], [0.2, 0.05]].map(|[r, y]| [r, -y]);
    let mut cover = Mesh::default();
    cover.lathe(&[fender[0], fender[1], fender[2]], segments, true);
    enamel.append(&cover, &Place::at(0.6, 0.34, 0.0).tilted(0.5));
    chunk.on(Surface::Rubber).block(Vec3::new(-0.7, 0.74, -0.13), Vec3::new(-0.12, 0.82, 0.13), true);
    let chrome = chunk.on(Surface::Chrome);
    chrome.rod([Vec3::new(0.6, 0.25, 0.0), Vec3::new(0.42, 1.0, 0.0)], [0.03, 0.025], segments / 2 + 1);
    chrome.rod([Vec3::new(0.42, 0.98, -0.3), Vec3::new(0.42, 0.98, 0.3)], [0.018, 0.018], segments / 2 + 1);
    chunk.on(Surface::LampGlass).ball(Vec3::new(0.47, 0.9, 0.0), 0.07, 1.0, segments / 2 + 2);
    chunk
}

/// A slatted crate, 0.5 m wide.
pub(in super::super) fn crate_box(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let wood = chunk.on(Surface::Wood);
    if detail.level == 0 {
        wood.block(Vec3::new(-0.25, 0.0, -0.18), Vec3::new(0.25, 0.32, 0.18), false);
        return chunk;
    }
    wood.block(Vec3::new(-0.24, 0.0, -0.17), Vec3::new(0.24, 0.28, 0.17), false);
    for k in 0..3 {
        let y = 0.02 + 0.11 * k as f32;
        for (min, max) in [([-0.25, 0.17], [0.25, 0.19]), ([-0.25, -0.19], [0.25, -0.17])] {
            wood.block(Vec3::new(min[0], y, min[1]), Vec3::new(max[0], y + 0.09, max[1]), true);
        }
    }
    chunk
}

/// A low iron post.
pub(in super::super) fn bollard(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let profile =
        [[0.09, 0.0], [0.08, 0.1], [0.05, 0.15], [0.045, 0.75], [0.06, 0.8], [0.05, 0.88], [0.0, 0.92]];
    let profile = if detail.level == 0 { &profile[2..] } else { &profile };
    chunk.on(Surface::Iron).lathe(profile, detail.around(0.4, 5), true);
    chunk
}

/// An advertising column 4.1 m high.
pub(in super::super) fn kiosk(detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let segments = detail.around(2.0, 12);
    let iron = chunk.on(Surface::Iron);
    iron.lathe(&[[0.75, 0.0], [0.75, 0.3], [0.66, 0.38], [0.66, 0.5]], segments, false);
    let dome = [
        [0.65, 2.9],
        [0.82, 2.95],
        [0.82, 3.15],
        [0.75, 3.2],
        [0.7, 3.4],
        [0.55, 3.65],
        [0.3, 3.82],
        [0.06, 3.9],
        [0.04, 4.05],
        [0.0, 4.1],
    ];
    iron.lathe(&dome, segments, detail.level > 0);
    let sign = chunk.on(Surface::Sign);
    sign.surface([segments, 1], |u, v| {
        let (sin, cos) = sin_cos(f64::from(u));
        (Vec3::new(0.65 * cos, 2.35 + 0.5 * v, -0.65 * sin), [u * 3.0, v])
    });
    chunk.on(Surface::Joinery).lathe(&[[0.64, 0.5], [0.64, 2.35]], segments, true);
    chunk.on(Surface::Joinery).lathe(&[[0.64, 2.84], [0.64, 2.92]], segments, true);
    chunk
}
