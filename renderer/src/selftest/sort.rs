//! The sort of the light hierarchy at odd sizes: by key, equal keys in the order in which they came.

use super::cases::{ORTHO, box_grid, random_bits, random_lights};
use super::{Context, Verdict};
use crate::assign::sort_passes;
use crate::buffers::BufferName;
use crate::config::{Assign, Test};
use crate::engine::workbench::{Case, Workbench, given};
use crate::measure::Capacities;
use crate::passes::{cull_lights, hierarchy, lights};
use crate::{Result, cpu};

/// Whole blocks of the sort and one more or less, one pass and several.
const SIZES: [u32; 7] = [1, 127, 128, 129, 1000, 4097, 20_001];

/// Items lie as their own keys say.
pub fn check(context: &mut Context) -> Result<Verdict> {
    for count in SIZES {
        let grid = box_grid([9, 7, 5]);
        let lights = random_lights(count, u64::from(count), 4.0, |u| 0.1 + u);
        let capacities = Capacities {
            visible_clusters: grid.cluster_count() as u32,
            light_indices: 16,
            ..Capacities::default()
        };
        let case = Case { method: ORTHO, grid, lights: &lights, capacities };
        let bench = context.bench((Assign::Hierarchy, Test::Auto), case)?;
        bench.compact(&random_bits(grid.cluster_count(), 1, 1))?;
        bench.run(|r, frame| {
            let lights = lights::record(r, frame);
            cull_lights::cull_lights(r, frame, lights, given());
            hierarchy::build_hierarchy(r, frame, given());
        })?;
        let candidates = bench.state()?.candidates;
        let items = sorted_items(bench, count, candidates)?;
        if let Some(fault) = fault(&items) {
            return Ok(Verdict::Wrong(format!("{fault} of {candidates} lights")));
        }
    }
    Ok(Verdict::Fine(format!("stable at {} sizes up to {}", SIZES.len(), SIZES[SIZES.len() - 1])))
}

/// Key and number of each of `candidates` out of `lights` lights, as the device sorted them.
///
/// # Errors
/// Whatever fails on the device.
pub fn sorted_items(bench: &mut Workbench, lights: u32, candidates: u32) -> Result<Vec<(u32, u32)>> {
    let first = 2 * (((sort_passes(lights) - 1) & 1) * lights) as usize;
    let words = bench.download(BufferName::SortItems, first + 2 * candidates.max(1) as usize)?;
    let items = words[first..].chunks_exact(2).take(candidates as usize);
    Ok(items.map(|item| (item[0], item[1])).collect())
}

fn fault(items: &[(u32, u32)]) -> Option<String> {
    let mut keys = vec![None; items.len()];
    for &(key, number) in items {
        match keys.get_mut(number as usize) {
            Some(place @ None) => *place = Some(key),
            Some(Some(_)) => return Some(format!("number {number} comes twice")),
            None => return Some(format!("number {number} is none")),
        }
    }
    let keys: Vec<u32> = keys.into_iter().flatten().collect();
    let order: Vec<u32> = items.iter().map(|&(_, number)| number).collect();
    (order != cpu::sorted(&keys)).then(|| "wrong order".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_stable_order_is_told() {
        assert_eq!(fault(&[(1, 2), (3, 0), (3, 1)]), None);
        assert_eq!(fault(&[(1, 2), (3, 1), (3, 0)]).unwrap(), "wrong order");
        assert_eq!(fault(&[(1, 2), (3, 1), (3, 1)]).unwrap(), "number 1 comes twice");
        assert_eq!(fault(&[(1, 7)]).unwrap(), "number 7 is none");
    }
}
