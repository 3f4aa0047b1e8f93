//! An octree that follows its lights (Tegelaers section 8.2.3, tables 8.1 and 8.2, which designs it).
//!
//! ```text
//! lights that changed ─ octree of each, before and after ─ edit ─ scene's octree, nodes touched
//!                                                                  │
//!   report: what to upload <─ tables: keys taken away, put, or the table hashed anew ─┘ runs of indices
//! ```
//!
//! The scene's octree is what the tables say, not always what is true: where a light leaves a part of a leaf, the leaf keeps
//! it. Extra lights do no harm but cost; they go where a table has to be hashed anew anyway. A key can be put where its slot
//! is empty (the thesis prints the condition turned around), and, which is our addition, where another offset puts it and the
//! few keys that share it on empty slots.

mod edit;
mod report;
mod runs;
mod table;
#[cfg(test)]
mod tests;

use super::build::{BuildTimes, light_trees, timed};
use super::frame::OctreeFrame;
use super::layers::{self, StoredLayer, kind};
use super::light_tree::{LightTree, Reach};
use super::linkless::{LinklessOctree, child_bits};
use super::settings::{OctreeError, OctreeSettings};
use super::top_down;
use super::tree::{Node, Place};
use crate::geometry::LightVolume;
use edit::{Change, Editor};
pub use report::{Dirty, UpdateReport};
use runs::Runs;
use std::collections::BTreeSet;
use table::Table;

/// An octree over lights that can change, with what the host must know to edit its tables.
#[derive(Debug, Clone)]
pub struct DynamicOctree {
    settings: OctreeSettings,
    lights: Vec<LightVolume>,
    trees: Vec<LightTree>,
    /// What the tables say; nodes above and of the starting depth are branches.
    tree: Node,
    /// Leaves that may list lights which reach no cell, or not all, of them.
    extras: BTreeSet<Place>,
    layers: Vec<LayerTables>,
    runs: Runs,
    octree: LinklessOctree,
    times: BuildTimes,
}

/// The tables of a layer.
#[derive(Debug, Clone)]
struct LayerTables {
    structure: Table<u16>,
    data: Table<[u32; 2]>,
}

impl DynamicOctree {
    /// The octree over lights, as [`LinklessOctree::build`] makes it. Runs of indices are not shared, for each is edited by itself.
    ///
    /// # Errors
    /// As [`LinklessOctree::build`].
    pub fn new(lights: &[LightVolume], settings: &OctreeSettings) -> Result<Self, OctreeError> {
        let settings = OctreeSettings { share_runs: false, ..*settings };
        let mut times = BuildTimes::default();
        let frame = timed(&mut times.empty, || OctreeFrame::around(lights, &settings))?;
        let most = settings.limits.indices;
        let trees = timed(&mut times.lights, || light_trees(lights, &frame, most))?;
        let error = OctreeError::TooManyIndices { node: settings.node, most };
        let mut tree = timed(&mut times.adding, || top_down::join(&trees, most)).ok_or(error)?;
        timed(&mut times.merging, || tree.merge());
        let (octree, layers) = timed(&mut times.linkless, || tables(&mut tree, frame, &settings))?;
        let (lights, extras, runs) = (lights.to_vec(), BTreeSet::new(), Runs::default());
        Ok(Self { settings, lights, trees, tree, extras, layers, runs, octree, times })
    }

    /// How long each step of the last update took, or of building where that was as a whole. In others merging is part of adding.
    pub fn times(&self) -> BuildTimes {
        self.times
    }

    /// How many light indices leaves have of lights that do not reach all of their cells.
    pub fn extra_indices(&self) -> u64 {
        let of_leaf = |place: &Place| {
            let lights = self.tree.find(*place).and_then(Node::lights).unwrap_or(&[]);
            lights.iter().filter(|light| self.trees[**light as usize].at(*place) != Reach::Full).count()
                as u64
        };
        self.extras.iter().map(of_leaf).sum()
    }

