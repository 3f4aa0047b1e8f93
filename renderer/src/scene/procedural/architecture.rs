//! Columns, arches and beams: what the temple's halls and courts and the galleried hall are made of.

use glam::Vec3;

use super::Detail;
use super::maths::{Place, mix, sin_cos, smoothstep};
use super::mesh::{Chunk, Mesh};
use super::palette::Surface;

/// A column that stands on the origin: base, fluted shaft with a slight swelling, capital, gilded collar.
pub(super) fn column(detail: &Detail, height: f32, radius: f32) -> Chunk {
    const FLUTES: f32 = 20.0;
    let mut chunk = Chunk::default();
    let segments = detail.around(1.6 * radius.max(0.4), 8);
    let r = radius;
    let marble = chunk.on(Surface::Marble);
    let plinth = Vec3::new(1.45 * r, 0.0, 1.45 * r);
    marble.block(-plinth, plinth + Vec3::Y * 0.28 * r, false);
    let base = [[1.4, 0.28], [1.42, 0.4], [1.3, 0.55], [1.16, 0.6], [1.12, 0.7], [1.26, 0.8], [1.1, 0.95]];
    let base = base.map(|[x, y]| [x * r, y * r]);
    marble.lathe(if detail.level == 0 { &base[4..] } else { &base }, segments, detail.level > 0);
    let (low, high) = (0.95 * r, height - 1.5 * r);
    let rows = 1 + 8 * detail.level * detail.level;
    let shaft: Vec<[f32; 2]> = (0..=rows)
        .map(|k| {
            let t = k as f32 / rows as f32;
            [r * (1.0 - 0.16 * t * t), mix(low, high, t)]
        })
        .collect();
    let depth = if detail.level == 0 { 0.0 } else { 0.07 };
    marble.revolve(&shaft, segments, true, |turn, y| {
        let fade = smoothstep(low, low + 0.3, y) * (1.0 - smoothstep(high - 0.3, high, y));
        let (sin, _) = sin_cos(f64::from((turn * FLUTES).fract() * 0.5));
        1.0 - depth * sin * fade
    });
    let top = [[0.84, -1.5], [0.95, -1.2], [1.0, -0.9], [1.3, -0.45], [1.36, -0.3]];
    let top = top.map(|[x, y]| [x * r, height + y * r]);
    marble.lathe(&top, segments, detail.level > 0);
    if detail.level > 0 {
        capital_leaves(marble, height, r, detail);
    }
    let abacus = Vec3::new(1.42 * r, 0.0, 1.42 * r);
    marble.block(Vec3::Y * (height - 0.3 * r) - abacus, Vec3::Y * height + abacus, true);
    let collar =
        [[0.86, -1.62], [0.95, -1.56], [0.95, -1.46], [0.84, -1.4]].map(|[x, y]| [x * r, height + y * r]);
    chunk.on(Surface::Gold).lathe(&collar, segments, true);
    chunk
}

/// Two rings of leaves that curl out of a capital.
fn capital_leaves(mesh: &mut Mesh, height: f32, r: f32, detail: &Detail) {
    let cells = [2 * detail.level, 4 * detail.level];
    let mut leaf = Mesh::default();
    let blade = |u: f32, v: f32| {
        let width = 0.34 * r * (1.0 - v * v * 0.8);
        let out = r * (0.96 + 0.5 * v * v * v + 0.04 * (1.0 - (2.0 * u - 1.0) * (2.0 * u - 1.0)));
        (
            Vec3::new((u - 0.5) * width, height - r * (1.35 - 0.75 * v + 0.2 * v * v * v), out),
            [u * 0.3, v * 0.5],
        )
    };
    leaf.surface(cells, blade);
    leaf.surface(cells, |u, v| {
        let (p, uv) = blade(1.0 - u, v);
        (p - Vec3::Z * 0.015, uv)
    });
    for k in 0..16 {
        let drop = if k % 2 == 0 { 0.0 } else { -0.22 * r };
        mesh.append(&leaf, &Place::at(0.0, drop, 0.0).turned(f64::from(k) / 16.0));
    }
}

