//! The CSV tables of one run. Equal records give equal bytes.

use super::rows::{
    ClusteringRow, FRAGMENTS_PER_CLUSTER, FrameRow, HistogramRow, LIGHTS_PER_CLUSTER, LIGHTS_PER_FRAGMENT,
    OctreeRow, Row, TimingRow,
};
use super::stages::StageMinima;
use crate::measure::{ClusteringCounts, FrameCounts, FrameTimes};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// Writes a table: its header, which a table without rows has too, and its rows.
pub(super) fn write<R: Row>(out: impl Write, rows: impl IntoIterator<Item = R>) -> io::Result<()> {
    let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    csv.write_record(R::COLUMNS)?;
    for row in rows {
        csv.serialize(row)?;
    }
    csv.flush()
}

/// The counters of each frame with the minimum over runs of its GPU times.
pub(super) fn frames<'a>(
    counts: &'a [FrameCounts],
    minima: &'a StageMinima,
) -> impl Iterator<Item = FrameRow> + 'a {
    counts.iter().map(|frame| FrameRow::new(frame, minima))
}

/// Every stage of every frame of every temporal run.
pub(super) fn timings(times: &[FrameTimes]) -> impl Iterator<Item = TimingRow> + '_ {
    times.iter().flat_map(|frame| {
        frame.stages.iter().map(|stage| TimingRow {
            run: frame.run,
            frame: frame.frame,
            stage: stage.stage.clone(),
            gpu_ms: Some(stage.gpu_ms),
            cpu_ms: stage.cpu_ms,
        })
    })
}

/// The grid and counters of each clustering of each frame.
pub(super) fn clusterings(counts: &[FrameCounts]) -> impl Iterator<Item = ClusteringRow> + '_ {
    counts.iter().flat_map(|frame| {
        (0..).zip(&frame.clusterings).map(|(number, clustering)| {
            let [dx, dy, dz] = clustering.dimensions;
            ClusteringRow {
                frame: frame.frame,
                clustering: number,
                dx,
                dy,
                dz,
                visible_clusters: clustering.visible_clusters,
                light_indices: clustering.light_indices,
                intersection_tests: clustering.intersection_tests,
                lists_hash: format!("{:016x}", clustering.lists_hash),
            }
        })
    })
}

/// The tables of each octree, in the frame that built it.
pub(super) fn octrees(counts: &[FrameCounts]) -> impl Iterator<Item = OctreeRow> + '_ {
    let built = counts.iter().filter(|frame| frame.octree_rebuilds() > 0);
    built.flat_map(|frame| {
        let octrees = frame.clusterings.iter().filter_map(|clustering| clustering.octree.as_ref());
        octrees.flat_map(|octree| octree.tables.iter().map(|table| OctreeRow::new(frame.frame, table)))
    })
}

/// Exact bins, ascending, by frame, clustering and kind.
pub(super) fn histograms(counts: &[FrameCounts]) -> impl Iterator<Item = HistogramRow> + '_ {
    counts.iter().flat_map(|frame| {
        let most = frame.clusterings.len().max(frame.lights_per_fragment.len());
        (0..most).flat_map(|number| {
            let shaded = frame.lights_per_fragment.get(number).map_or(&[][..], Vec::as_slice);
            of_clustering(frame.frame, number as u32, (frame.clusterings.get(number), shaded))
        })
    })
}

/// How many clusters and fragments fall into each bin that occurs, ascending.
type Histogram = BTreeMap<u32, (u64, u64)>;

fn of_clustering(
    frame: u32,
    clustering: u32,
    (counts, shaded): (Option<&ClusteringCounts>, &[(u32, u64)]),
) -> impl Iterator<Item = HistogramRow> + use<> {
    let (mut by_lights, mut by_fragments) = (Histogram::new(), Histogram::new());
    for cluster in counts.map_or(&[][..], |counts| &counts.clusters) {
        for (histogram, bin) in [(&mut by_lights, cluster.lights), (&mut by_fragments, cluster.fragments)] {
            let (clusters, fragments) = histogram.entry(bin).or_default();
            *clusters += 1;
            *fragments += u64::from(cluster.fragments);
        }
    }
    let clusters_with = |lights: u32| by_lights.get(&lights).map_or(0, |(clusters, _)| *clusters);
    let per_fragment: Histogram =
        shaded.iter().map(|&(lights, fragments)| (lights, (clusters_with(lights), fragments))).collect();
    let kinds = [
        (LIGHTS_PER_CLUSTER, by_lights),
        (FRAGMENTS_PER_CLUSTER, by_fragments),
        (LIGHTS_PER_FRAGMENT, per_fragment),
    ];
    kinds.into_iter().flat_map(move |(kind, histogram)| {
        histogram.into_iter().map(move |(bin, (clusters, fragments))| HistogramRow {
            frame,
            clustering,
            kind: kind.into(),
            bin,
            clusters,
            fragments,
        })
    })
}
