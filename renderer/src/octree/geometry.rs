//! An octree only where there is geometry (Tegelaers section 8.2.1, which designs it).
//!
//! ```text
//! scene's octree ─┐
//! triangles ──────┴─ down together, each node with the triangles that meet it ─ without any: no node
//!                                        └ up again: siblings with geometry that agree ─ one leaf
//! ```
//!
//! What is shaded lies on geometry, so that what the tables say of other cells is never asked for. The geometry's own octree
//! is not built: a leaf of the scene's is kept where a triangle meets it.

use super::frame::OctreeFrame;
use super::tree::{Node, child_cell};
use glam::{DVec3, UVec3};
use rayon::prelude::*;

/// Nodes above this depth are worked on by several cores at once.
const SHARED_DEPTH: u32 = 4;

/// What can be shaded: everything, also what lets light through, in each place where it may be while an octree serves.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OctreeGeometry {
    triangles: Vec<[DVec3; 3]>,
    slack: f64,
}

impl OctreeGeometry {
    /// Triangles in world space, metres. What is looked up lies within `slack` metres of them along each axis.
    pub fn new(triangles: impl IntoIterator<Item = [DVec3; 3]>, slack: f64) -> Self {
        Self { triangles: triangles.into_iter().collect(), slack }
    }

    /// What of a tree is where geometry is. Leaves elsewhere are empty, or part of a merged one.
    pub(super) fn trim(&self, tree: &Node, frame: &OctreeFrame) -> Node {
        let trim = Trim { triangles: &self.triangles, slack: self.slack, frame };
        let all: Vec<u32> = (0..self.triangles.len() as u32).collect();
        trim.node(tree, &all, 0, UVec3::ZERO).unwrap_or(Node::EMPTY)
    }
}

/// What nodes are trimmed by.
struct Trim<'a> {
    triangles: &'a [[DVec3; 3]],
    slack: f64,
    frame: &'a OctreeFrame,
}

impl Trim<'_> {
    /// What is left of a node; `None` where no triangle, of those that meet its parent, meets it.
    fn node(&self, node: &Node, candidates: &[u32], depth: u32, cell: UVec3) -> Option<Node> {
        let edge = self.frame.edge(depth);
        let centre = self.frame.origin + (cell.as_dvec3() + 0.5) * edge;
        let half = DVec3::splat(0.5 * edge + self.slack);
        let meets = |index: &u32| meets_box(&self.triangles[*index as usize], centre, half);
        let Node::Branch(children) = node else {
            return candidates.iter().any(meets).then(|| node.clone());
        };
        let within: Vec<u32> = candidates.iter().copied().filter(meets).collect();
        if within.is_empty() {
            return None;
        }
        let child = |child: usize| self.node(&children[child], &within, depth + 1, child_cell(cell, child));
        let children: Vec<Option<Node>> = if depth < SHARED_DEPTH {
            (0..8).into_par_iter().map(child).collect()
        } else {
            (0..8).map(child).collect()
        };
        // The layers split leaves that reach up to the starting depth.
        parent(children, depth > self.frame.start_depth)
    }
}

/// The parent of children, of which some have no geometry; a leaf, where it may be one and those with geometry agree.
fn parent(children: Vec<Option<Node>>, may_merge: bool) -> Option<Node> {
    let mut with = children.iter().flatten();
    let first = with.next()?;
    if may_merge && matches!(first, Node::Leaf(_)) && with.all(|child| child == first) {
        return Some(first.clone());
    }
    let children: Vec<Node> = children.into_iter().map(|child| child.unwrap_or(Node::EMPTY)).collect();
    Some(Node::Branch(children.try_into().expect("a node has 8 children")))
}

/// Whether a triangle meets a box along the axes, by the thirteen directions that can part them (Akenine-Moeller 2001): the
/// box's axes, the triangle's normal, and what is perpendicular to an axis and an edge.
fn meets_box(triangle: &[DVec3; 3], centre: DVec3, half: DVec3) -> bool {
    let corners = triangle.map(|corner| corner - centre);
    let [a, b, c] = corners;
    let edges = [b - a, c - b, a - c];
    let parts = |axis: DVec3| {
        let along = corners.map(|corner| axis.dot(corner));
        let reach = axis.abs().dot(half);
        let (low, high) =
            along.iter().fold((f64::MAX, f64::MIN), |(low, high), at| (low.min(*at), high.max(*at)));
        low > reach || high < -reach
    };
    let across = DVec3::AXES.into_iter().flat_map(|axis| edges.map(|edge| axis.cross(edge)));
    !(DVec3::AXES.into_iter().any(parts) || parts(edges[0].cross(edges[1])) || across.into_iter().any(parts))
}

