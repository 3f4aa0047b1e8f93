//! Runs of light indices that grow and shrink.

use std::collections::BTreeSet;
use std::ops::Range;

/// Which runs of a list of indices are free, and what was written to it.
#[derive(Debug, Clone, Default)]
pub(super) struct Runs {
    /// Length and first index of each free run.
    free: BTreeSet<[u32; 2]>,
    written: Vec<Range<usize>>,
}

impl Runs {
    /// Writes a leaf's lights in place of its run, or to another where that is too short: the first index and the number; `None` of no
    /// lights.
    pub fn write(
        &mut self,
        old: Option<[u32; 2]>,
        lights: &[u32],
        indices: &mut Vec<u32>,
    ) -> Option<[u32; 2]> {
        if old.is_none() && lights.is_empty() {
            return None;
        }
        let wanted = lights.len() as u32;
        let run = match old {
            Some([first, count]) if count >= wanted => {
                self.give(first + wanted, count - wanted);
                first
            }
            _ => {
                old.into_iter().for_each(|[first, count]| self.give(first, count));
                self.take(wanted, indices)
            }
        };
        let place = run as usize..run as usize + lights.len();
        if indices[place.clone()] != *lights {
            indices[place.clone()].copy_from_slice(lights);
            self.written.push(place);
        }
        (wanted > 0).then_some([run, wanted])
    }

    /// What was written since this was last asked.
    pub fn take_writes(&mut self) -> Vec<Range<usize>> {
        std::mem::take(&mut self.written)
    }

    /// The first index of the shortest free run of `wanted` indices or more; the list grows where there is none.
    fn take(&mut self, wanted: u32, indices: &mut Vec<u32>) -> u32 {
        let Some([length, first]) = self.free.range([wanted, 0]..).next().copied() else {
            let first = indices.len();
            indices.resize(first + wanted as usize, 0);
            // The device does not have these zeros.
            self.written.push(first..indices.len());
            return first as u32;
        };
        self.free.remove(&[length, first]);
        self.give(first + wanted, length - wanted);
        first
    }

    fn give(&mut self, first: u32, length: u32) {
        if length > 0 {
            self.free.insert([length, first]);
        }
    }
}
