//! A storey: walls that lean inwards, with buttresses, under a cornice with battlements.

use glam::Vec3;

use super::super::maths::Place;
use super::super::mesh::{Chunk, Mesh};
use super::super::palette::Surface;

/// How far buttresses stand out, metres.
const RELIEF: f32 = 0.3;
/// Half the width of a buttress.
const BUTTRESS: f32 = 0.5;
/// Distance of buttresses from one another.
const APART: f32 = 2.9;
/// Height of the parapet.
const PARAPET: f32 = 0.6;
/// What the cornice stands out from the wall's upper edge.
const CORNICE: f32 = RELIEF + 0.14;
/// How far the parapet's inner face lies inside the wall's upper edge.
const INNER: f32 = 0.12;
/// Height of a step of stairs, metres.
const STEP: f32 = 0.3;
/// Width and height of the walls beside stairs.
const CHEEK: [f32; 2] = [0.6, 0.5];
/// Run of stairs over their rise, the lean of the wall included.
const RUN: f32 = 1.1;

/// A block whose walls lean inwards, around the y axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Storey {
    /// Half its width (x) and depth (z) at its foot, metres.
    pub(super) foot: [f32; 2],
    /// Height of its foot.
    pub(super) low: f32,
    /// How high it is.
    pub(super) height: f32,
    /// How far the upper edge of its walls lies inside their foot.
    pub(super) batter: f32,
}

/// What a storey ends with.
#[derive(Debug, Clone, Copy)]
pub(super) enum Crown {
    /// A kerb, over walls without buttresses.
    Edge,
    /// A parapet with stepped merlons so far apart, over buttresses.
    Merlons { apart: f32 },
}

/// What a storey looks like.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dress {
    /// Its walls; cornices are of [`Surface::Trim`], its terrace of [`Surface::Flags`].
    pub(super) wall: Surface,
    /// What it ends with.
    pub(super) crown: Crown,
    /// Half the width of the stairs that lead up to it from +Z.
    pub(super) stair: Option<f32>,
}

/// A side of a storey, in whose frame z points outwards and y = 0 at its foot.
struct Side {
    /// Half its length at its foot.
    along: f32,
    /// Distance of its foot from the middle.
    out: f32,
    /// Which of the four it is.
    number: u32,
}

impl Storey {
    /// Walls, terrace and stairs.
    pub(super) fn build(&self, dress: &Dress) -> Chunk {
        let mut chunk = Chunk::default();
        let [x, z] = self.foot;
        for number in 0..4 {
            let [along, out] = if number % 2 == 0 { [x, z] } else { [z, x] };
            let place = Place::at(0.0, self.low, 0.0).turned(f64::from(number) / 4.0);
            chunk.append(&self.side(&Side { along, out, number }, dress), &place);
        }
        let [x, z] = self.foot.map(|half| half - self.batter);
        let corner = Vec3::new(-x, self.low + self.height, z);
        let cells = [x, z].map(|half| (half / 4.0).ceil() as u32);
        chunk.on(Surface::Flags).rect(corner, [Vec3::X * (2.0 * x), Vec3::Z * (-2.0 * z)], cells, [-x, -z]);
        if let Some(half) = dress.stair {
            chunk.append(&self.stair(half), &Place::at(0.0, self.low, 0.0));
        }
        chunk
    }

    fn side(&self, side: &Side, dress: &Dress) -> Chunk {
        let mut chunk = Chunk::default();
        self.face(chunk.on(dress.wall), side);
        // Where stairs arrive nothing bars the way.
        let gap = dress.stair.filter(|_| side.number == 0).map_or(0.0, |half| half + CHEEK[0]);
        match dress.crown {
            Crown::Edge => self.kerb(chunk.on(Surface::Trim), side, gap),
            Crown::Merlons { apart } => {
                self.buttresses(chunk.on(dress.wall), side, gap);
                self.parapet(&mut chunk, side, gap);
                self.merlons(chunk.on(Surface::Trim), side, (gap, apart));
            }
        }
        chunk
    }

    /// The point of a wall that stands `relief` out of it, at `x` and at its foot (0) or its upper edge (1).
    fn on_wall(&self, out: f32, [x, relief]: [f32; 2], end: f32) -> Vec3 {
        Vec3::new(x, self.height * end, out + relief - self.batter * end)
    }

    /// Directions along and up a wall, along which its texture lies.
    fn up_wall(&self) -> [Vec3; 2] {
        [Vec3::X, Vec3::new(0.0, self.height, -self.batter).normalize()]
    }

    fn face(&self, mesh: &mut Mesh, &Side { along, out, .. }: &Side) {
        let top = along - self.batter;
        let points = [(-along, 0.0), (along, 0.0), (top, 1.0), (-top, 1.0)];
        mesh.polygon(&points.map(|(x, end)| self.on_wall(out, [x, 0.0], end)), self.up_wall());
    }

    fn buttresses(&self, mesh: &mut Mesh, side: &Side, gap: f32) {
        let end = side.along - self.batter - 0.25 - BUTTRESS;
        let count = (2.0 * end / APART).floor().max(1.0) as u32;
        for k in 0..=count {
            let x = -end + 2.0 * end * k as f32 / count as f32;
            if x.abs() > gap + BUTTRESS || gap == 0.0 {
                self.buttress(mesh, side.out, x);
            }
        }
    }

