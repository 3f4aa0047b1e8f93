//! Triangles with normals, tangents and texture coordinates in metres.
//!
//! Every shape is one or more parametric surfaces; normals and tangents come from the finished triangles, so
//! winding, normals and texture directions always agree.

use std::collections::BTreeMap;

use glam::Vec3;

use super::maths::{Place, sin_cos};
use super::palette::Surface;
use crate::scene::Vertex;

/// A position and its texture coordinates.
pub(super) type Knot = (Vec3, [f32; 2]);

/// Triangles of one material.
#[derive(Debug, Clone, Default)]
pub(super) struct Mesh {
    /// Vertices, white.
    pub(super) vertices: Vec<Vertex>,
    /// Counter-clockwise triangles.
    pub(super) indices: Vec<u32>,
}

/// Triangles of several materials that belong to one place.
#[derive(Debug, Clone, Default)]
pub(super) struct Chunk {
    parts: BTreeMap<Surface, Mesh>,
}

impl Chunk {
    /// The mesh that wears `surface`.
    pub(super) fn on(&mut self, surface: Surface) -> &mut Mesh {
        self.parts.entry(surface).or_default()
    }

    /// Adds a copy of `other`, placed.
    pub(super) fn append(&mut self, other: &Self, place: &Place) {
        for (surface, mesh) in &other.parts {
            self.on(*surface).append(mesh, place);
        }
    }

    /// The non-empty meshes in the order of their surfaces.
    pub(super) fn into_parts(self) -> impl Iterator<Item = (Surface, Mesh)> {
        self.parts.into_iter().filter(|(_, mesh)| !mesh.indices.is_empty())
    }
}

impl Mesh {
    /// The surface `at(u, v)` over the unit square in `cells` quads. Its front is where the u direction
    /// crossed with the v direction points. Edges that meet (u = 0 and 1, or a pole) are shaded smoothly.
    pub(super) fn surface(&mut self, cells: [u32; 2], at: impl Fn(f32, f32) -> Knot) {
        let [columns, rows] = cells;
        let mut patch = Patch::new(columns as usize + 1);
        for j in 0..=rows {
            for i in 0..=columns {
                patch.knots.push(at(i as f32 / columns as f32, j as f32 / rows as f32));
            }
        }
        for j in 0..rows {
            for i in 0..columns {
                let a = j * (columns + 1) + i;
                let c = a + columns + 2;
                patch.triangle([a, a + 1, c]);
                patch.triangle([a, c, c - 1]);
            }
        }
        patch.finish(self);
    }

    /// A parallelogram from `corner` along `u` and `v`, textured in metres from `uv` on.
    pub(super) fn rect(&mut self, corner: Vec3, [u, v]: [Vec3; 2], cells: [u32; 2], uv: [f32; 2]) {
        let (width, height) = (u.length(), v.length());
        self.surface(cells, |s, t| (corner + u * s + v * t, [uv[0] + width * s, uv[1] + height * t]));
    }

    /// A parallelogram that wears the whole texture once.
    pub(super) fn panel(&mut self, corner: Vec3, [u, v]: [Vec3; 2]) {
        self.surface([1, 1], |s, t| (corner + u * s + v * t, [s, t]));
    }

    /// [`Mesh::rect`] pushed along its normal by `relief(texture coordinates)`, except at its border, so that
    /// neighbours still meet.
    pub(super) fn relief(
        &mut self,
        corner: Vec3,
        [u, v]: [Vec3; 2],
        cells: [u32; 2],
        uv: [f32; 2],
        relief: impl Fn([f32; 2]) -> f32,
    ) {
        let normal = u.cross(v).normalize();
        let (width, height) = (u.length(), v.length());
        self.surface(cells, |s, t| {
            let inside = s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0;
            let uv = [uv[0] + width * s, uv[1] + height * t];
            let lift = if inside { relief(uv) } else { 0.0 };
            (corner + u * s + v * t + normal * lift, uv)
        });
    }

