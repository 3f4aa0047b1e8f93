//! What lights that changed make of the scene's octree (Tegelaers tables 8.1 and 8.2).
//!
//! | node | light comes to all of it | to a part | goes from all of it | from a part |
//! | --- | --- | --- | --- | --- |
//! | leaf | joins its list | leaf becomes a branch | leaves the list | the list keeps it: an extra light |
//! | branch | descend | descend | descend | descend; merge what became equal |

use super::super::light_tree::{LightTree, Reach};
use super::super::top_down;
use super::super::tree::{Node, Place};
use std::collections::BTreeSet;

/// How what a light fills of a node changes.
pub(super) struct Change<'a> {
    light: u32,
    trees: [&'a LightTree; 2],
    before: Reach,
    after: Reach,
}

impl<'a> Change<'a> {
    /// Of the root, from one octree of the light to another.
    pub fn of(light: usize, before: &'a LightTree, after: &'a LightTree) -> Self {
        Self { light: light as u32, trees: [before, after], before: before.root(), after: after.root() }
    }

    /// Of a child (x + 2y + 4z).
    fn child(&self, child: usize) -> Self {
        let [before, after] = self.trees;
        Self { before: before.child(self.before, child), after: after.child(self.after, child), ..*self }
    }

    /// Whether the light fills all of the node, or nothing, as it did.
    fn is_none(&self) -> bool {
        self.before == self.after && !matches!(self.after, Reach::Part(_))
    }
}

/// Edits a scene's octree and notes where.
pub(super) struct Editor<'a> {
    start_depth: u32,
    trees: &'a [LightTree],
    extras: &'a mut BTreeSet<Place>,
    touched: BTreeSet<Place>,
}

impl<'a> Editor<'a> {
    /// For an octree whose nodes down to the starting depth are branches, of lights with these octrees, after all changes.
    pub fn new(start_depth: u32, trees: &'a [LightTree], extras: &'a mut BTreeSet<Place>) -> Self {
        Self { start_depth, trees, extras, touched: BTreeSet::new() }
    }

    /// Places of nodes that came, went, or are otherwise than before, and their parents.
    pub fn into_touched(self) -> BTreeSet<Place> {
        self.touched
    }

    /// A light's change at a node.
    pub fn edit(&mut self, node: &mut Node, place: Place, change: &Change) {
        if change.is_none() {
            return;
        }
        match node {
            Node::Branch(children) => {
                for (at, child) in children.iter_mut().enumerate() {
                    self.edit(child, place.child(at), &change.child(at));
                }
                self.merge(node, place);
            }
            Node::Leaf(lights) => match (lights.binary_search(&change.light), change.after) {
                (Ok(at), Reach::None) => {
                    lights.remove(at);
                    self.touch(place);
                }
                (Err(at), Reach::Full) => {
                    lights.insert(at, change.light);
                    self.touch(place);
                }
                (Err(at), Reach::Part(_)) => {
                    lights.insert(at, change.light);
                    self.tell_truth(node, place);
                }
                (Ok(_), Reach::Part(_)) => {
                    self.extras.insert(place);
                }
                (Ok(_), Reach::Full) | (Err(_), Reach::None) => {}
            },
        }
    }

    /// Makes all leaves with extra lights what they would be without.
    pub fn repair(&mut self, tree: &mut Node) {
        for place in std::mem::take(self.extras) {
            let node = tree.find_mut(place).expect("extra lights are noted for leaves that are there");
            self.tell_truth(node, place);
        }
    }

    /// Makes a leaf that lists all lights which reach it, and perhaps more, what it would be without these.
    fn tell_truth(&mut self, node: &mut Node, place: Place) {
        let Node::Leaf(lights) = &*node else { return };
        let parts = lights.iter().map(|&light| (light, self.trees[light as usize].at(place)));
        *node = top_down::below(self.trees, parts.collect(), place.depth);
        self.extras.remove(&place);
        self.touch_all(node, place);
    }

    /// Makes a branch a leaf where its children are leaves with the same lights.
    fn merge(&mut self, node: &mut Node, place: Place) {
        // The layers have all nodes of the starting depth.
        if place.depth <= self.start_depth {
            return;
        }
        node.merge_children();
        if matches!(node, Node::Leaf(_)) {
            let extra = (0..8).filter(|child| self.extras.remove(&place.child(*child))).count();
            if extra > 0 {
                self.extras.insert(place);
            }
            self.touched.extend((0..8).map(|child| place.child(child)));
            self.touch(place);
        }
    }

    fn touch_all(&mut self, node: &Node, place: Place) {
        self.touch(place);
        if let Node::Branch(children) = node {
            children.iter().enumerate().for_each(|(at, child)| self.touch_all(child, place.child(at)));
        }
    }

    /// Notes a node, and its parent, which says what it is.
    fn touch(&mut self, place: Place) {
        self.touched.insert(place);
        self.touched.extend(place.parent());
    }
}
