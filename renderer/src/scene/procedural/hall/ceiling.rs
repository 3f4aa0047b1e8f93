//! Vaults and ceilings.

use glam::Vec3;

use super::super::maths::{Place, mix, sin_cos};
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;
use super::{BAY, EAVES, Hall, NAVE, THICK};

/// Height of the vault over its foot, inside.
const RISE: f32 = 3.0;
/// Coffers across the vault and along a bay.
const COFFERS: [u32; 2] = [9, 3];
/// The coffers across the vault, the first and the one after the last, in whose place some bays are open.
const OPENING: [u32; 2] = [3, 6];
/// Insets (in parts of a coffer) and depths (metres) of a coffer's rings, from its edge to its bottom.
const STEPS: [[f32; 2]; 5] = [[0.0, 0.0], [0.1, 0.0], [0.13, 0.08], [0.22, 0.08], [0.26, 0.16]];
/// Radius of the round windows over the hall's ends.
const ROSE: f32 = 1.1;

impl Hall {
    /// Eight bays, of which four are open to the sky and two of these glazed, and the walls at the ends.
    pub(super) fn vault(&mut self) {
        let closed = self.builder.model(vault_bay(false));
        let open = self.builder.model(vault_bay(true));
        let skylight = self.builder.model(skylight());
        for k in 0..8 {
            let place = Place::at(-NAVE[0] + BAY * k as f32, EAVES, 0.0);
            let is_open = matches!(k, 1 | 3 | 4 | 6);
            self.builder.place(if is_open { &open } else { &closed }, &place);
            if matches!(k, 1 | 6) {
                self.builder.place(&skylight, &place);
            }
        }
        let end = self.builder.model(lunette());
        for (x, along) in [(-NAVE[0], [0.0, -1.0]), (NAVE[0], [0.0, 1.0])] {
            self.builder.place(&end, &Place::along(Vec3::new(x, EAVES, 0.0), along));
        }
    }
}

/// A point of the vault: `u` from 0 at z = half the nave's width to 1 across, `v` from 0 to 1 along x, `depth` outwards.
fn vaulted(u: f32, v: f32, depth: f32) -> Vec3 {
    let (sin, cos) = sin_cos(0.5 * f64::from(u));
    Vec3::new(BAY * v, (RISE + depth) * sin, (NAVE[1] + depth) * cos)
}

/// A bay of the vault along x from 0 to [`BAY`], y = 0 at its foot: coffers with gilded bosses, and a rib at its start.
fn vault_bay(open: bool) -> Chunk {
    let mut chunk = Chunk::default();
    let size = [0, 1].map(|axis| 1.0 / COFFERS[axis] as f32);
    let mut boss = Mesh::default();
    boss.ball(Vec3::ZERO, 0.11, 0.6, 6);
    for i in 0..COFFERS[0] {
        if open && (OPENING[0]..OPENING[1]).contains(&i) {
            continue;
        }
        for j in 0..COFFERS[1] {
            let low = [i as f32 * size[0], j as f32 * size[1]];
            coffer(chunk.on(Surface::Plaster), low, size);
            let middle = vaulted(low[0] + 0.5 * size[0], low[1] + 0.5 * size[1], 0.14);
            let up = Vec3::new(0.0, middle.y, middle.z).normalize_or(Vec3::Y);
            chunk.on(Surface::Gold).append(&boss, &Place::upright(middle, up));
        }
    }
    if open {
        curb(chunk.on(Surface::Plaster));
    }
    rib(chunk.on(Surface::Limestone));
    chunk
}

/// One coffer, from `low` over `size` in the vault's coordinates: rings of flat faces down to its bottom.
fn coffer(mesh: &mut Mesh, low: [f32; 2], size: [f32; 2]) {
    let corner = |k: usize, step: usize| {
        let [inset, depth] = STEPS[step];
        let part = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]][k % 4];
        let [u, v] = [0, 1].map(|axis| low[axis] + size[axis] * mix(inset, 1.0 - inset, part[axis]));
        let length = 0.75 * (NAVE[1] + RISE) * std::f32::consts::TAU * 0.5;
        (vaulted(u, v, depth), [u * length, v * BAY])
    };
    let quad = |mesh: &mut Mesh, knots: [(Vec3, [f32; 2]); 4]| {
        mesh.surface([1, 1], |s, t| knots[usize::from(s > 0.5) + 2 * usize::from(t > 0.5)]);
    };
    for step in 1..STEPS.len() {
        for k in 0..4 {
            let [a, b] = [corner(k, step - 1), corner(k + 1, step - 1)];
            let [c, d] = [corner(k, step), corner(k + 1, step)];
            quad(mesh, [b, a, d, c]);
        }
    }
    let last = STEPS.len() - 1;
    quad(mesh, [corner(1, last), corner(0, last), corner(2, last), corner(3, last)]);
}

/// The sides of an opening.
fn curb(mesh: &mut Mesh) {
    let [low, high] = OPENING.map(|coffer| coffer as f32 / COFFERS[0] as f32);
    for (u, outward) in [(low, false), (high, true)] {
        mesh.surface([1, 1], |s, t| {
            let along = if outward { 1.0 - s } else { s };
            (vaulted(u, along, 0.4 * t), [BAY * s, 0.4 * t])
        });
    }
}

/// A band across the vault, in the middle of x = 0.
fn rib(mesh: &mut Mesh) {
    let section = [[-0.28, 0.02], [-0.28, -0.16], [-0.2, -0.22], [0.2, -0.22], [0.28, -0.16], [0.28, 0.02]];
    for span in section.windows(2) {
        mesh.surface([32, 1], |u, v| {
            let [x, depth] = [0, 1].map(|axis| mix(span[0][axis], span[1][axis], v));
            let p = vaulted(1.0 - u, 0.0, depth);
            (p + Vec3::X * x, [u * 13.0, x])
        });
    }
}

