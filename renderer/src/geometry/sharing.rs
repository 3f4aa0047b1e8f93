//! Which views look lights up in which clustering.

use std::ops::Range;

/// How views share clusterings (Gelderen chapter 4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sharing {
    /// Individual: one clustering for each view.
    Indi,
    /// Enclosing: one clustering for all views.
    Encl,
}

impl Sharing {
    /// How many clusterings serve `views` views.
    pub fn clusterings(self, views: usize) -> usize {
        match self {
            Self::Indi => views,
            Self::Encl => 1,
        }
    }

    /// The clustering in which a view looks lights up.
    pub fn clustering_of(self, view: usize) -> usize {
        match self {
            Self::Indi => view,
            Self::Encl => 0,
        }
    }

    /// The views that look lights up in a clustering, of `views` views.
    pub fn views_of(self, clustering: usize, views: usize) -> Range<usize> {
        match self {
            Self::Indi => clustering..clustering + 1,
            Self::Encl => 0..views,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_view_looks_lights_up_in_the_clustering_that_has_it() {
        for sharing in [Sharing::Indi, Sharing::Encl] {
            let all = (0..sharing.clusterings(4)).flat_map(|clustering| {
                let views = sharing.views_of(clustering, 4);
                assert!(views.clone().all(|view| sharing.clustering_of(view) == clustering));
                views
            });
            assert_eq!(all.collect::<Vec<_>>(), [0, 1, 2, 3]);
        }
    }
}