#[cfg(test)]
mod tests {
    use super::super::{LinklessOctree, OctreeSettings};
    use super::*;
    use crate::geometry::LightVolume;
    use proptest::prelude::*;

    type Point = [f64; 3];

    fn triangle() -> impl Strategy<Value = [Point; 3]> {
        let point = || [-4.0..4.0f64, -4.0..4.0f64, -4.0..4.0f64];
        [point(), point(), point()]
    }

    fn light() -> impl Strategy<Value = LightVolume> {
        let light = ([-4.0..4.0f64, -4.0..4.0f64, -4.0..4.0f64], 0.3..3.0f64);
        light.prop_map(|(centre, radius)| LightVolume::sphere(DVec3::from_array(centre), radius))
    }

    /// Points all over a triangle.
    fn samples([a, b, c]: [DVec3; 3]) -> impl Iterator<Item = DVec3> {
        (0..=12_u32).flat_map(move |i| {
            (0..=12 - i).map(move |j| a + (b - a) * (f64::from(i) / 12.0) + (c - a) * (f64::from(j) / 12.0))
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]

        #[test]
        fn geometry_is_told_the_same_as_by_the_whole_octree(
            lights in proptest::collection::vec(light(), 0..10),
            triangles in proptest::collection::vec(triangle(), 0..4),
            node in 0.2..1.0f64, start in 0..4_u32,
        ) {
            let triangles: Vec<_> = triangles.into_iter().map(|corners| corners.map(DVec3::from_array)).collect();
            let settings = OctreeSettings::new(node, start);
            let whole = LinklessOctree::build(&lights, &settings).unwrap().octree;
            let geometry = OctreeGeometry::new(triangles.clone(), 1e-9);
            let trimmed = LinklessOctree::build_for(&lights, &geometry, &settings).unwrap().octree;
            for point in triangles.into_iter().flat_map(samples) {
                prop_assert_eq!(trimmed.lights_at(point), whole.lights_at(point), "{}", point);
            }
            prop_assert!(trimmed.indices.len() <= whole.indices.len());
        }

        /// Of a box and a triangle that meet, the box has a point of it; those found apart have none.
        #[test]
        fn boxes_meet_the_triangles_that_they_share_points_with(
            corners in triangle(), centre in [-4.0..4.0f64, -4.0..4.0f64, -4.0..4.0f64], half in 0.1..2.0f64,
        ) {
            let (triangle, centre) = (corners.map(DVec3::from_array), DVec3::from_array(centre));
            let away = samples(triangle).map(|point| (point - centre).abs().max_element() - half).fold(f64::MAX, f64::min);
            // Samples lie at most a twelfth of the longest edge, 14 m, from any point of the triangle.
            if meets_box(&triangle, centre, DVec3::splat(half)) {
                prop_assert!(away < 14.0 / 12.0, "{away}");
            } else {
                prop_assert!(away > 0.0, "{away}");
            }
        }
    }

    #[test]
    fn a_box_beside_an_edge_does_not_meet_the_triangle() {
        // The box lies within the box around the triangle and meets its plane.
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        assert!(!meets_box(&triangle, DVec3::new(0.8, 0.8, 0.0), DVec3::splat(0.25)));
        assert!(meets_box(&triangle, DVec3::new(0.6, 0.6, 0.0), DVec3::splat(0.25)));
    }

    #[test]
    fn a_floor_takes_a_part_of_what_the_room_does() {
        let corner = |x: f64, z: f64| DVec3::new(x, -0.9, z);
        let floor = [
            [corner(-9.0, -9.0), corner(9.0, -9.0), corner(9.0, 9.0)],
            [corner(-9.0, -9.0), corner(9.0, 9.0), corner(-9.0, 9.0)],
        ];
        let lights: Vec<LightVolume> =
            (0..30).map(|at| LightVolume::sphere(DVec3::new(0.2 * f64::from(at), 0.0, 0.1), 1.0)).collect();
        let settings = OctreeSettings::new(0.1, 2);
        let whole = LinklessOctree::build(&lights, &settings).unwrap().octree;
        let trimmed =
            LinklessOctree::build_for(&lights, &OctreeGeometry::new(floor, 1e-6), &settings).unwrap().octree;
        assert!(trimmed.bytes() * 5 < whole.bytes(), "{} {}", trimmed.bytes(), whole.bytes());
        let nothing =
            LinklessOctree::build_for(&lights, &OctreeGeometry::default(), &settings).unwrap().octree;
        assert_eq!(nothing.indices.len(), 0);
    }
}