/// Glass over an opening, with its bars.
fn skylight() -> Chunk {
    let [low, high] = OPENING.map(|coffer| coffer as f32 / COFFERS[0] as f32);
    let mut chunk = Chunk::default();
    chunk.on(Surface::ShopGlass).surface([8, 1], |u, v| {
        let p = vaulted(mix(high, low, u), v, 0.3);
        (p, [u * 4.0, v * BAY])
    });
    let iron = chunk.on(Surface::Iron);
    for k in 0..=6 {
        let u = mix(low, high, k as f32 / 6.0);
        iron.rod([vaulted(u, 0.0, 0.28), vaulted(u, 1.0, 0.28)], [0.03, 0.03], 6);
    }
    for v in [0.25, 0.5, 0.75] {
        for k in 0..6 {
            let [a, b] = [k, k + 1].map(|k| vaulted(mix(low, high, k as f32 / 6.0), v, 0.28));
            iron.rod([a, b], [0.02, 0.02], 5);
        }
    }
    chunk
}

/// The wall at an end of the vault, with a round window of stained glass; x across, facing +z.
fn lunette() -> Chunk {
    let mut chunk = Chunk::default();
    let centre = Vec3::Y * (0.5 * RISE - 0.1);
    let circle = |turn: f32, radius: f32| {
        let (sin, cos) = sin_cos(f64::from(turn));
        centre + Vec3::new(radius * cos, radius * sin, 0.0)
    };
    let arc = |t: f32| {
        let (sin, cos) = sin_cos(0.5 * f64::from(t));
        Vec3::new((NAVE[1] + 0.1) * cos, (RISE + 0.1) * sin, 0.0)
    };
    let stone = chunk.on(Surface::Limestone);
    let flat = |p: Vec3| (p, [p.x, p.y]);
    stone.surface([24, 1], |u, v| flat(circle(mix(-0.06, 0.56, u), ROSE).lerp(arc(u), 1.0 - v)));
    stone.surface([8, 1], |u, v| {
        let foot = Vec3::X * mix(-1.0, 1.0, u) * (NAVE[1] + 0.1);
        flat(circle(mix(0.56, 0.94, u), ROSE).lerp(foot, 1.0 - v))
    });
    let section = [[0.26, 0.0], [0.26, 0.1], [0.16, 0.16], [0.0, 0.1], [0.0, -0.3]];
    for span in section.windows(2) {
        stone.surface([32, 1], |u, v| {
            let [out, z] = [0, 1].map(|axis| mix(span[0][axis], span[1][axis], v));
            (circle(u, ROSE + out) + Vec3::Z * z, [u * 7.0, out + z])
        });
    }
    chunk.on(Surface::StainedGlass).surface([32, 1], |u, v| {
        let p = circle(u, ROSE * (1.0 - v)) - Vec3::Z * 0.15;
        (p, [0.4 * p.x, 0.4 * p.y])
    });
    chunk
}

/// A groin vault from x 0 to `size[0]` and z 0 to `-size[1]`, y = 0 at its springing, with a rib over its start and a corbel
/// where that meets the wall.
pub(super) fn groin_vault([length, depth]: [f32; 2]) -> Chunk {
    const CELLS: u32 = 12;
    const HEIGHT: f32 = 1.5;
    let arch = |t: f32| {
        let x = 2.0 * t - 1.0;
        HEIGHT * (1.0 - x * x).max(0.0).sqrt()
    };
    // Denser towards the springing, where the arch is steep.
    let eased = |t: f32| 0.5 - 0.5 * sin_cos(0.5 * f64::from(t)).1;
    let mut chunk = Chunk::default();
    chunk.on(Surface::Plaster).surface([CELLS, CELLS], |u, v| {
        let (s, t) = (eased(u), eased(v));
        (Vec3::new(length * s, arch(s).max(arch(t)), depth * (t - 1.0)), [length * s, depth * t])
    });
    let section = [[-0.2, 0.06], [-0.2, -0.12], [0.2, -0.12], [0.2, 0.06]];
    for span in section.windows(2) {
        chunk.on(Surface::Plaster).surface([16, 1], |u, v| {
            let [x, out] = [0, 1].map(|axis| mix(span[0][axis], span[1][axis], v));
            let t = eased(u);
            (Vec3::new(x, arch(t) + out, -depth * (1.0 - t)), [depth * u, x])
        });
    }
    let corbel =
        [[0.0, -0.62], [0.1, -0.56], [0.14, -0.4], [0.24, -0.14], [0.32, -0.1], [0.32, 0.04], [0.0, 0.06]];
    let mut bracket = Mesh::default();
    bracket.lathe(&corbel, 8, false);
    chunk.on(Surface::Plaster).append(&bracket, &Place::at(0.0, 0.0, -depth));
    chunk
}

/// A ceiling of boards at height `y` with joists under it, from x 0 to `size[0]` and z 0 to `-size[1]`.
pub(super) fn soffit(wood: &mut Mesh, [length, depth]: [f32; 2], y: f32) {
    let corner = Vec3::new(0.0, y, -depth);
    wood.rect(corner, [Vec3::X * length, Vec3::Z * (depth + THICK / 2.0)], [1, 1], [0.0, 0.0]);
    let joists = (length / 0.875).round() as u32;
    for k in 0..joists {
        let x = length * (k as f32 + 0.5) / joists as f32;
        let low = Vec3::new(x - 0.07, y - 0.2, -depth);
        wood.block(low, Vec3::new(x + 0.07, y, THICK / 2.0 - 0.05), true);
    }
}
