//! Polygons into triangles.
//!
//! A polygon lies in no plane exactly: it is cut where its projection along its normal (Newell's, as in Sutherland,
//! Sproull and Schumacker, *A Characterization of Ten Hidden-Surface Algorithms*, 1974) is. One seen whole from its first
//! corner becomes a fan. Any other is triangulated between its edges (constrained Delaunay, by `spade`, whose predicates
//! are exact), and what an odd number of outlines surrounds is inside: so bridges to holes, corners met twice and corners
//! on edges are as they should be.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, Vec2Swizzles};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

/// Corners of the outline, counter-clockwise seen against its normal.
pub(super) type Triangle = [usize; 3];

/// Points on a line cost the triangulation the square of their number: for so many, some seconds.
const MOST_CORNERS: usize = 32_768;

/// What a polygon came out as.
#[derive(Debug, PartialEq)]
pub(super) enum Cut {
    /// Triangles that cover it once.
    Whole(Vec<Triangle>),
    /// A fan, which may reach outside, and of what polygon.
    Fan(Vec<Triangle>, &'static str),
    /// Nothing: it has no area.
    NoArea,
}

/// Cuts the polygon with this outline, three finite points at least, into triangles.
pub(super) fn triangulate(outline: &[DVec3]) -> Cut {
    if outline.len() == 3 {
        return Cut::Whole(vec![[0, 1, 2]]);
    }
    let Some(normal) = normal(outline) else { return Cut::NoArea };
    for points in [along_axis(outline, normal), along_normal(outline, normal)] {
        if sees_all(&points) {
            return Cut::Whole(fan(points.len()));
        }
        if points.len() > MOST_CORNERS {
            return Cut::Fan(fan(points.len()), "a concave polygon of more than 32768 corners");
        }
        match between_edges(&points) {
            Some(triangles) if triangles.is_empty() => return Cut::NoArea,
            Some(triangles) => return Cut::Whole(triangles),
            // Another projection may untangle it.
            None => {}
        }
    }
    Cut::Fan(fan(outline.len()), "a polygon whose outline crosses itself")
}

fn fan(corners: usize) -> Vec<Triangle> {
    (2..corners).map(|i| [0, i - 1, i]).collect()
}

/// Newell's normal, or one of the plane through the points that span most where the areas of the outline cancel.
/// `None` for points on a line.
fn normal(outline: &[DVec3]) -> Option<DVec3> {
    let origin = outline[0];
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    let newell: DVec3 = edges.map(|(&a, &b)| (a - origin).cross(b - origin)).sum();
    let far = outline.iter().map(|&p| p - origin).max_by(|a, b| a.length().total_cmp(&b.length()))?;
    let side = outline.iter().map(|&p| far.cross(p - origin));
    let widest = side.max_by(|a, b| a.length().total_cmp(&b.length()))?;
    // Rounding gives points on a line some area, about as the longest length squared goes.
    let least = far.length_squared() * 1e-12;
    let spans = |normal: &DVec3| normal.length() > least;
    [newell, widest].into_iter().find(spans)?.try_normalize()
}

/// Without the coordinate along which the normal is longest: exact, so that points on a line stay on it.
fn along_axis(outline: &[DVec3], normal: DVec3) -> Vec<DVec2> {
    let axis = normal.abs().max_position();
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let turned = normal[axis] < 0.0;
    outline.iter().map(|p| if turned { DVec2::new(p[v], p[u]) } else { DVec2::new(p[u], p[v]) }).collect()
}

/// On the plane across the normal.
fn along_normal(outline: &[DVec3], normal: DVec3) -> Vec<DVec2> {
    let (u, v) = normal.any_orthonormal_pair();
    let origin = outline[0];
    let project = |p: &DVec3| DVec2::new((p - origin).dot(u), (p - origin).dot(v));
    let points: Vec<_> = outline.iter().map(project).collect();
    let turns = u.cross(v).dot(normal) < 0.0;
    points.into_iter().map(|p| if turns { p.yx() } else { p }).collect()
}

/// Whether the whole polygon is seen from its first corner, within less than half a turn.
fn sees_all(points: &[DVec2]) -> bool {
    let [first, second, others @ ..] = points else { return false };
    let left = |a: DVec2, b: DVec2| (a - first).perp_dot(b - first) > 0.0;
    points[1..].windows(2).all(|pair| left(pair[0], pair[1])) && others.iter().all(|&p| left(*second, p))
}

/// A point of the plane where one or several corners lie.
struct Place {
    position: DVec2,
    /// The first of them.
    corner: usize,
}

impl HasPosition for Place {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        Point2::new(self.position.x, self.position.y)
    }
}

