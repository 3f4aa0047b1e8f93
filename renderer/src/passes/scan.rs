//! The one prefix sum: stages `compact` (over the visibility words), `tile_offsets` (over the clusters of tiles) and
//! `light_offsets` (over the lengths of the lists), and parts of others (over the digits of the sort, the packets of scatter's groups).
//!
//! ```text
//! items ──reduce──> block_sums ──block_offsets──> block_sums, total ──apply──> exclusive prefix per item
//! items ──single──> total, exclusive prefix per item                           where there are few
//! ```

use super::handles::VisibleClusters;
use super::inputs::Frame;
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::gpu_interface::{
    ASSIGN_WORKGROUP, DISPATCH_SCAN, DISPATCH_SORT_SCAN, SCAN_BLOCK, SORT_BLOCK, SORT_DIGITS,
};
use crate::pass::{Dispatch, Push, Recorder, Size};
use crate::pipelines::ScanPipelines;

/// Up to this many blocks one workgroup scans them all: two dispatches fewer.
const MAX_SINGLE_BLOCKS: u32 = 16;

/// What a prefix sum sums, and where it goes.
struct Scan<'a> {
    pipelines: &'a ScanPipelines,
    /// Items, at most.
    items: u32,
    /// Index of the dispatch size that says how many blocks there are, where the device alone knows.
    size: Option<u32>,
    /// What tells how many items there are.
    length: BufferSet,
    /// The items.
    summed: BufferSet,
    /// What else is read of an item once its prefix is known.
    emitted: BufferSet,
    /// What becomes of the items and their prefixes.
    emits: BufferSet,
    /// What follows from the total.
    publishes: BufferSet,
    push: Push,
}

/// Ranks the visibility words and lists the visible clusters by ascending index.
pub fn compact(r: &mut Recorder, frame: &Frame, clustering: usize) -> VisibleClusters {
    r.scope("compact", |r| {
        let scan = Scan {
            pipelines: &frame.pipelines.clustered().compact,
            items: frame.clusterings[clustering].word_count,
            size: None,
            length: BufferSet::EMPTY,
            summed: set(&[B::ClusterBits]),
            emitted: BufferSet::EMPTY,
            emits: set(&[B::WordRanks, B::VisibleClusters]),
            publishes: set(&[B::State, B::Dispatches]),
            push: Push::default(),
        };
        record(r, frame, clustering, &scan);
    });
    VisibleClusters { clustering }
}

/// Lists the visible clusters tile by tile, from the slices that tiles have.
pub fn tile_offsets(r: &mut Recorder, frame: &Frame, clustering: usize) -> VisibleClusters {
    r.scope("tile_offsets", |r| {
        let [columns, rows, _] = frame.clusterings[clustering].dimensions;
        let scan = Scan {
            pipelines: &frame.pipelines.clustered().sort_tiles().tile_offsets,
            items: columns * rows,
            size: None,
            length: BufferSet::EMPTY,
            summed: set(&[B::TileCounts]),
            emitted: set(&[B::TileSlices]),
            emits: set(&[B::TileOffsets, B::VisibleClusters]),
            publishes: set(&[B::TileOffsets, B::State, B::Dispatches]),
            push: Push::default(),
        };
        record(r, frame, clustering, &scan);
    });
    VisibleClusters { clustering }
}

/// Offsets of the lists from their lengths.
pub fn light_offsets(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let clustering = visible.clustering;
    r.scope("light_offsets", |r| {
        let scan = Scan {
            pipelines: &frame.pipelines.clustered().light_offsets,
            items: frame.clusterings[clustering].visible_capacity,
            size: Some(DISPATCH_SCAN),
            length: set(&[B::State]),
            summed: set(&[B::ListLengths]),
            emitted: BufferSet::EMPTY,
            emits: set(&[B::ListOffsets]),
            publishes: set(&[B::State, B::ListOffsets]),
            push: Push::default(),
        };
        record(r, frame, clustering, &scan);
    });
}

/// Gives groups of visible clusters the packets that their lights fill.
pub(super) fn group_packets(r: &mut Recorder, frame: &Frame, visible: VisibleClusters) {
    let clustering = visible.clustering;
    let scan = Scan {
        pipelines: &frame.pipelines.accelerated().group_packets,
        items: frame.clusterings[clustering].visible_capacity.div_ceil(ASSIGN_WORKGROUP),
        size: None,
        length: set(&[B::State]),
        summed: set(&[B::Groups]),
        emitted: BufferSet::EMPTY,
        emits: set(&[B::Groups, B::PacketGroups]),
        publishes: set(&[B::State, B::Dispatches]),
        push: Push::default(),
    };
    record(r, frame, clustering, &scan);
}

/// Where each digit of each block of the sort goes, in pass `step`.
pub(super) fn digit_offsets(r: &mut Recorder, frame: &Frame, visible: VisibleClusters, step: u32) {
    let clustering = visible.clustering;
    let scan = Scan {
        pipelines: &frame.pipelines.accelerated().digit_offsets,
        items: frame.lights.count.div_ceil(SORT_BLOCK) * SORT_DIGITS,
        size: Some(DISPATCH_SORT_SCAN),
        length: set(&[B::State]),
        summed: set(&[B::DigitCounts]),
        emitted: BufferSet::EMPTY,
        emits: set(&[B::DigitCounts]),
        publishes: BufferSet::EMPTY,
        push: Push::step(step),
    };
    record(r, frame, clustering, &scan);
}

fn record(r: &mut Recorder, frame: &Frame, clustering: usize, scan: &Scan) {
    let Scan { pipelines, length, summed, emitted, emits, publishes, push, .. } = *scan;
    let blocks = scan.items.div_ceil(SCAN_BLOCK);
    let items = length | summed;
    let mut run = |pipeline, size, reads: BufferSet, writes: BufferSet| {
        // What is written need not be said to be read.
        let declared = (reads - writes, writes);
        r.dispatch(&Dispatch { push, ..Dispatch::new(pipeline, frame.buffers(clustering), size, declared) });
    };
    if blocks <= MAX_SINGLE_BLOCKS {
        run(&pipelines.single, Size::Workgroups(1, 1), items | emitted, emits | publishes);
        return;
    }
    let size = scan.size.map_or(Size::Workgroups(blocks, 1), Size::Indirect);
    let sums = set(&[B::BlockSums]);
    run(&pipelines.reduce, size, items, sums);
    run(&pipelines.block_offsets, Size::Workgroups(1, 1), length, sums | publishes);
    run(&pipelines.apply, size, items | emitted | sums, emits);
}
