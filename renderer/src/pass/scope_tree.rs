//! The stages of frames: their names, and the paths that these make.

use crate::vk::c_string;
use std::ffi::{CStr, CString};
use std::fmt;

/// Name of a stage; `cluster[0]` where it has an index.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScopeName<'n> {
    stem: &'n str,
    index: Option<u32>,
}

impl<'n> From<&'n str> for ScopeName<'n> {
    fn from(stem: &'n str) -> Self {
        Self { stem, index: None }
    }
}

impl<'n> From<(&'n str, usize)> for ScopeName<'n> {
    fn from((stem, index): (&'n str, usize)) -> Self {
        Self { stem, index: Some(index as u32) }
    }
}

impl fmt::Display for ScopeName<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.index {
            Some(index) => write!(f, "{}[{index}]", self.stem),
            None => f.write_str(self.stem),
        }
    }
}

#[derive(Debug)]
struct Scope {
    stem: String,
    index: Option<u32>,
    /// The enclosing scope.
    parent: Option<ScopeId>,
    path: String,
    /// What tools for captures show.
    label: CString,
}

/// The stages that frames have, each once. Frames may differ in which they have; one whose stages are known allocates
/// nothing.
#[derive(Debug, Default)]
pub struct ScopeTree {
    scopes: Vec<Scope>,
}

/// A stage of a [`ScopeTree`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ScopeId(usize);

impl ScopeTree {
    /// The path of a stage, such as `frame/cluster[0]/count_lights`.
    pub fn path(&self, scope: ScopeId) -> &str {
        &self.scopes[scope.0].path
    }

    /// What tools for captures show of a stage.
    pub(super) fn label(&self, scope: ScopeId) -> &CStr {
        &self.scopes[scope.0].label
    }

    /// The scope of a name below `parent`, made where no frame had it. In a frame like the last it is the one behind `last`.
    pub(super) fn enter(
        &mut self,
        name: ScopeName,
        parent: Option<ScopeId>,
        last: Option<ScopeId>,
    ) -> ScopeId {
        let is_it = |scope: &Scope| scope.is_called(name) && scope.parent == parent;
        let next = last.map_or(0, |last| last.0 + 1);
        if self.scopes.get(next).is_some_and(is_it) {
            return ScopeId(next);
        }
        let known = self.scopes.iter().position(is_it);
        ScopeId(known.unwrap_or_else(|| self.add(name, parent)))
    }

    fn add(&mut self, name: ScopeName, parent: Option<ScopeId>) -> usize {
        let label = name.to_string();
        let path = match parent {
            Some(parent) => format!("{}/{label}", self.path(parent)),
            None => label.clone(),
        };
        let ScopeName { stem, index } = name;
        self.scopes.push(Scope { stem: stem.to_owned(), index, parent, path, label: c_string(&label) });
        self.scopes.len() - 1
    }

    /// How many of `scopes` are children of `parent` with this stem.
    pub(super) fn count(&self, scopes: &[ScopeId], stem: &str, parent: Option<ScopeId>) -> usize {
        let is_one = |id: &&ScopeId| {
            let scope = &self.scopes[id.0];
            scope.parent == parent && scope.stem == stem
        };
        scopes.iter().filter(is_one).count()
    }
}

impl Scope {
    fn is_called(&self, name: ScopeName) -> bool {
        self.stem == name.stem && self.index == name.index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paths of a frame with these stages below its own.
    fn frame(tree: &mut ScopeTree, stages: &[&str]) -> Vec<String> {
        let root = tree.enter("frame".into(), None, None);
        let mut scopes = vec![root];
        for stage in stages {
            scopes.push(tree.enter((*stage).into(), Some(root), scopes.last().copied()));
        }
        scopes.into_iter().map(|scope| tree.path(scope).to_owned()).collect()
    }

    #[test]
    fn frames_share_the_stages_that_they_both_have() {
        let mut tree = ScopeTree::default();
        assert_eq!(frame(&mut tree, &["lights", "build", "shade"])[2], "frame/build");
        assert_eq!(frame(&mut tree, &["lights", "shade"])[2], "frame/shade");
        assert_eq!(frame(&mut tree, &["lights", "build", "shade"])[3], "frame/shade");
        assert_eq!(tree.scopes.len(), 4);
        frame(&mut tree, &["lights", "resolve", "build"]);
        assert_eq!(tree.scopes.len(), 5);
    }

    #[test]
    fn passes_are_counted_among_those_of_their_stage_in_the_frame() {
        let mut tree = ScopeTree::default();
        let root = tree.enter("frame".into(), None, None);
        let first = tree.enter(("scan", 0).into(), Some(root), Some(root));
        let inner = tree.enter(("scan", 0).into(), Some(first), Some(first));
        assert_eq!(tree.count(&[root, first, inner], "scan", Some(root)), 1);
        assert_eq!(tree.count(&[root], "scan", Some(root)), 0, "of another frame");
    }
}
