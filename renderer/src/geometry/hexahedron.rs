//! What a spot light reaches against a cell of eight corners: a piece of a frustum, or a box along any axes.
//!
//! Exact: the point of the cell that is nearest to the light's apex, of all within its cone, is the apex itself, or lies in a
//! face, where it is the hit of the ray that leads through the cone to the face's plane most directly, or on an edge, where it
//! is the nearest point of the piece that the cone cuts off. Conservative: axes along which the two lie apart.

use super::oriented_box::OrientedBox;
use super::sector::SphericalSector;
use super::{Grid, Plane};
use glam::DVec3;

/// A convex cell with the corners of a box: bit 0, 1 and 2 of the position choose the upper side along x, y and z. Sides may have
/// no extent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hexahedron {
    /// Corners, metres.
    pub corners: [DVec3; 8],
    /// Planes of the faces, inwards.
    pub planes: [Plane; 6],
}

impl Hexahedron {
    /// A cluster, in clustering space.
    pub fn of_cell(grid: &Grid, cell: [u32; 3]) -> Self {
        Self { corners: grid.cell_corners(cell), planes: grid.cell_planes(cell) }
    }

    /// A box, in its own space.
    pub fn of_box(of: &OrientedBox) -> Self {
        let side = |corner: usize, axis: usize| {
            let half = of.axes[axis] * of.half_extent[axis];
            if corner >> axis & 1 == 1 { half } else { -half }
        };
        let corner = |corner| of.center + side(corner, 0) + side(corner, 1) + side(corner, 2);
        let plane = |plane: usize| {
            let (axis, normal) = (plane / 2, of.axes[plane / 2] * [1.0, -1.0][plane % 2]);
            Plane { normal, offset: of.half_extent[axis] - normal.dot(of.center) }
        };
        Self { corners: std::array::from_fn(corner), planes: std::array::from_fn(plane) }
    }

    /// Ends of the edges; some may be the same point.
    fn edges(&self) -> impl Iterator<Item = [DVec3; 2]> {
        let ends = |axis: usize, corner: usize| [corner, corner | 1 << axis];
        let all = (0..3).flat_map(move |axis| (0..8).map(move |corner| ends(axis, corner)));
        all.filter(|[from, to]| from != to).map(|ends| ends.map(|corner| self.corners[corner]))
    }

    /// Lowest and highest of the corners along an axis.
    fn extent(&self, axis: DVec3) -> [f64; 2] {
        let along = self.corners.map(|corner| axis.dot(corner));
        [along.into_iter().fold(f64::INFINITY, f64::min), along.into_iter().fold(f64::NEG_INFINITY, f64::max)]
    }

    fn centre(&self) -> DVec3 {
        self.corners.iter().sum::<DVec3>() / 8.0
    }

    /// Distance, from the apex, of the nearest of the cell's points that lie within the sector's endless cone, metres; infinite
    /// where there are none. The cell meets the sector where it is no more than the range.
    pub fn least_distance(&self, sector: &SphericalSector) -> f64 {
        if self.holds(sector.apex) { 0.0 } else { self.distances(sector).fold(f64::INFINITY, f64::min) }
    }

    /// Whether the sector meets the cell.
    pub fn meets(&self, sector: &SphericalSector) -> bool {
        self.holds(sector.apex) || self.distances(sector).any(|distance| distance <= sector.range)
    }

    fn holds(&self, point: DVec3) -> bool {
        self.planes.iter().all(|plane| plane.distance(point) >= 0.0)
    }

    /// Distances, from an apex outside the cell, of points within the sector's endless cone, the nearest among them.
    fn distances(&self, sector: &SphericalSector) -> impl Iterator<Item = f64> {
        let cone = Cone::of(sector);
        let edges = self.edges().filter_map(move |edge| along_edge(edge, &cone));
        edges.chain((0..6).filter_map(|face| self.through_face(face, sector)))
    }

    /// Distance of the plane of a face along the cone's most direct ray, where that hits within the face.
    fn through_face(&self, face: usize, sector: &SphericalSector) -> Option<f64> {
        let plane = self.planes[face];
        let behind = -plane.distance(sector.apex);
        let ray = sector.nearest_direction(plane.normal);
        let slope = plane.normal.dot(ray);
        if behind <= 0.0 || slope <= 0.0 {
            return None;
        }
        let hit = sector.apex + ray * (behind / slope);
        // Of what has no extent, the face on the other side is the same plane.
        let slack = |plane: &Plane| ROUNDING * (plane.offset.abs() + hit.length());
        self.planes.iter().all(|plane| plane.distance(hit) >= -slack(plane)).then_some(behind / slope)
    }

    /// Signed margin of the exact test, metres: at least 0 where they meet. Its size is how far the sector or the corners may
    /// move before the answer is another, at least.
    pub fn sector_margin(&self, sector: &SphericalSector) -> f64 {
        let meets = |sector: SphericalSector| self.meets(&sector);
        let answer = meets(*sector);
        let sign = if answer { 1.0 } else { -1.0 };
        // A larger sector holds what is around this one, so that whoever misses it is at least as far away.
        let stays = |by: f64| sector.grown(-sign * by).is_some_and(meets) == answer;
        let farthest = sector.range.max(self.centre().distance(sector.apex));
        let steps = (0..MARGIN_STEPS).map(|step| farthest * 0.5f64.powi(step));
        sign * steps.into_iter().find(|by| stays(*by)).unwrap_or(0.0)
    }

