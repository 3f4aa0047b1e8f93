//! The octree over a scene's lights (Tegelaers section 7.1).

use glam::UVec3;
use std::cmp::Ordering;

/// A node: a leaf with the lights that reach it, ascending, or a branch.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Node {
    /// The same lights reach all of it.
    Leaf(Vec<u32>),
    /// Children in the order x + 2y + 4z.
    Branch(Box<[Self; 8]>),
}

impl Node {
    /// No light reaches it.
    pub const EMPTY: Self = Self::Leaf(Vec::new());

    /// Children; those of a leaf are all as it is.
    pub fn children(&self) -> [&Self; 8] {
        match self {
            Self::Leaf(_) => [self; 8],
            Self::Branch(children) => std::array::from_fn(|child| &children[child]),
        }
    }

    /// The lights of a leaf.
    pub fn lights(&self) -> Option<&[u32]> {
        match self {
            Self::Leaf(lights) => Some(lights),
            Self::Branch(_) => None,
        }
    }

    /// The node at a place below this root; `None` where a leaf lies above it.
    pub fn find(&self, place: Place) -> Option<&Self> {
        place.path().try_fold(self, |node, child| match node {
            Self::Branch(children) => Some(&children[child]),
            Self::Leaf(_) => None,
        })
    }

    /// As [`Self::find`], to change it.
    pub fn find_mut(&mut self, place: Place) -> Option<&mut Self> {
        place.path().try_fold(self, |node, child| match node {
            Self::Branch(children) => Some(&mut children[child]),
            Self::Leaf(_) => None,
        })
    }

    /// Makes branches of leaves down to a depth, that of the leaves above it included.
    pub fn split(&mut self, depth: u32) {
        if let Self::Leaf(_) = self {
            *self = Self::Branch(Box::new(std::array::from_fn(|_| self.clone())));
        }
        if let (Self::Branch(children), Some(below)) = (self, depth.checked_sub(1)) {
            children.iter_mut().for_each(|child| child.split(below));
        }
    }

    /// A node of eight children: a leaf where they are leaves with the same lights.
    pub fn of_children(children: [Self; 8]) -> Self {
        let mut node = Self::Branch(Box::new(children));
        node.merge_children();
        node
    }

    /// Makes a leaf of each branch whose children are leaves with the same lights, from the bottom up.
    pub fn merge(&mut self) {
        if let Self::Branch(children) = self {
            children.iter_mut().for_each(Self::merge);
            self.merge_children();
        }
    }

    /// Makes a leaf of a branch whose children are leaves with the same lights.
    pub fn merge_children(&mut self) {
        if let Self::Branch(children) = self
            && matches!(children[0], Self::Leaf(_))
            && children[1..].iter().all(|child| *child == children[0])
        {
            *self = std::mem::replace(&mut children[0], Self::EMPTY);
        }
    }
}

/// Where a node is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Place {
    /// Its depth.
    pub depth: u32,
    /// Its cell, in nodes of its depth.
    pub cell: UVec3,
}

impl Place {
    /// The root.
    pub const ROOT: Self = Self { depth: 0, cell: UVec3::ZERO };

    /// Of a child (x + 2y + 4z).
    pub fn child(self, child: usize) -> Self {
        Self { depth: self.depth + 1, cell: child_cell(self.cell, child) }
    }

    /// Of the parent, which the root has not.
    pub fn parent(self) -> Option<Self> {
        let depth = self.depth.checked_sub(1)?;
        Some(Self { depth, cell: self.cell >> 1 })
    }

    /// Which children (x + 2y + 4z) lead to it from the root.
    pub fn path(self) -> impl Iterator<Item = usize> {
        (0..self.depth).rev().map(move |above| child_of_parent(self.cell >> above))
    }

    fn key(self) -> (u32, [u32; 3]) {
        (self.depth, self.cell.to_array())
    }
}

impl Ord for Place {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl PartialOrd for Place {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The cell of child x + 2y + 4z of a node's cell.
pub(super) fn child_cell(cell: UVec3, child: usize) -> UVec3 {
    let child = child as u32;
    cell * 2 + UVec3::new(child & 1, child >> 1 & 1, child >> 2)
}

/// Which child (x + 2y + 4z) of its parent a cell is.
pub(super) fn child_of_parent(cell: UVec3) -> usize {
    let low = cell & UVec3::ONE;
    (low.x + 2 * low.y + 4 * low.z) as usize
}