    /// A convex polygon in one plane, counter-clockwise, textured in metres along `u` and `v`.
    pub(super) fn polygon(&mut self, points: &[Vec3], [u, v]: [Vec3; 2]) {
        let mut patch = Patch::new(0);
        patch.knots.extend(points.iter().map(|p| (*p, [p.dot(u), p.dot(v)])));
        for k in 1..points.len() as u32 - 1 {
            patch.triangle([0, k, k + 1]);
        }
        patch.finish(self);
    }

    /// An axis-aligned box; `bottom` tells whether its underside can be seen.
    pub(super) fn block(&mut self, min: Vec3, max: Vec3, bottom: bool) {
        let e = max - min;
        let (x, y, z) = (Vec3::X * e.x, Vec3::Y * e.y, Vec3::Z * e.z);
        let at = |i: f32, j: f32, k: f32| min + x * i + y * j + z * k;
        self.rect(at(0.0, 0.0, 1.0), [x, y], [1, 1], [min.x, min.y]);
        self.rect(at(1.0, 0.0, 0.0), [-x, y], [1, 1], [-max.x, min.y]);
        self.rect(at(1.0, 0.0, 1.0), [-z, y], [1, 1], [-max.z, min.y]);
        self.rect(at(0.0, 0.0, 0.0), [z, y], [1, 1], [min.z, min.y]);
        self.rect(at(0.0, 1.0, 1.0), [x, -z], [1, 1], [min.x, -max.z]);
        if bottom {
            self.rect(at(0.0, 0.0, 0.0), [x, z], [1, 1], [min.x, min.z]);
        }
    }

    /// Revolves `profile` (radius, height; from the bottom up for an outward front) about the y axis in
    /// `segments` steps; each span keeps its edges unless `smooth`.
    pub(super) fn lathe(&mut self, profile: &[[f32; 2]], segments: u32, smooth: bool) {
        self.revolve(profile, segments, smooth, |_, _| 1.0);
    }

    /// [`Mesh::lathe`] whose radius is multiplied by `swell(turn, height)`.
    pub(super) fn revolve(
        &mut self,
        profile: &[[f32; 2]],
        segments: u32,
        smooth: bool,
        swell: impl Fn(f32, f32) -> f32,
    ) {
        let widest = profile.iter().fold(0.0_f32, |widest, p| widest.max(p[0]));
        let lengths = arc_lengths(profile);
        let span = if smooth { profile.len() - 1 } else { 1 };
        for first in (0..profile.len() - 1).step_by(span) {
            self.surface([segments, span as u32], |u, v| {
                let k = first + (v * span as f32).round() as usize;
                let [radius, y] = profile[k];
                let (sin, cos) = sin_cos(f64::from(u));
                let r = radius * swell(u, y);
                (Vec3::new(r * cos, y, -r * sin), [u * widest * std::f32::consts::TAU, lengths[k]])
            });
        }
    }

    /// A straight rod between two points, open at its ends, with a radius at each.
    pub(super) fn rod(&mut self, [from, to]: [Vec3; 2], radii: [f32; 2], segments: u32) {
        let along = to - from;
        let length = along.length();
        let mut rod = Self::default();
        rod.lathe(&[[radii[0], 0.0], [radii[1], length]], segments, true);
        self.append(&rod, &Place::upright(from, along / length));
    }

    /// A ball or, with `squash` other than 1, a ball whose height is that many times its width.
    pub(super) fn ball(&mut self, centre: Vec3, radius: f32, squash: f32, segments: u32) {
        let rows = (segments / 2).max(3);
        let profile: Vec<[f32; 2]> = (0..=rows)
            .map(|k| {
                let (sin, cos) = sin_cos(f64::from(k) / f64::from(rows) * 0.5);
                let r = if k == 0 || k == rows { 0.0 } else { radius * sin };
                [r, -radius * squash * cos]
            })
            .collect();
        let mut ball = Self::default();
        ball.lathe(&profile, segments, true);
        self.append(&ball, &Place::at(centre.x, centre.y, centre.z));
    }