    /// Signed margin of the conservative test, metres: below 0 where some axis separates the two. Its size is how far the sector
    /// or the corners may move before the answer is another, at least.
    pub fn separation_margin(&self, sector: &SphericalSector) -> f64 {
        let of_planes =
            self.planes.iter().map(|plane| plane.distance(sector.apex) + sector.reach(plane.normal));
        let least = of_planes.fold(f64::INFINITY, f64::min);
        let of_axis = [sector.axis, -sector.axis].into_iter().map(|axis| self.overlap(sector, axis));
        let centre = self.centre();
        let sides = self.corners.into_iter().chain([centre]).map(|point| self.overlap_beside(sector, point));
        of_axis.chain(sides).chain([self.overlap_towards(sector, centre)]).fold(least, f64::min)
    }

    /// How far the sector reaches into the cell along a unit axis, metres; below 0 where the axis separates them.
    fn overlap(&self, sector: &SphericalSector, axis: DVec3) -> f64 {
        sector.support(axis) - self.extent(axis)[0]
    }

    /// Margin of the axis from the apex to a point of the cell.
    fn overlap_towards(&self, sector: &SphericalSector, point: DVec3) -> f64 {
        let offset = point - sector.apex;
        self.turning_overlap(sector, offset, offset.length())
    }

    /// Margin of the axis across the side of the cone that faces a point of the cell.
    fn overlap_beside(&self, sector: &SphericalSector, point: DVec3) -> f64 {
        let across = (point - sector.apex).reject_from_normalized(sector.axis);
        let (sine, cosine) = sector.half_angle.sin_cos();
        let normal = across * cosine - sector.axis * (sine * across.length());
        self.turning_overlap(sector, normal, across.length())
    }

    /// Margin of an axis that turns when what it comes from moves: the more, the shorter that is. Without length, an axis separates
    /// nothing.
    fn turning_overlap(&self, sector: &SphericalSector, axis: DVec3, length: f64) -> f64 {
        let farthest = self.corners.iter().map(|corner| corner.distance(sector.apex)).fold(0.0, f64::max);
        let margin = |axis| self.overlap(sector, axis) / (1.0 + farthest / length);
        axis.try_normalize().map_or(f64::INFINITY, margin)
    }
}

/// Halvings of a margin: to a billionth of what is farthest.
const MARGIN_STEPS: i32 = 30;

/// Rounding of a sum, in parts of what is summed.
const ROUNDING: f64 = 1e-12;

/// The endless cone of a sector, with the sine and the cosine of its half angle.
#[derive(Clone, Copy)]
struct Cone {
    apex: DVec3,
    axis: DVec3,
    sine: f64,
    cosine: f64,
}

impl Cone {
    fn of(sector: &SphericalSector) -> Self {
        let (sine, cosine) = sector.half_angle.sin_cos();
        Self { apex: sector.apex, axis: sector.axis, sine, cosine }
    }
}

/// Distance, from the apex, of the nearest point of an edge within the cone.
fn along_edge([from, to]: [DVec3; 2], cone: &Cone) -> Option<f64> {
    let (start, step) = (from - cone.apex, to - from);
    let [low, high] = within_cone(start, step, cone)?;
    let nearest = -start.dot(step) / step.length_squared();
    // Without length, any place is the nearest.
    let nearest = if nearest.is_nan() { low } else { nearest.clamp(low, high) };
    Some((start + step * nearest).length())
}

/// From where to where the points `start` + t `step`, t in 0..=1, lie within the cone, relative to its apex. They are within
/// where c |across| <= s along, c and s the cosine and sine of the half angle: the ends are among the zeros of
/// s^2 along^2 - c^2 |across|^2 with along >= 0, for the other zeros are those of the cone behind the apex.
fn within_cone(start: DVec3, step: DVec3, cone: &Cone) -> Option<[f64; 2]> {
    let Cone { axis, sine, cosine, .. } = *cone;
    let split = |vector: DVec3| {
        let along = axis.dot(vector);
        (along, vector - axis * along)
    };
    let ((along, across), (along_step, across_step)) = (split(start), split(step));
    let is_within = |t: f64| cosine * (across + across_step * t).length() <= sine * (along + along_step * t);
    let ends = [is_within(0.0), is_within(1.0)];
    if ends == [true, true] {
        return Some([0.0, 1.0]);
    }
    let square = |a: f64| a * a;
    let [ss, cc] = [square(sine), square(cosine)];
    let a = ss * square(along_step) - cc * across_step.length_squared();
    let b = ss * along * along_step - cc * across.dot(across_step);
    let c = ss * square(along) - cc * across.length_squared();
    // b^2 - a c, with what is in both left out.
    let turn = axis.dot(across.cross(across_step));
    let tilt = across_step * along - across * along_step;
    let discriminant = cc * (ss * tilt.length_squared() - cc * square(turn));
    let root = discriminant.max(0.0).sqrt();
    let sum = -(b + root.copysign(b));
    let zeros = if discriminant < 0.0 { [f64::NAN; 2] } else { [sum / a, c / sum] };
    // Of a right angle, a zero lies at along = 0.
    let least = -ROUNDING * (along.abs() + along_step.abs());
    let kept = zeros.map(|t| ((0.0..=1.0).contains(&t) && along + along_step * t >= least).then_some(t));
    let kept = || kept.into_iter().flatten();
    let low = if ends[0] { Some(0.0) } else { kept().reduce(f64::min) };
    let high = if ends[1] { Some(1.0) } else { kept().reduce(f64::max) };
    match (low, high) {
        (Some(low), Some(high)) => Some([low.min(high), high]),
        // An end within, and the zero beside it lost to rounding.
        (Some(end), None) | (None, Some(end)) => Some([end, end]),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests;
