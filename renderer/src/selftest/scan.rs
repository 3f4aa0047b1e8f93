//! Prefix sums at odd sizes: of visibility words, which compaction ranks, and of the lengths of lists.

use super::cases::{ORTHO, box_grid, fragments_of, noise, rain, random_bits};
use super::{Context, Verdict};
use crate::buffers::BufferName;
use crate::config::{Assign, Test};
use crate::engine::workbench::{Case, Workbench, given};
use crate::measure::Capacities;
use crate::passes::scan;
use crate::{Result, cpu};

/// One workgroup and many, whole blocks and one more or less.
const SIZES: [u32; 8] = [1, 31, 33, 1023, 1025, 8193, 16_385, 32 * 1024 * 20 + 5];

/// Compaction and offsets equal their twins.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let lights = rain(10)?;
    for clusters in SIZES {
        let grid = box_grid([clusters, 1, 1]);
        let capacities =
            Capacities { visible_clusters: clusters, light_indices: 16, ..Capacities::default() };
        let case = Case { method: ORTHO, grid, lights: &lights, capacities };
        let bench = context.bench((Assign::Brute, Test::Auto), case)?;
        let fault = match compaction_fault(bench, clusters.into(), u64::from(clusters))? {
            None => offsets_fault(bench, clusters)?,
            fault => fault,
        };
        if let Some(fault) = fault {
            return Ok(Verdict::Wrong(fault));
        }
    }
    Ok(Verdict::Fine(format!(
        "exact at {} sizes from {} to {}",
        SIZES.len(),
        SIZES[0],
        SIZES[SIZES.len() - 1]
    )))
}

/// How compaction of a third of `clusters` differs from its twin, if it does.
///
/// # Errors
/// Whatever fails on the device.
pub fn compaction_fault(bench: &mut Workbench, clusters: u64, seed: u64) -> Result<Option<String>> {
    let bits = random_bits(clusters, 3, seed);
    let twin = cpu::compact(&fragments_of(&bits, clusters));
    let state = bench.compact(&bits)?;
    if state.visible_total as usize != twin.visible.len() {
        let (own, wanted) = (state.visible_total, twin.visible.len());
        return Ok(Some(format!("{own} visible clusters of {clusters}, not {wanted}")));
    }
    // A list of none takes no memory.
    let visible = bench.download(BufferName::VisibleClusters, (state.visible as usize).max(1))?;
    if visible[..state.visible as usize] != twin.visible {
        return Ok(Some(format!("other visible clusters of {clusters} than there are")));
    }
    let ranks = bench.download(BufferName::WordRanks, bits.len())?;
    let counts: Vec<u32> = bits.iter().map(|word| word.count_ones()).collect();
    let equal = ranks == cpu::scan(&counts)[..bits.len()];
    Ok((!equal).then(|| format!("wrong ranks of the words of {clusters} clusters")))
}

/// How the offsets of as many lists as there are `clusters`, of any lengths, differ from their twin, if they do.
///
/// # Errors
/// Whatever fails on the device.
pub fn offsets_fault(bench: &mut Workbench, clusters: u32) -> Result<Option<String>> {
    let state = bench.compact(&random_bits(clusters.into(), 1, 1))?;
    let mut random = noise(clusters.into());
    let lengths: Vec<u32> = (0..state.visible).map(|_| random() % 100).collect();
    bench.upload(BufferName::ListLengths, &lengths)?;
    bench.run(|r, frame| scan::light_offsets(r, frame, given()))?;
    let twin = cpu::scan(&lengths);
    let offsets = bench.download(BufferName::ListOffsets, twin.len())?;
    let total = bench.state()?.index_total;
    Ok((offsets != twin || Some(&total) != twin.last())
        .then(|| format!("wrong offsets of {clusters} lists, or a total of {total} that is not theirs")))
}