    /// A ring of radius `ring` about the y axis whose section is a circle of radius `tube`.
    pub(super) fn ring(&mut self, ring: f32, tube: f32, segments: u32) {
        let around = (segments / 2).max(4);
        self.surface([segments, around], |u, v| {
            let (sin, cos) = sin_cos(f64::from(u));
            let (tube_sin, tube_cos) = sin_cos(f64::from(v));
            let r = ring + tube * tube_cos;
            let tau = std::f32::consts::TAU;
            (Vec3::new(r * cos, tube * tube_sin, -r * sin), [u * ring * tau, v * tube * tau])
        });
    }

    /// Sweeps a profile of (depth z, height y) points along x and closes both ends. The profile goes from the
    /// bottom up without a way down.
    pub(super) fn moulding(&mut self, profile: &[[f32; 2]], [x0, x1]: [f32; 2], cells: u32) {
        let lengths = arc_lengths(profile);
        let at = |x: f32, k: usize| Vec3::new(x, profile[k][1], profile[k][0]);
        for (k, length) in lengths[1..].iter().enumerate() {
            let (a, b) = (at(x0, k), at(x0, k + 1));
            self.rect(a, [Vec3::X * (x1 - x0), b - a], [cells, 1], [x0, length - (b - a).length()]);
        }
        self.moulding_end(profile, x0, 1.0);
        self.moulding_end(profile, x1, -1.0);
    }

    /// Closes a moulding at `x`; `side` is 1 at its left end, -1 at its right end.
    fn moulding_end(&mut self, profile: &[[f32; 2]], x: f32, side: f32) {
        let back = profile.iter().fold(f32::INFINITY, |back, p| back.min(p[0]));
        let mut patch = Patch::new(0);
        for (k, [z, y]) in profile.iter().enumerate() {
            for z in [back, *z] {
                patch.knots.push((Vec3::new(x, *y, z), [z * side, *y]));
            }
            if k > 0 {
                let [a, b, c, d] = [-2, -1, 1, 0].map(|step| (2 * k as i32 + step) as u32);
                let (first, second) =
                    if side > 0.0 { ([a, b, c], [a, c, d]) } else { ([b, a, d], [b, d, c]) };
                patch.triangle(first);
                patch.triangle(second);
            }
        }
        patch.finish(self);
    }

    /// Adds a copy of `other`, placed.
    pub(super) fn append(&mut self, other: &Self, place: &Place) {
        let base = self.vertices.len() as u32;
        self.vertices.extend(other.vertices.iter().map(|vertex| {
            let [x, y, z, w] = vertex.tangent;
            Vertex {
                position: place.point(vertex.position.into()).into(),
                normal: place.vector(vertex.normal.into()).normalize().into(),
                tangent: place.vector(Vec3::new(x, y, z)).normalize().extend(w).into(),
                ..*vertex
            }
        }));
        self.indices.extend(other.indices.iter().map(|index| index + base));
    }

    /// A roof with two slopes over the box between `min` and `max`, its ridge along z, open below.
    pub(super) fn gable(&mut self, min: Vec3, max: Vec3) {
        let middle = (min.x + max.x) * 0.5;
        let corner = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
        let (right, left, ridge) =
            (corner(max.x, min.y, max.z), corner(min.x, min.y, max.z), corner(middle, max.y, max.z));
        let back = Vec3::Z * (min.z - max.z);
        self.rect(right, [back, ridge - right], [1, 1], [0.0, 0.0]);
        self.rect(left + back, [-back, ridge - left], [1, 1], [0.0, 0.0]);
        self.polygon(&[left, right, ridge], [Vec3::X, Vec3::Y]);
        self.polygon(&[right + back, left + back, ridge + back], [-Vec3::X, Vec3::Y]);
    }

    /// Colours all vertices; the material's colour is multiplied by it.
    pub(super) fn paint(&mut self, color: [u8; 3]) {
        for vertex in &mut self.vertices {
            vertex.color = [color[0], color[1], color[2], 255];
        }
    }
}

