//! The CSV tables of one run. Equal records give equal bytes.

use super::stages::{GpuTimes, StageMinima};
use crate::measure::{ClusteringCounts, FrameCounts, FrameTimes};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// Columns of `frames.csv`.
pub(crate) const FRAMES: [&str; 20] = [
    "frame",
    "time_s",
    "views",
    "clusterings",
    "clusters",
    "visible_clusters",
    "light_indices",
    "lighting_computations",
    "needed_computations",
    "intersection_tests",
    "fragments_shaded",
    "fragments_without_cluster",
    "light_indices_dropped",
    "visible_clusters_dropped",
    "gpu_ms_frame",
    "gpu_ms_cluster",
    "gpu_ms_visibility",
    "gpu_ms_count_lights",
    "gpu_ms_assign_lights",
    "gpu_ms_shade",
];

/// Columns of `timings.csv`.
pub(crate) const TIMINGS: [&str; 5] = ["run", "frame", "stage", "gpu_ms", "cpu_ms"];

/// Columns of `clusterings.csv`.
pub(crate) const CLUSTERINGS: [&str; 9] = [
    "frame",
    "clustering",
    "dx",
    "dy",
    "dz",
    "visible_clusters",
    "light_indices",
    "intersection_tests",
    "lists_hash",
];

/// Columns of `histograms.csv`.
pub(crate) const HISTOGRAMS: [&str; 6] = ["frame", "clustering", "kind", "bin", "clusters", "fragments"];

/// `frames.csv`: the counters of each frame with the minimum over runs of its GPU times.
pub(super) fn write_frames(out: impl Write, counts: &[FrameCounts], minima: &StageMinima) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record(FRAMES)?;
    for frame in counts {
        let counters = [
            frame.clusters(),
            frame.visible_clusters(),
            frame.light_indices(),
            frame.lighting_computations,
            frame.needed_computations,
            frame.intersection_tests(),
            frame.fragments_shaded,
            frame.fragments_without_cluster,
            frame.light_indices_dropped(),
            frame.visible_clusters_dropped(),
        ];
        let head = [
            frame.frame.to_string(),
            frame.time_s.to_string(),
            frame.views.to_string(),
            frame.clusterings.len().to_string(),
        ];
        let GpuTimes { frame: whole, cluster, visibility, count_lights, assign_lights, shade } =
            minima.frame(frame.frame);
        let times = [whole, cluster, visibility, count_lights, assign_lights, shade];
        let cells = head.into_iter().chain(counters.iter().map(u64::to_string)).chain(times.map(optional_ms));
        csv.write_record(cells.collect::<Vec<_>>())?;
    }
    csv.flush()
}

/// `timings.csv`: every stage of every frame of every temporal run.
pub(super) fn write_timings(out: impl Write, times: &[FrameTimes]) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record(TIMINGS)?;
    for frame in times {
        let (run, number) = (frame.run.to_string(), frame.frame.to_string());
        for stage in &frame.stages {
            csv.write_record([&run, &number, &stage.stage, &ms(stage.gpu_ms), &ms(stage.cpu_ms)])?;
        }
    }
    csv.flush()
}

/// `clusterings.csv`: the grid and counters of each clustering of each frame. `lists_hash` is hexadecimal.
pub(super) fn write_clusterings(out: impl Write, counts: &[FrameCounts]) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record(CLUSTERINGS)?;
    for frame in counts {
        for (number, clustering) in frame.clusterings.iter().enumerate() {
            let [dx, dy, dz] = clustering.dimensions.map(|d| d.to_string());
            csv.write_record([
                frame.frame.to_string(),
                number.to_string(),
                dx,
                dy,
                dz,
                clustering.visible_clusters.to_string(),
                clustering.light_indices.to_string(),
                clustering.intersection_tests.to_string(),
                format!("{:016x}", clustering.lists_hash),
            ])?;
        }
    }
    csv.flush()
}

/// How many clusters and fragments fall into each bin that occurs, ascending.
type Histogram = BTreeMap<u32, (u64, u64)>;

/// The kinds of `histograms.csv`, in their order.
pub(super) const KINDS: [&str; 3] = ["lights_per_cluster", "fragments_per_cluster", "lights_per_fragment"];

/// `histograms.csv`: exact bins. Of kind `lights_per_cluster`, `fragments` counts those in the clusters of the bin;
/// of kind `lights_per_fragment`, shaded fragments, and `clusters` those whose lists have that length.
pub(super) fn write_histograms(out: impl Write, counts: &[FrameCounts]) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record(HISTOGRAMS)?;
    for frame in counts {
        for number in 0..frame.clusterings.len().max(frame.lights_per_fragment.len()) {
            let clustering = frame.clusterings.get(number);
            let shaded = frame.lights_per_fragment.get(number).map_or(&[][..], Vec::as_slice);
            for (kind, histogram) in histograms(clustering, shaded) {
                for (bin, (clusters, fragments)) in histogram {
                    let numbers = [clusters, fragments].map(|n| n.to_string());
                    let [clusters, fragments] = &numbers;
                    let (frame, number, bin) = (frame.frame.to_string(), number.to_string(), bin.to_string());
                    csv.write_record([&frame, &number, kind, &bin, clusters, fragments])?;
                }
            }
        }
    }
    csv.flush()
}

fn histograms(
    clustering: Option<&ClusteringCounts>,
    shaded: &[(u32, u64)],
) -> [(&'static str, Histogram); 3] {
    let (mut by_lights, mut by_fragments) = (Histogram::new(), Histogram::new());
    for cluster in clustering.map_or(&[][..], |clustering| &clustering.clusters) {
        for (histogram, bin) in [(&mut by_lights, cluster.lights), (&mut by_fragments, cluster.fragments)] {
            let (clusters, fragments) = histogram.entry(bin).or_default();
            *clusters += 1;
            *fragments += u64::from(cluster.fragments);
        }
    }
    let clusters_with = |lights: u32| by_lights.get(&lights).map_or(0, |(clusters, _)| *clusters);
    let per_fragment =
        shaded.iter().map(|&(lights, fragments)| (lights, (clusters_with(lights), fragments))).collect();
    let [lights, fragments, shaded] = KINDS;
    [(lights, by_lights), (fragments, by_fragments), (shaded, per_fragment)]
}

/// Milliseconds to the nanosecond.
pub(super) fn ms(value: f64) -> String {
    format!("{value:.6}")
}

/// Milliseconds, or an empty cell.
pub(super) fn optional_ms(value: Option<f64>) -> String {
    value.map(ms).unwrap_or_default()
}
