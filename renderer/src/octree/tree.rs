//! The octree over a scene's lights (Tegelaers section 7.1).

use glam::UVec3;

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