    /// The octree as the device has it once what the last report says is uploaded.
    pub fn octree(&self) -> &LinklessOctree {
        &self.octree
    }

    /// Makes the octree that of other lights. Light k is taken for the same light as before; those past the end came or went.
    /// Each cell lists all lights that reach it, and perhaps more.
    ///
    /// # Errors
    /// As [`LinklessOctree::build`]. The octree may no longer be used then.
    pub fn update(&mut self, lights: &[LightVolume]) -> Result<UpdateReport, OctreeError> {
        let mut times = BuildTimes::default();
        timed(&mut times.empty, || OctreeFrame::around(lights, &self.settings))?;
        let common = lights.len().min(self.lights.len());
        let changed: Vec<usize> = (0..lights.len().max(self.lights.len()))
            .filter(|&light| light >= common || lights[light] != self.lights[light])
            .collect();
        if lights.iter().any(|light| !self.octree.frame.holds(light)) {
            return self.rebuild(lights, changed.len());
        }
        let extras = self.extras.len();
        let mut report = UpdateReport { changed: changed.len(), extras, ..UpdateReport::default() };
        if changed.is_empty() {
            self.times = times;
            return Ok(report);
        }
        let touched = self.edit(lights, &changed, &mut times)?;
        timed(&mut times.linkless, || self.write(touched, &mut report))?;
        if self.octree.indices.len() > self.settings.limits.indices {
            return self.rebuild(lights, changed.len());
        }
        report.extras = self.extras.len();
        self.times = times;
        Ok(report)
    }

    /// The octree that is built of lights without one before.
    fn rebuild(&mut self, lights: &[LightVolume], changed: usize) -> Result<UpdateReport, OctreeError> {
        *self = Self::new(lights, &self.settings)?;
        let rebuilt = 2 * self.layers.len();
        Ok(UpdateReport { changed, anew: true, rebuilt, dirty: Dirty::All, ..UpdateReport::default() })
    }

    /// Edits the scene's octree by the lights that changed; the nodes that are no longer as the tables have them.
    fn edit(
        &mut self,
        lights: &[LightVolume],
        changed: &[usize],
        times: &mut BuildTimes,
    ) -> Result<BTreeSet<Place>, OctreeError> {
        let frame = &self.octree.frame;
        let present: Vec<usize> = changed.iter().copied().filter(|light| *light < lights.len()).collect();
        let volumes: Vec<LightVolume> = present.iter().map(|light| lights[*light]).collect();
        let new = timed(&mut times.lights, || light_trees(&volumes, frame, self.settings.limits.indices))?;
        // A light that is not there fills nothing.
        let most = lights.len().max(self.lights.len());
        self.trees.resize(most, LightTree::EMPTY);
        let mut old: Vec<LightTree> = Vec::with_capacity(changed.len());
        let mut new = new.into_iter();
        for light in changed {
            let tree = if *light < lights.len() { new.next() } else { None };
            let tree = tree.unwrap_or(LightTree::EMPTY);
            old.push(std::mem::replace(&mut self.trees[*light], tree));
        }
        let mut editor = Editor::new(frame.start_depth, &self.trees, &mut self.extras);
        timed(&mut times.adding, || {
            for (light, old) in changed.iter().zip(&old) {
                editor.edit(&mut self.tree, Place::ROOT, &Change::of(*light, old, &self.trees[*light]));
            }
        });
        let touched = editor.into_touched();
        self.trees.truncate(lights.len());
        self.lights = lights.to_vec();
        Ok(touched)
    }

