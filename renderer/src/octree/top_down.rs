//! From the root down (Tegelaers section 7.1.3, table 7.1): the octrees of all lights joined to one.
//!
//! He adds one light after the other. A light that is full in a node adds to all of its leaves, one that is partly there
//! makes it a branch, whose children copy what was in it: the outcome does not depend on the order. So all lights are
//! added to a node at once here: it is a leaf where each of those in it fills it, and else a branch, whose children
//! are made of what the lights fill of them.

use super::light_tree::{LightTree, Reach};
use super::tree::Node;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Nodes above this depth are made on several cores at once.
const SHARED_DEPTH: u32 = 4;

/// A light and what it fills of a node.
type Part = (u32, Reach);

/// What all leaves together may hold.
struct Room {
    most: usize,
    used: AtomicUsize,
}

/// The scene's octree of those of its lights; `None` where its leaves would hold more than `most` lights together.
pub(super) fn join(trees: &[LightTree], most: usize) -> Option<Node> {
    let parts = (0_u32..).zip(trees.iter().map(LightTree::root));
    let parts = parts.filter(|(_, reach)| *reach != Reach::None).collect();
    let room = Room { most, used: AtomicUsize::new(0) };
    node(trees, parts, 0, &room)
}

/// The node at `depth` of which lights fill `parts`, ascending.
pub(super) fn below(trees: &[LightTree], mut parts: Vec<Part>, depth: u32) -> Node {
    parts.retain(|(_, reach)| *reach != Reach::None);
    let room = Room { most: usize::MAX, used: AtomicUsize::new(0) };
    node(trees, parts, depth, &room).expect("there is room for any number")
}

/// The node at `depth` of which lights fill `parts`.
fn node(trees: &[LightTree], parts: Vec<Part>, depth: u32, room: &Room) -> Option<Node> {
    if parts.iter().all(|(_, reach)| *reach == Reach::Full) {
        let before = room.used.fetch_add(parts.len(), Ordering::Relaxed);
        let lights = parts.into_iter().map(|(light, _)| light).collect();
        return (before <= room.most).then_some(Node::Leaf(lights));
    }
    let child = |child| node(trees, within(trees, &parts, child), depth + 1, room);
    let children: Option<Vec<Node>> = if depth < SHARED_DEPTH {
        (0..8).into_par_iter().map(child).collect()
    } else {
        (0..8).map(child).collect()
    };
    Some(Node::Branch(children?.try_into().expect("a node has 8 children")))
}

/// What lights that fill `parts` of a node fill of a child.
fn within(trees: &[LightTree], parts: &[Part], child: usize) -> Vec<Part> {
    let part = |&(light, reach): &Part| (light, trees[light as usize].child(reach, child));
    parts.iter().map(part).filter(|(_, reach)| *reach != Reach::None).collect()
}