/// Width of the moulding whose section [`Arch::archivolt`] lists, metres.
const SECTION_BAND: f32 = 0.5;

/// An opening with a round arch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arch {
    /// Half the width of the opening, which is the radius of its arch.
    pub(super) half: f32,
    /// Height at which the arch springs.
    pub(super) spring: f32,
    /// Width of the moulding around it; what it stands out is in proportion.
    pub(super) band: f32,
}

impl Arch {
    /// A point of the outline at `t` from 0 (left foot) to 3 (right foot): jamb, arch, jamb.
    pub(super) fn outline(&self, t: f32) -> [f32; 2] {
        match t {
            t if t <= 1.0 => [-self.half, self.spring * t],
            t if t >= 2.0 => [self.half, self.spring * (3.0 - t)],
            t => {
                let (sin, cos) = sin_cos(0.5 * f64::from(2.0 - t));
                [self.half * cos, self.spring + self.half * sin]
            }
        }
    }

    /// The point of a rectangle around the arch (half width, height) on the ray through `outline(t)`.
    fn frame(&self, t: f32, [half, height]: [f32; 2]) -> [f32; 2] {
        let [x, y] = self.outline(t);
        if t <= 1.0 || t >= 2.0 {
            return [half * x.signum(), y];
        }
        let (dx, dy) = (x, y - self.spring);
        let side = if dx == 0.0 { f32::INFINITY } else { half / dx.abs() };
        let top = if dy <= 0.0 { f32::INFINITY } else { (height - self.spring) / dy };
        let reach = side.min(top);
        [dx * reach, self.spring + dy * reach]
    }

    /// Where the ray of the arch meets the rectangle's upper left corner, as `t`.
    fn corner(&self, [half, height]: [f32; 2]) -> f32 {
        // Bisection: the ray's slope grows with t over the left quarter.
        let slope = (height - self.spring) / half;
        let (mut low, mut high) = (1.0, 1.5);
        for _ in 0..30 {
            let middle = (low + high) * 0.5;
            let [x, y] = self.outline(middle);
            if (y - self.spring) < slope * -x { low = middle } else { high = middle }
        }
        low
    }

    /// A wall, `size` (half width, height), `thick`, centred on the z = 0 plane and pierced by the arch.
    pub(super) fn wall(&self, size: [f32; 2], thick: f32, surface: Surface, detail: &Detail) -> Chunk {
        let mut face = Mesh::default();
        let corner = self.corner(size);
        let parts = [0.0, 1.0, corner, 3.0 - corner, 2.0, 3.0];
        let (radial, around) = (detail.cells(size[0] - self.half), detail.around(0.8, 4));
        for (k, ends) in parts.windows(2).enumerate() {
            let straight = k == 0 || k == 4;
            let along = if straight { detail.cells(self.spring) } else { around };
            face.surface([along, radial], |u, v| {
                let t = mix(ends[0], ends[1], u);
                let ([x0, y0], [x1, y1]) = (self.outline(t), self.frame(t, size));
                let p = [mix(x0, x1, v), mix(y0, y1, v)];
                let border = u == 0.0 || u == 1.0 || v == 0.0 || v == 1.0;
                let lift = if border { 0.0 } else { courses(p) };
                (Vec3::new(p[0], p[1], thick / 2.0 + lift), p)
            });
        }
        let mut chunk = Chunk::default();
        let both = [Place::at(0.0, 0.0, 0.0), Place::at(0.0, 0.0, 0.0).turned(0.5)];
        let wall = chunk.on(surface);
        both.iter().for_each(|place| wall.append(&face, place));
        let mesh = chunk.on(Surface::Marble);
        self.intrados(thick, around, mesh);
        let mut trim = Mesh::default();
        self.archivolt(thick / 2.0, detail, &mut trim);
        both.iter().for_each(|place| mesh.append(&trim, place));
        chunk
    }