/// Triangles of what the outline surrounds; `None` where it crosses itself.
fn between_edges(points: &[DVec2]) -> Option<Vec<Triangle>> {
    let (places, place_of) = places(points);
    let mut plane = ConstrainedDelaunayTriangulation::<Place>::bulk_load_cdt(places, Vec::new()).ok()?;
    let mut outlines = Vec::new();
    for (i, &from) in place_of.iter().enumerate() {
        let to = place_of[(i + 1) % place_of.len()];
        if from == to {
            continue;
        }
        let edges = plane.try_add_constraint(from, to);
        if edges.is_empty() {
            return None;
        }
        outlines.resize(plane.num_undirected_edges(), 0);
        edges.iter().for_each(|edge| outlines[edge.as_undirected().index()] += 1);
    }
    Some(inside(&plane, &outlines))
}

/// The different points, and for each corner which of them.
fn places(points: &[DVec2]) -> (Vec<Place>, Vec<FixedVertexHandle>) {
    // The triangulation takes no smaller numbers; 0.0 also for -0.0, so that both are one key.
    let settled = |x: f64| if x.abs() < spade::MIN_ALLOWED_VALUE { 0.0 } else { x };
    let mut known = BTreeMap::new();
    let mut places = Vec::new();
    let mut place_of = Vec::with_capacity(points.len());
    for (corner, point) in points.iter().enumerate() {
        let position = DVec2::new(settled(point.x), settled(point.y));
        let place = *known.entry(position.to_array().map(f64::to_bits)).or_insert_with(|| {
            places.push(Place { position, corner });
            places.len() - 1
        });
        place_of.push(FixedVertexHandle::from_index(place));
    }
    (places, place_of)
}

