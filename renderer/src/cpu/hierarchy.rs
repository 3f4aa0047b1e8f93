//! The light hierarchy: how it is built from the candidates, and how visible clusters go down it.

use super::{FoundLists, Visible};
use crate::assign::{sort_passes, tree_depth};
use crate::geometry::{CellTest, ClusterSpace, Grid, LightVolume, Plane, SphereTest};
use crate::gpu_interface::{SORT_BITS, TREE_WIDTH};
use glam::{DVec3, Vec3};

/// A candidate's key: the higher bits of the Morton code of its place in the grid's bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// The higher bits of the Morton code.
    pub key: u32,
    /// Whether f32 may round to another place.
    pub borderline: bool,
}

/// Places along an axis that a Morton code tells apart.
const PLACES: f64 = 1024.0;

/// The keys of candidates (their `volumes`) out of `lights` lights; `epsilon`, in places, is how close to the
/// next place one is borderline.
pub fn keys(grid: &Grid, volumes: &[LightVolume], lights: u32, epsilon: f64) -> Vec<Key> {
    let (low, high) = grid.bounds();
    let kept_bits = SORT_BITS * sort_passes(lights);
    let key = |volume: &LightVolume| {
        let at = (volume.centre - low) * PLACES / (high - low);
        let within = at.clamp(DVec3::ZERO, DVec3::splat(PLACES - 1.0));
        let morton = interleave(within.to_array().map(|place| place as u32));
        let close = (at - at.round()).abs().min_element() < epsilon;
        Key { key: morton >> (30 - kept_bits), borderline: close }
    };
    volumes.iter().map(key).collect()
}

/// Ten bits of each of three numbers, in turn, x lowest.
fn interleave(places: [u32; 3]) -> u32 {
    (0..30).map(|bit| (places[bit % 3] >> (bit / 3) & 1) << bit).sum()
}

/// Numbers of candidates in the order of their keys; equal keys keep the order of candidates.
pub fn sorted(keys: &[u32]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..keys.len() as u32).collect();
    order.sort_by_key(|&candidate| keys[candidate as usize]);
    order
}

/// A node: the centres of its lights lie in a box, their radii are at most `radius`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Centre of the box that holds the centres of the node's lights, metres.
    pub centre: Vec3,
    /// Half the size of that box, metres.
    pub half_extent: Vec3,
    /// Largest radius of the node's lights, metres.
    pub radius: f32,
}

/// A tree over sorted lights.
#[derive(Debug, Clone, PartialEq)]
pub struct Tree {
    /// The nodes of each depth from 1 on, as far as there are lights under them.
    pub depths: Vec<Vec<Node>>,
    /// Volumes of the lights in the order of the tree.
    pub volumes: Vec<LightVolume>,
}

/// Rounding of the sums in node tests and of the boxes themselves, in parts of the coordinates.
const NODE_SLACK: f32 = 4e-6;

/// The tree over candidates in order, out of `lights` lights, in f32 as on the device.
pub fn build_nodes(volumes: Vec<LightVolume>, lights: u32) -> Tree {
    let point = |volume: &LightVolume| {
        let centre = volume.centre.as_vec3();
        (centre, centre, volume.radius as f32)
    };
    let boxed = |node: &Node| (node.centre - node.half_extent, node.centre + node.half_extent, node.radius);
    let width = TREE_WIDTH as usize;
    let mut depths: Vec<Vec<Node>> = vec![];
    for _ in 1..tree_depth(lights) {
        let nodes = match depths.last() {
            None => volumes.chunks(width).map(|children| node(children.iter().map(point))).collect(),
            Some(below) => below.chunks(width).map(|children| node(children.iter().map(boxed))).collect(),
        };
        depths.push(nodes);
    }
    depths.reverse();
    Tree { depths, volumes }
}

/// The node around boxes (low, high) with radii.
fn node(children: impl Iterator<Item = (Vec3, Vec3, f32)>) -> Node {
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY, 0f32);
    let (low, high, radius) =
        children.fold(start, |all, (low, high, radius)| (all.0.min(low), all.1.max(high), all.2.max(radius)));
    let (centre, half_extent) = (0.5 * (low + high), 0.5 * (high - low));
    let slack = NODE_SLACK * ((centre.abs() + half_extent).max_element() + radius);
    Node { centre, half_extent: half_extent + slack, radius: radius + slack }
}

/// What going down a tree finds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Descent {
    /// Lists of the visible clusters, whose lights are named by their place in the tree.
    pub lists: FoundLists,
    /// Tests of nodes and lights.
    pub tests: u64,
    /// How many tests more or less f32 may make, at most.
    pub borderline_tests: u64,
}

/// Nodes of this depth are where clusters start.
const TREE_CUT: usize = 2;

/// Takes every visible cluster down `tree`; `epsilon`, in metres, is how small a margin makes an answer borderline.
pub fn descend(visible: &Visible, tree: &Tree, test: SphereTest, epsilon: f64) -> Descent {
    let mut found = Descent { lists: FoundLists::default(), tests: 0, borderline_tests: 0 };
    for &cluster in visible.clusters {
        let cell = visible.grid.cluster_at(cluster);
        let walk = Walk {
            tree,
            lights: CellTest::new(test, visible.grid, cell),
            nodes: NodeTest::new(test, visible.grid, cell),
            epsilon,
        };
        found.lists.start_list();
        let depth = TREE_CUT.min(tree.depths.len());
        for place in 0..tree.depths[depth - 1].len() {
            walk.visit(depth, place, &mut found);
        }
    }
    found
}