    fn buttress(&self, mesh: &mut Mesh, out: f32, x: f32) {
        let at = |x: f32, relief: f32, end: f32| self.on_wall(out, [x, relief], end);
        let (left, right) = (x - BUTTRESS, x + BUTTRESS);
        let front = [(left, 0.0), (right, 0.0), (right, 1.0), (left, 1.0)];
        let [along, up] = self.up_wall();
        mesh.polygon(&front.map(|(x, end)| at(x, RELIEF, end)), [along, up]);
        let cheek = |x: f32, [near, far]: [f32; 2]| {
            [(near, 0.0), (far, 0.0), (far, 1.0), (near, 1.0)].map(|(relief, end)| at(x, relief, end))
        };
        mesh.polygon(&cheek(left, [0.0, RELIEF]), [Vec3::Z, Vec3::Y]);
        mesh.polygon(&cheek(right, [RELIEF, 0.0]), [Vec3::NEG_Z, Vec3::Y]);
    }

    /// The parts of a side's upper edge, start and end along x, that `gap` leaves. Those of two sides meet at the corners.
    fn edge(&self, side: &Side, gap: f32, [out, inner]: [f32; 2]) -> Vec<[f32; 2]> {
        let end = side.along - self.batter + if side.number.is_multiple_of(2) { out } else { -inner };
        if gap > 0.0 { vec![[-end, -gap], [gap, end]] } else { vec![[-end, end]] }
    }

    fn kerb(&self, mesh: &mut Mesh, side: &Side, gap: f32) {
        let (top, out) = (self.height, side.out - self.batter);
        let section =
            [[out, top - 0.2], [out + 0.12, top - 0.14], [out + 0.12, top + 0.03], [out - 0.4, top + 0.032]];
        for ends in self.edge(side, gap, [0.12, 0.4]) {
            mesh.moulding(&section, ends, 1);
        }
    }

    fn parapet(&self, chunk: &mut Chunk, side: &Side, gap: f32) {
        let (top, out) = (self.height, side.out - self.batter);
        let section = [
            [out, top - 0.6],
            [out + CORNICE, top - 0.4],
            [out + CORNICE, top],
            [out + RELIEF, top + 0.002],
            [out + RELIEF, top + PARAPET],
            [out - INNER, top + PARAPET + 0.002],
        ];
        for [x0, x1] in self.edge(side, gap, [CORNICE, INNER]) {
            let mesh = chunk.on(Surface::Trim);
            mesh.moulding(&section, [x0, x1], 1);
            let corner = Vec3::new(x1, top, out - INNER);
            mesh.rect(corner, [Vec3::X * (x0 - x1), Vec3::Y * PARAPET], [1, 1], [0.0, 0.0]);
        }
    }

    fn merlons(&self, mesh: &mut Mesh, side: &Side, (gap, apart): (f32, f32)) {
        let (top, out) = (self.height + PARAPET, side.out - self.batter);
        let end = side.along - self.batter - 0.6;
        let count = (2.0 * end / apart).floor().max(1.0) as u32;
        for k in 0..=count {
            let x = -end + 2.0 * end * k as f32 / count as f32;
            if gap > 0.0 && x.abs() < gap + 0.4 {
                continue;
            }
            for (half, low, high) in [(0.42, 0.0, 0.4), (0.2, 0.4, 0.75)] {
                let min = Vec3::new(x - half, top + low, out - INNER);
                mesh.block(min, Vec3::new(x + half, top + high, out + RELIEF), false);
            }
        }
    }

    /// Stairs with a wall on either side, up to the terrace from +Z.
    fn stair(&self, half: f32) -> Chunk {
        let mut chunk = Chunk::default();
        let (top, length) = (self.foot[1] - self.batter, RUN * self.height);
        let count = (self.height / STEP).round();
        let [rise, depth] = [self.height, length].map(|whole| whole / count);
        let steps = chunk.on(Surface::Pavement);
        for k in 0..count as u32 {
            let (y, z) = (rise * k as f32, top + length - depth * k as f32);
            let width = Vec3::X * (2.0 * half);
            steps.rect(Vec3::new(-half, y, z), [width, Vec3::Y * rise], [1, 1], [0.0, y]);
            steps.rect(Vec3::new(-half, y + rise, z), [width, Vec3::Z * -depth], [1, 1], [0.0, z]);
        }
        for x in [-half - CHEEK[0], half] {
            cheek(chunk.on(Surface::Limestone), x, [top, top + length], self.height);
        }
        chunk
    }
}

/// The wall beside stairs from `far` at its foot to `near` at its upper end, `height` up, its left side at `x`.
fn cheek(mesh: &mut Mesh, x: f32, [near, far]: [f32; 2], height: f32) {
    let [width, over] = CHEEK;
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let outline = [(0.0, near), (0.0, far), (over, far), (height + over, near)];
    let left = outline.map(|(y, z)| at(x, y, z));
    let mut right = outline.map(|(y, z)| at(x + width, y, z));
    right.reverse();
    mesh.polygon(&left, [Vec3::Z, Vec3::Y]);
    mesh.polygon(&right, [Vec3::NEG_Z, Vec3::Y]);
    let (along, up) = (Vec3::X * width, Vec3::new(0.0, height, near - far));
    mesh.rect(at(x, over, far), [along, up], [1, 1], [0.0, 0.0]);
    mesh.rect(at(x, 0.0, far), [along, Vec3::Y * over], [1, 1], [0.0, 0.0]);
    mesh.rect(at(x + width, height, near), [-along, Vec3::Y * over], [1, 1], [0.0, 0.0]);
}