/// The triangles that are reached from outside through an odd number of outlines; `outlines` counts them by edge.
fn inside(plane: &ConstrainedDelaunayTriangulation<Place>, outlines: &[u32]) -> Vec<Triangle> {
    let odd = |edge: usize| outlines.get(edge).is_some_and(|count| count % 2 == 1);
    let mut within = vec![None; plane.num_all_faces()];
    within[plane.outer_face().index()] = Some(false);
    let hull = plane.directed_edges().filter(|edge| edge.is_outer_edge());
    let mut reached: Vec<_> = hull.map(|edge| (edge.rev(), odd(edge.as_undirected().index()))).collect();
    while let Some((edge, here)) = reached.pop() {
        let Some(face) = edge.face().as_inner() else { continue };
        if within[face.index()].replace(here).is_none() {
            let edges = face.adjacent_edges().into_iter();
            reached.extend(edges.map(|edge| (edge.rev(), here != odd(edge.as_undirected().index()))));
        }
    }
    let faces = plane.inner_faces().filter(|face| within[face.index()] == Some(true));
    faces.map(|face| face.vertices().map(|vertex| vertex.data().corner)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(points: &[[f64; 2]]) -> Vec<DVec3> {
        points.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect()
    }

    fn normal_of(outline: &[DVec3], [a, b, c]: Triangle) -> DVec3 {
        (outline[b] - outline[a]).cross(outline[c] - outline[a]) / 2.0
    }

    /// The number of triangles, and the sums of their signed and unsigned areas seen along the z axis.
    fn areas(points: &[[f64; 2]]) -> (usize, f64, f64) {
        let outline = at(points);
        let Cut::Whole(triangles) = triangulate(&outline) else { panic!("not cut: {points:?}") };
        let area = |triangle: &Triangle| normal_of(&outline, *triangle).z;
        let signed = triangles.iter().map(area).sum();
        (triangles.len(), signed, triangles.iter().map(|triangle| area(triangle).abs()).sum())
    }

    const ARROW: [[f64; 2]; 4] = [[-1.0, -1.0], [0.0, 0.0], [1.0, -1.0], [0.0, 1.0]];

    #[test]
    fn concave_polygons_are_covered_once_from_every_corner_and_both_sides() {
        let comb: Vec<_> = (0..9).map(|i| [f64::from(i), if i % 2 == 0 { 0.0 } else { 3.0 }]).collect();
        let comb = [comb, vec![[8.0, 4.0], [0.0, 4.0]]].concat();
        for (points, area) in [(&ARROW[..], 1.0), (&comb[..], 20.0)] {
            for turn in 0..points.len() {
                let mut points = points.to_vec();
                points.rotate_left(turn);
                for _ in 0..2 {
                    points.reverse();
                    let (count, signed, unsigned) = areas(&points);
                    assert_eq!((count, unsigned), (points.len() - 2, area), "{points:?}");
                    assert_eq!(signed.abs(), area, "all wind alike: {points:?}");
                }
            }
        }
    }

    #[test]
    fn winding_follows_the_outline() {
        let arrow = at(&ARROW);
        let mut turned = arrow.clone();
        turned.reverse();
        for (outline, sign) in [(arrow, 1.0), (turned, -1.0)] {
            let Cut::Whole(triangles) = triangulate(&outline) else { panic!("not cut") };
            assert!(triangles.iter().all(|&triangle| normal_of(&outline, triangle).z * sign > 0.0));
        }
    }

    #[test]
    fn corners_on_a_line_stay() {
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]];
        assert_eq!(areas(&points), (4, 4.0, 4.0));
    }

    #[test]
    fn bridges_lead_to_holes_wound_either_way() {
        let outer = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]];
        let mut hole = [[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0], [1.0, 1.0]];
        for _ in 0..2 {
            assert_eq!(areas(&[outer, hole].concat()), (8, 12.0, 12.0));
            hole.reverse();
        }
    }

    #[test]
    fn outlines_may_touch_themselves() {
        // Two squares that share a corner, then a corner that lies on another edge.
        let corner =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [1.0, 1.0], [0.0, 1.0]];
        assert_eq!(areas(&corner), (4, 2.0, 2.0));
        let edge = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        assert_eq!(areas(&edge).2, 4.0);
    }

    #[test]
    fn polygons_out_of_plane_are_cut_along_their_normal() {
        let mut outline = at(&ARROW);
        outline[3].z = 0.5;
        let Cut::Whole(triangles) = triangulate(&outline) else { panic!("not cut") };
        assert_eq!(triangles.len(), 2);
        assert!(
            triangles.iter().all(|triangle| triangle.contains(&1)),
            "the notch is in both: {triangles:?}"
        );
        // In a plane across no axis.
        let turn = glam::DQuat::from_rotation_arc(DVec3::Z, DVec3::new(1.0, 2.0, -3.0).normalize());
        let outline: Vec<_> = at(&ARROW).into_iter().map(|p| turn * p).collect();
        let Cut::Whole(triangles) = triangulate(&outline) else { panic!("not cut") };
        let area: f64 =
            triangles.iter().map(|&triangle| normal_of(&outline, triangle).dot(turn * DVec3::Z)).sum();
        assert!((area - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_has_no_inside_is_said() {
        assert_eq!(triangulate(&at(&[[0.0, 0.0], [1.0, 1.0], [3.0, 3.0], [2.0, 2.0]])), Cut::NoArea);
        assert_eq!(triangulate(&[DVec3::ONE; 5]), Cut::NoArea);
        let spike = [[0.0, 0.0], [1.0, 0.0], [2.0, 1.0], [1.0, 0.0]];
        assert_eq!(triangulate(&at(&spike)), Cut::NoArea);
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        assert_eq!(
            triangulate(&at(&bow)),
            Cut::Fan(vec![[0, 1, 2], [0, 2, 3]], "a polygon whose outline crosses itself")
        );
    }

    #[test]
    fn sizes_at_the_ends_of_single_precision_are_cut() {
        for size in [1e-45_f32, 1e-40, 1e-3, 1e30, f32::MAX] {
            let outline: Vec<_> = at(&ARROW).into_iter().map(|p| p * f64::from(size)).collect();
            assert!(!matches!(triangulate(&outline), Cut::Fan(..)), "{size}");
        }
    }

    #[test]
    fn the_time_of_large_polygons_is_bounded() {
        let star = |corners: u32, notch: f64| {
            let point = |i: u32| {
                let radius = if i.is_multiple_of(2) { 1.0 } else { notch };
                let (y, x) = (f64::from(i) / f64::from(corners) * std::f64::consts::TAU).sin_cos();
                [x * radius, y * radius]
            };
            at(&(0..corners).map(point).collect::<Vec<_>>())
        };
        assert!(
            matches!(triangulate(&star(20_000, 0.9)), Cut::Whole(triangles) if triangles.len() == 19_998)
        );
        assert!(
            matches!(triangulate(&star(1_000_000, 1.0)), Cut::Whole(triangles) if triangles.len() == 999_998)
        );
        let Cut::Fan(triangles, what) = triangulate(&star(1_000_000, 0.9)) else { panic!("cut whole") };
        assert_eq!((triangles.len(), what), (999_998, "a concave polygon of more than 32768 corners"));
    }
}