/// Lengths along a profile from its first point on.
fn arc_lengths(profile: &[[f32; 2]]) -> Vec<f32> {
    let mut lengths = vec![0.0];
    for pair in profile.windows(2) {
        let (dx, dy) = (pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
        lengths.push(lengths[lengths.len() - 1] + (dx * dx + dy * dy).sqrt());
    }
    lengths
}

/// One smooth surface under construction.
struct Patch {
    /// Vertices in a row, or 0 where the patch is no grid.
    row: usize,
    knots: Vec<Knot>,
    indices: Vec<u32>,
}

/// Sums over the triangles around a vertex.
#[derive(Clone, Copy, Default)]
struct Frame {
    normal: Vec3,
    u: Vec3,
    v: Vec3,
}

impl Patch {
    fn new(row: usize) -> Self {
        Self { row, knots: Vec::new(), indices: Vec::new() }
    }

    /// Adds a triangle unless it has no area (at a pole).
    fn triangle(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|k| self.knots[k as usize].0);
        if (b - a).cross(c - a).length_squared() > 1e-14 {
            self.indices.extend(corners);
        }
    }

    fn finish(self, mesh: &mut Mesh) {
        let mut frames = self.frames();
        if self.row > 0 {
            self.join_seams(&mut frames);
        }
        let base = mesh.vertices.len() as u32;
        mesh.vertices.extend(self.knots.iter().zip(&frames).map(|(knot, frame)| vertex(knot, frame)));
        mesh.indices.extend(self.indices.iter().map(|index| index + base));
    }

    /// Normals weighted by area, and directions of growing u and v.
    fn frames(&self) -> Vec<Frame> {
        let mut frames = vec![Frame::default(); self.knots.len()];
        for corners in self.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| self.knots[corners[k] as usize]);
            let (e1, e2) = (b.0 - a.0, c.0 - a.0);
            let d1 = [b.1[0] - a.1[0], b.1[1] - a.1[1]];
            let d2 = [c.1[0] - a.1[0], c.1[1] - a.1[1]];
            let sign = (d1[0] * d2[1] - d2[0] * d1[1]).signum();
            let normal = e1.cross(e2);
            let u = (e1 * d2[1] - e2 * d1[1]) * sign;
            let v = (e2 * d1[0] - e1 * d2[0]) * sign;
            for corner in corners {
                let frame = &mut frames[*corner as usize];
                frame.normal += normal;
                frame.u += u;
                frame.v += v;
            }
        }
        frames
    }

    /// Shares normals where the first and last column meet, and within a row that is one point.
    fn join_seams(&self, frames: &mut [Frame]) {
        let last = self.row - 1;
        let same = |a: usize, b: usize| self.knots[a].0.distance_squared(self.knots[b].0) < 1e-10;
        for start in (0..self.knots.len()).step_by(self.row) {
            let pole = same(start, start + last) && same(start, start + last / 2);
            if pole {
                let sum = frames[start..=start + last].iter().fold(Vec3::ZERO, |sum, f| sum + f.normal);
                frames[start..=start + last].iter_mut().for_each(|frame| frame.normal = sum);
            } else if same(start, start + last) {
                let sum = frames[start].normal + frames[start + last].normal;
                frames[start].normal = sum;
                frames[start + last].normal = sum;
            }
        }
        if self.knots.len() > self.row {
            self.join_rows(frames, same);
        }
    }

    /// Shares normals where the first and last row meet (a ring).
    fn join_rows(&self, frames: &mut [Frame], same: impl Fn(usize, usize) -> bool) {
        let top = self.knots.len() - self.row;
        for k in (0..self.row).filter(|k| same(*k, top + *k)) {
            let sum = frames[k].normal + frames[top + k].normal;
            frames[k].normal = sum;
            frames[top + k].normal = sum;
        }
    }
}

/// The finished vertex: unit normal, tangent at right angles to it, sign of the bitangent.
fn vertex((position, uv): &Knot, frame: &Frame) -> Vertex {
    let normal = frame.normal.normalize_or(Vec3::Y);
    let flat = frame.u - normal * normal.dot(frame.u);
    let tangent = flat.try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector());
    let sign = if normal.cross(tangent).dot(frame.v) < 0.0 { -1.0 } else { 1.0 };
    Vertex {
        position: (*position).into(),
        normal: normal.into(),
        tangent: tangent.extend(sign).into(),
        uv: [*uv, *uv],
        color: [255; 4],
    }
}