    /// Makes the tables say what the scene's octree does at the places touched.
    fn write(&mut self, touched: BTreeSet<Place>, report: &mut UpdateReport) -> Result<(), OctreeError> {
        self.put(&touched, report);
        if self.layers.iter().any(LayerTables::overflows) && !self.extras.is_empty() {
            // A table is hashed anew: time to tell the truth.
            let mut editor = Editor::new(self.octree.frame.start_depth, &self.trees, &mut self.extras);
            editor.repair(&mut self.tree);
            let touched = editor.into_touched();
            self.put(&touched, report);
        }
        let mut resized = false;
        for (layer, depth) in self.layers.iter_mut().zip(self.octree.frame.start_depth..) {
            resized |= layer.structure.hash_anew(depth, &self.settings, report)?;
            resized |= layer.data.hash_anew(depth + 1, &self.settings, report)?;
        }
        if resized {
            self.assemble(report)
        } else {
            self.copy(report);
            Ok(())
        }
    }

    /// Takes keys away and puts others, where slots allow it.
    fn put(&mut self, touched: &BTreeSet<Place>, report: &mut UpdateReport) {
        let frame = self.octree.frame;
        // First what goes: what comes may need its slots.
        for coming in [false, true] {
            for place in touched {
                let node = self.tree.find(*place);
                let branch = node.filter(|node| matches!(node, Node::Branch(_)));
                if (frame.start_depth..frame.depth).contains(&place.depth) && branch.is_some() == coming {
                    let layer = &mut self.layers[(place.depth - frame.start_depth) as usize];
                    let bits = branch.map(|node| child_bits(node.children().into_iter().map(kind)));
                    report.edits += usize::from(layer.structure.set(place.cell, bits));
                }
                let lights = node.and_then(Node::lights).filter(|lights| !lights.is_empty());
                if place.depth > frame.start_depth && lights.is_some() == coming {
                    let layer = &mut self.layers[(place.depth - 1 - frame.start_depth) as usize];
                    let old = layer.data.get(place.cell);
                    let run = self.runs.write(old, lights.unwrap_or(&[]), &mut self.octree.indices);
                    report.edits += usize::from(layer.data.set(place.cell, run));
                }
            }
        }
    }

    /// All tables anew, one behind the other.
    fn assemble(&mut self, report: &mut UpdateReport) -> Result<(), OctreeError> {
        let stored: Vec<StoredLayer> = self.layers.iter().map(LayerTables::stored).collect();
        let indices = std::mem::take(&mut self.octree.indices);
        self.octree = layers::assemble(self.octree.frame, &stored, indices, &self.settings)?;
        self.layers.iter_mut().for_each(LayerTables::forget_writes);
        self.runs.take_writes();
        report.dirty = Dirty::All;
        Ok(())
    }

    /// What was written to tables, where the device's are.
    fn copy(&mut self, report: &mut UpdateReport) {
        let octree = &mut self.octree;
        let (mut structure, mut leaves, mut offsets) = (Vec::new(), Vec::new(), Vec::new());
        for (tables, layer) in self.layers.iter_mut().zip(&mut octree.layers) {
            tables.structure.copy(&mut layer.structure, &mut octree.structure, &mut structure);
            tables.structure.copy_offsets(&layer.structure, &mut octree.offsets, &mut offsets);
            if let Some(data) = &mut layer.data {
                tables.data.copy(data, &mut octree.leaves, &mut leaves);
                tables.data.copy_offsets(data, &mut octree.offsets, &mut offsets);
            }
        }
        let indices = self.runs.take_writes();
        report.dirty = Dirty::ranges([structure, leaves, offsets], indices);
    }
}

/// The tables of a merged tree, which is split down to where lookups begin then.
fn tables(
    tree: &mut Node,
    frame: OctreeFrame,
    settings: &OctreeSettings,
) -> Result<(LinklessOctree, Vec<LayerTables>), OctreeError> {
    let (stored, indices) = layers::stored(tree, &frame, settings)?;
    tree.split(frame.start_depth);
    let octree = layers::assemble(frame, &stored, indices, settings)?;
    Ok((octree, stored.into_iter().map(LayerTables::new).collect()))
}
