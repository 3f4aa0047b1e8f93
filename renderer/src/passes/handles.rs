//! What passes hand on: a handle is proof that what it names is recorded, so that the page of a frame shows what each pass
//! works on. Handles of several views or clusterings are sets, and cost no allocation.

use super::inputs::{Eyes, Frame};
use std::ops::BitOr;

/// The lights of the frame, on the device.
#[derive(Debug, Clone, Copy)]
pub struct Lights(());

impl Lights {
    pub(super) fn uploaded() -> Self {
        Self(())
    }
}

/// The depth of some views.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Depth {
    /// A bit a view.
    views: u32,
}

impl Depth {
    /// Depth of no view.
    pub const NONE: Self = Self { views: 0 };

    /// Depth of the views that a pass drew.
    pub(super) fn of(frame: &Frame, eyes: Eyes) -> Self {
        Self { views: bits(frame, eyes) }
    }

    /// Whether the depth is there for all views that a pass draws.
    pub fn covers(self, frame: &Frame, eyes: Eyes) -> bool {
        let views = bits(frame, eyes);
        self.views & views == views
    }
}

impl BitOr for Depth {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self { views: self.views | other.views }
    }
}

/// The G-buffers of some views, with their depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GBuffer {
    depth: Depth,
}

impl GBuffer {
    /// G-buffers of no view.
    pub const NONE: Self = Self { depth: Depth::NONE };

    /// G-buffers of the views that a pass drew.
    pub(super) fn of(frame: &Frame, eyes: Eyes) -> Self {
        Self { depth: Depth::of(frame, eyes) }
    }

    /// The depth of their views.
    pub fn depth(self) -> Depth {
        self.depth
    }
}

impl BitOr for GBuffer {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self { depth: self.depth | other.depth }
    }
}

/// The visible clusters of one clustering: counted, and listed, by ascending index unless a counter gave them their places.
#[derive(Debug, Clone, Copy)]
pub struct VisibleClusters {
    pub(super) clustering: usize,
}

impl VisibleClusters {
    /// Visible clusters that were put there by hand, on a workbench.
    pub(crate) fn given(clustering: usize) -> Self {
        Self { clustering }
    }

    /// The clustering whose clusters they are.
    pub fn clustering(self) -> usize {
        self.clustering
    }
}

/// The light lists of some clusterings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LightLists {
    /// A bit a clustering.
    clusterings: u32,
}

impl LightLists {
    /// Light lists of no clustering.
    pub const NONE: Self = Self { clusterings: 0 };
    /// What a method without lists has: every view looks all lights up.
    pub const ALL_LIGHTS: Self = Self { clusterings: u32::MAX };

    /// Light lists of the clustering whose visible clusters were given lists.
    pub(super) fn of(visible: VisibleClusters) -> Self {
        Self { clusterings: 1 << visible.clustering }
    }

    /// Those of the leaves of an octree, which serve all views.
    pub(super) fn of_octree() -> Self {
        Self { clusterings: u32::MAX }
    }

    /// Whether they are there for a view.
    pub fn serve(self, frame: &Frame, view: usize) -> bool {
        self.clusterings >> frame.sharing.clustering_of(view) & 1 == 1
    }
}

impl BitOr for LightLists {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self { clusterings: self.clusterings | other.clusterings }
    }
}

/// The colour of all views, with all its samples.
#[derive(Debug, Clone, Copy)]
pub struct Color(());

impl Color {
    pub(super) fn shaded() -> Self {
        Self(())
    }
}

fn bits(frame: &Frame, eyes: Eyes) -> u32 {
    match eyes {
        Eyes::One(view) => 1 << view,
        Eyes::All => u32::MAX >> (u32::BITS - frame.targets.len() as u32),
    }
}