    /// The inner side of the opening.
    fn intrados(&self, thick: f32, around: u32, mesh: &mut Mesh) {
        for (ends, cells) in [([0.0, 1.0], 1), ([1.0, 2.0], 3 * around), ([2.0, 3.0], 1)] {
            mesh.surface([cells, 1], |u, v| {
                let t = mix(ends[0], ends[1], u);
                let [x, y] = self.outline(t);
                (Vec3::new(x, y, thick * (v - 0.5)), [t * (self.half + self.spring), v * thick])
            });
        }
    }

    /// A moulding around the opening, on the face at depth `z`.
    fn archivolt(&self, z: f32, detail: &Detail, mesh: &mut Mesh) {
        let section: &[[f32; 2]] = if detail.level == 0 {
            &[[0.0, 0.0], [0.0, 0.12], [0.5, 0.12], [0.5, 0.0]]
        } else {
            &[
                [0.0, 0.0],
                [0.0, 0.1],
                [0.08, 0.16],
                [0.16, 0.12],
                [0.3, 0.12],
                [0.34, 0.18],
                [0.46, 0.18],
                [0.5, 0.1],
                [0.5, 0.0],
            ]
        };
        let around = detail.around(1.6, 10);
        let scale = self.band / SECTION_BAND;
        for (ends, cells) in [([0.0, 1.0], 1), ([1.0, 2.0], around), ([2.0, 3.0], 1)] {
            for span in section.windows(2) {
                mesh.surface([cells, 1], |u, v| {
                    let t = mix(ends[0], ends[1], u);
                    let out = mix(span[0][0], span[1][0], v) * scale;
                    let wider = Self { half: self.half + out, ..*self };
                    let [x, y] = wider.outline(t);
                    (
                        Vec3::new(x, y, z + mix(span[0][1], span[1][1], v) * scale),
                        [t * self.spring, out + v * 0.1],
                    )
                });
            }
        }
    }
}

/// A beam along x from 0 to `length` with the mouldings of an entablature, its underside at y = 0, seen all
/// around; `half` deep and `height` high.
pub(super) fn entablature(length: f32, half: f32, height: f32, detail: &Detail) -> Chunk {
    let h = height;
    let section: &[[f32; 2]] = if detail.level == 0 {
        &[[0.0, 0.0], [1.0, 0.0], [1.0, 0.7], [1.3, 1.0], [0.0, 1.0]]
    } else {
        &[
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 0.2],
            [1.05, 0.2],
            [1.05, 0.4],
            [1.12, 0.44],
            [1.0, 0.46],
            [1.0, 0.7],
            [1.1, 0.74],
            [1.2, 0.84],
            [1.35, 0.88],
            [1.35, 0.96],
            [1.3, 1.0],
            [0.0, 1.0],
        ]
    };
    let section: Vec<[f32; 2]> = section.iter().map(|[z, y]| [z * half, y * h]).collect();
    let mut side = Mesh::default();
    side.moulding(&section, [0.0, length], detail.cells(length));
    let mut chunk = Chunk::default();
    let marble = chunk.on(Surface::Marble);
    marble.append(&side, &Place::at(0.0, 0.0, 0.0));
    marble.append(&side, &Place::at(length, 0.0, 0.0).turned(0.5));
    if detail.level > 0 {
        let studs = (length / 0.6) as u32;
        for k in 0..studs {
            let x = length * (k as f32 + 0.5) / studs as f32;
            for z in [half, -half] {
                let gold = chunk.on(Surface::Gold);
                gold.ball(Vec3::new(x, 0.58 * h, z), 0.09, 1.0, detail.around(0.16, 6));
            }
        }
    }
    chunk
}

/// Courses of ashlar whose joints are drawn in.
pub(super) fn courses([_, v]: [f32; 2]) -> f32 {
    let course = v * 7.0 / 4.0;
    -0.02 * smoothstep(0.36, 0.5, (course - course.floor() - 0.5).abs())
}