/// One cluster on its way.
struct Walk<'a> {
    tree: &'a Tree,
    lights: CellTest,
    nodes: NodeTest,
    epsilon: f64,
}

impl Walk<'_> {
    /// Tests a node and, where it may meet the cluster, what lies under it.
    fn visit(&self, depth: usize, place: usize, found: &mut Descent) {
        found.tests += 1;
        let margin = self.nodes.margin(&self.tree.depths[depth - 1][place]);
        if margin.abs() < self.epsilon {
            found.borderline_tests += self.tests_under(depth, place);
        }
        if margin < 0.0 {
            return;
        }
        let children = self.children(depth, place);
        if depth < self.tree.depths.len() {
            children.for_each(|child| self.visit(depth + 1, child, found));
            return;
        }
        found.tests += children.len() as u64;
        for light in children {
            found.lists.add(light as u32, self.lights.margin(&self.tree.volumes[light]), self.epsilon);
        }
    }

    /// Places under a node: nodes of the next depth, or lights.
    fn children(&self, depth: usize, place: usize) -> std::ops::Range<usize> {
        let there = self.tree.depths.get(depth).map_or(self.tree.volumes.len(), Vec::len);
        let width = TREE_WIDTH as usize;
        place * width..((place + 1) * width).min(there)
    }

    /// All tests that a hit may lead to.
    fn tests_under(&self, depth: usize, place: usize) -> u64 {
        let children = self.children(depth, place);
        let deeper = depth < self.tree.depths.len();
        children.map(|child| 1 + if deeper { self.tests_under(depth + 1, child) } else { 0 }).sum()
    }
}

/// A cluster against nodes. Never misses a node with a light that the cluster's own test lets through.
struct NodeTest {
    planes: [Plane; 6],
    /// The nearest point is asked, of a box: lowest and highest corner.
    nearest: Option<(DVec3, DVec3)>,
    bounded: bool,
}

impl NodeTest {
    fn new(test: SphereTest, grid: &Grid, cell: [u32; 3]) -> Self {
        let boxes = matches!(grid.space, ClusterSpace::Orthographic { .. });
        let nearest = test == SphereTest::Box || boxes && test == SphereTest::Exact;
        Self {
            planes: grid.cell_planes(cell),
            nearest: nearest.then(|| grid.cell_bounds(cell)),
            bounded: test.is_bounded(boxes),
        }
    }

    /// Margin, metres: below 0 where no sphere of the node can meet the cluster.
    fn margin(&self, node: &Node) -> f64 {
        let (centre, half, radius) =
            (node.centre.as_dvec3(), node.half_extent.as_dvec3(), f64::from(node.radius));
        if !self.bounded {
            return f64::INFINITY;
        }
        if let Some((low, high)) = self.nearest {
            return radius - centre.distance(centre.clamp(low - half, high + half));
        }
        let distance = |plane: &Plane| plane.distance(centre) + plane.normal.abs().dot(half);
        self.planes.iter().map(distance).fold(f64::INFINITY, f64::min) + radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::tests::{frustum_grid, row, volumes};

    #[test]
    fn keys_interleave_the_places_and_order_is_stable() {
        assert_eq!(interleave([1, 0, 0]), 1);
        assert_eq!(interleave([0b11, 0b01, 0b10]), 0b101_011);
        assert_eq!(interleave([1023; 3]), (1 << 30) - 1);
        assert_eq!(sorted(&[5, 2, 5, 0, 2]), [3, 1, 4, 0, 2]);
        let ends = [0.001, 9.0].map(|x| LightVolume::sphere(DVec3::splat(x), 1.0));
        let low = keys(&row(4), &ends, 2, 1e-3);
        assert_eq!((low[0].key, low[1].key), (0, (1 << 7) - 1));
    }

    #[test]
    fn nodes_hold_what_is_under_them() {
        let volumes = volumes(100);
        let tree = build_nodes(volumes.clone(), 100);
        assert_eq!(tree.depths.iter().map(Vec::len).collect::<Vec<_>>(), [2, 13]);
        for (depth, nodes) in tree.depths.iter().enumerate() {
            let under = 8usize.pow((tree.depths.len() - depth) as u32);
            for (node, lights) in nodes.iter().zip(volumes.chunks(under)) {
                for light in lights {
                    let away = (light.centre.as_vec3() - node.centre).abs();
                    assert!(away.cmple(node.half_extent).all() && light.radius <= node.radius.into());
                }
            }
        }
    }

    #[test]
    fn the_tree_finds_what_testing_every_light_finds() {
        let grid = frustum_grid();
        let volumes = volumes(300);
        let clusters: Vec<u32> = (0..grid.cluster_count() as u32).collect();
        let visible = Visible { grid: &grid, clusters: &clusters };
        for test in [SphereTest::Exact, SphereTest::Box] {
            let descent = descend(&visible, &build_nodes(volumes.clone(), 300), test, 0.0);
            let mut found = 0;
            for (list, &cluster) in descent.lists.lights.iter().zip(&clusters) {
                let cell = CellTest::new(test, &grid, grid.cluster_at(cluster));
                let met = |light: &u32| cell.margin(&volumes[*light as usize]) >= 0.0;
                assert_eq!(*list, (0..300).filter(met).collect::<Vec<u32>>());
                found += list.len();
            }
            assert!(found > 1000 && descent.tests < 300 * clusters.len() as u64);
        }
    }
}
