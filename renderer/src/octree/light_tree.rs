//! The octree of one light (Tegelaers section 7.2.3): what of the scene's octree its ball fills.
//!
//! It is rooted where the scene's is, by a chain of single branches down to the node that holds the ball, so that both are
//! walked together. Branches lie breadth first: those among a branch's children follow each other.

use super::ball::{Ball, Coverage};
use super::tree::{Place, child_cell};
use glam::UVec3;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What a light fills of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// Nothing.
    None,
    /// All of its deepest cells.
    Full,
    /// Some: the branch of this index says which.
    Part(u32),
}

/// A node of which a light fills some cells but not all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct LightBranch {
    /// Bit x + 2y + 4z: the light fills all of the child.
    full: u8,
    /// Bit x + 2y + 4z: the child is a branch.
    branch: u8,
    /// The first child that is a branch.
    first: u32,
}

/// The octree of one light.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct LightTree {
    root: Reach,
    branches: Vec<LightBranch>,
}

/// How many branches all light octrees may have together.
pub(super) struct BranchBudget {
    left: AtomicUsize,
}

impl BranchBudget {
    /// Room for `most` branches.
    pub fn new(most: usize) -> Self {
        Self { left: AtomicUsize::new(most) }
    }

    /// Takes one branch; whether there was room. Whether all fit does not depend on who takes first.
    fn take(&self) -> bool {
        self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).is_ok()
    }
}

impl LightTree {
    /// The octree of a ball, whose deepest leaves have depth `depth`; `None` where the budget does not suffice.
    pub fn new(ball: &Ball, depth: u32, budget: &BranchBudget) -> Option<Self> {
        let root = match ball.coverage(UVec3::ZERO, 1 << depth) {
            Coverage::None => Reach::None,
            Coverage::All => Reach::Full,
            Coverage::Some => Reach::Part(0),
        };
        let mut branches = Vec::new();
        let mut places = match root {
            Reach::Part(_) => vec![(0, UVec3::ZERO)],
            Reach::None | Reach::Full => vec![],
        };
        while let Some(&place) = places.get(branches.len()) {
            if !budget.take() {
                return None;
            }
            branches.push(branch(ball, depth, place, &mut places));
        }
        Some(Self { root, branches })
    }

    /// Of a light that fills nothing.
    pub const EMPTY: Self = Self { root: Reach::None, branches: Vec::new() };

    /// Branches, and leaves that the light fills.
    #[cfg(test)]
    fn branches_and_leaves(&self) -> [usize; 2] {
        let leaves = self.branches.iter().map(|branch| branch.full.count_ones() as usize).sum();
        [self.branches.len(), leaves]
    }

    /// What the light fills of the root.
    pub fn root(&self) -> Reach {
        self.root
    }

    /// What it fills of the node at a place.
    pub fn at(&self, place: Place) -> Reach {
        place.path().fold(self.root, |reach, child| self.child(reach, child))
    }

    /// What it fills of a child (x + 2y + 4z) of a node of which it fills `reach`.
    pub fn child(&self, reach: Reach, child: usize) -> Reach {
        let Reach::Part(at) = reach else { return reach };
        let LightBranch { full, branch, first } = self.branches[at as usize];
        let bit = 1 << child;
        if full & bit != 0 {
            Reach::Full
        } else if branch & bit != 0 {
            Reach::Part(first + (branch & (bit - 1)).count_ones())
        } else {
            Reach::None
        }
    }
}

/// The branch at a depth and cell of an octree whose deepest leaves have depth `deepest`; notes the places of those below it.
fn branch(
    ball: &Ball,
    deepest: u32,
    (depth, cell): (u32, UVec3),
    places: &mut Vec<(u32, UVec3)>,
) -> LightBranch {
    let mut made = LightBranch { full: 0, branch: 0, first: places.len() as u32 };
    let edge = deepest - depth - 1;
    for child in 0..8 {
        let place = child_cell(cell, child);
        match ball.coverage(place << edge, 1 << edge) {
            Coverage::None => {}
            Coverage::All => made.full |= 1 << child,
            Coverage::Some => {
                made.branch |= 1 << child;
                places.push((depth + 1, place));
            }
        }
    }
    made
}

#[cfg(test)]
mod tests {
    use super::super::frame::OctreeFrame;
    use super::super::settings::OctreeSettings;
    use super::*;
    use crate::geometry::LightVolume;
    use glam::DVec3;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// What is told of large lights before their octrees are made is true, and not much less than what they take.
        #[test]
        fn large_lights_have_as_many_branches_and_leaves_as_is_told(
            radius in 16.0..60.0f64, centre in [0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64],
        ) {
            let light = LightVolume::sphere(DVec3::from_array(centre), radius);
            let around = [light, LightVolume::sphere(DVec3::splat(0.5), 64.0)];
            let frame = OctreeFrame::around(&around, &OctreeSettings::new(1.0, 0)).unwrap();
            let ball = Ball::new(&light, &frame);
            let tree = LightTree::new(&ball, frame.depth, &BranchBudget::new(1 << 20)).unwrap();
            let [branches, leaves] = tree.branches_and_leaves().map(|count| count as f64);
            let told = ball.least_branches();
            prop_assert!(told <= branches.min(leaves), "{told} {branches} {leaves}");
            prop_assert!(branches < 1.5 * told, "{told} {branches}");
        }
    }
}
