//! The lines of a still: what the cameras see and what the clusterings hold.

use crate::geometry::views::{Pose, View};
use crate::geometry::{ClusterSpace, Grid};
use crate::octree::{LinklessOctree, StoredKind};
use crate::pipelines::Line;
use glam::DVec3;

/// Frusta of rendering cameras: green (Gelderen figure 4.8).
const VIEW: [f32; 3] = [0.15, 0.9, 0.2];
/// Frusta and boxes of clusterings: red.
const CLUSTERING: [f32; 3] = [0.8, 0.02, 0.02];

/// Pairs of corners that differ in one bit: the edges of a box, and of a frustum.
const EDGES: [(usize, usize); 12] =
    [(0, 1), (2, 3), (4, 5), (6, 7), (0, 2), (1, 3), (4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7)];

/// The frusta of the views, and of the clusterings their frusta (from the apex on) or boxes.
pub fn frusta(views: &[View], grids: &[Grid]) -> Vec<Line> {
    let mut lines = vec![];
    for view in views {
        edges(&mut lines, &view.pose, &view.frustum.corners(), VIEW);
    }
    for grid in grids {
        match grid.space {
            ClusterSpace::Perspective { frustum, .. } => {
                let corners = frustum.corners();
                edges(&mut lines, &grid.pose, &corners, CLUSTERING);
                for near in &corners[..4] {
                    lines.push(line(&grid.pose, (DVec3::ZERO, *near), CLUSTERING));
                }
            }
            ClusterSpace::Orthographic { min, max } => {
                let corner = |i: usize| {
                    let side = |axis: usize| if i >> axis & 1 == 0 { min[axis] } else { max[axis] };
                    DVec3::new(side(0), side(1), side(2))
                };
                edges(&mut lines, &grid.pose, &std::array::from_fn(corner), CLUSTERING);
            }
        }
    }
    lines
}

/// The edges of an octree's leaves with lights, relative to `origin`; of each depth in a hue of its own.
pub fn leaves(octree: &LinklessOctree, origin: DVec3) -> Vec<Line> {
    let frame = &octree.frame;
    let pose = Pose::from_position(frame.origin - origin);
    let mut lines = vec![];
    for leaf in octree.stored_nodes().iter().filter(|node| node.kind == StoredKind::Leaf) {
        let edge = frame.edge(leaf.depth);
        let low = leaf.cell.as_dvec3() * edge;
        let corner = |i: usize| low + edge * DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
        edges(&mut lines, &pose, &std::array::from_fn(corner), hue(frame.depth - leaf.depth));
    }
    lines
}

/// A saturated colour for leaves so many depths above the deepest, far from those of its neighbours.
fn hue(above: u32) -> [f32; 3] {
    // Each turn of the golden ratio lies where the earlier ones left most room.
    let turn = (f64::from(above) * 0.618_033_988_75).fract();
    [0.0, 2.0 / 3.0, 1.0 / 3.0].map(|shift| {
        let distance = ((turn + shift).fract() - 0.5).abs();
        (6.0 * distance - 1.0).clamp(0.02, 1.0) as f32
    })
}

/// The edges of a box, or of a frustum, by its corners in the space of `pose`, metres.
pub fn edges(lines: &mut Vec<Line>, pose: &Pose, corners: &[DVec3; 8], tint: [f32; 3]) {
    lines.extend(EDGES.iter().map(|&(a, b)| line(pose, (corners[a], corners[b]), tint)));
}

/// A line between two places in the space of `pose`, metres.
pub fn line(pose: &Pose, (from, to): (DVec3, DVec3), tint: [f32; 3]) -> Line {
    let world = |point| pose.transform_point(point).as_vec3().to_array();
    Line { from: world(from), to: world(to), tint }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Frustum;

    #[test]
    fn every_corner_has_three_edges_and_lies_where_it_should() {
        let frustum = Frustum { x0: -1.0, x1: 2.0, y0: -0.5, y1: 0.5, z0: -10.0, z1: -1.0 };
        let view = View { pose: Pose::from_position(DVec3::new(0.0, 0.0, 5.0)), frustum };
        let lines = frusta(&[view], &[]);
        assert_eq!(lines.len(), 12);
        for corner in frustum.corners() {
            let corner = (corner + DVec3::new(0.0, 0.0, 5.0)).as_vec3().to_array();
            let ends = lines.iter().filter(|line| line.from == corner || line.to == corner);
            assert_eq!(ends.count(), 3, "{corner:?}");
        }
        let lengths = lines.iter().map(|line| glam::Vec3::from(line.from).distance(line.to.into()));
        assert!(lengths.into_iter().all(|length| length < 32.0), "no edge is a diagonal of the far plane");
    }

    #[test]
    fn leaves_are_boxes_of_their_depth() {
        use crate::geometry::LightVolume;
        use crate::octree::OctreeSettings;
        let light = LightVolume::sphere(DVec3::splat(1.0), 4.0);
        let octree = LinklessOctree::build(&[light], &OctreeSettings::new(1.0, 0)).unwrap().octree;
        let origin = DVec3::new(100.0, 0.0, 0.0);
        let lines = leaves(&octree, origin);
        let filled: u32 = octree.layers.iter().filter_map(|layer| layer.data).map(|data| data.keys).sum();
        assert_eq!(lines.len(), 12 * filled as usize);
        for line in &lines {
            let [from, to] = [line.from, line.to].map(|end| glam::Vec3::from(end).as_dvec3() + origin);
            let edge = from.distance(to).round();
            assert!([1.0, 2.0, 4.0].contains(&edge), "{edge}");
            let middle = 0.5 * (from + to);
            assert!(middle.distance(light.centre) < light.radius + edge * 3f64.sqrt(), "{middle}");
        }
        let hues: std::collections::BTreeSet<_> = (0..6).map(|above| hue(above).map(f32::to_bits)).collect();
        assert_eq!(hues.len(), 6, "depths are told apart");
    }

    #[test]
    fn boxes_and_displaced_frusta_are_drawn_too() {
        let space = ClusterSpace::Orthographic { min: DVec3::splat(-1.0), max: DVec3::splat(1.0) };
        let boxed = Grid { pose: Pose::IDENTITY, space, dimensions: [1; 3] };
        let lines = frusta(&[], &[boxed]);
        assert!(lines.iter().all(|line| glam::Vec3::from(line.from).distance(line.to.into()) == 2.0));
        let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -1.0, y1: 1.0, z0: -132.0, z1: -32.4 };
        let space = ClusterSpace::geometric(frustum, 0.1);
        let displaced = Grid { pose: Pose::IDENTITY, space, dimensions: [1; 3] };
        assert_eq!(frusta(&[], &[displaced]).len(), 16);
    }
}
