//! The rows of a run's CSV tables, each declared once: header, writer and readers follow from the type.

use super::stages::{self, StageMinima};
use crate::measure::{BuildPhase, FrameCounts, OctreeBuild, OctreeTable, StructureMemory};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// A row of a table of a run.
pub trait Row: Serialize + DeserializeOwned + PartialEq {
    /// The table's file.
    const FILE: &'static str;
    /// Its columns.
    const COLUMNS: &'static [&'static str];
    /// Columns that earlier versions did not write; what they lack is 0.
    const ADDED: &'static [&'static str];

    /// The first column whose value its type allows and no run has.
    fn unsound(&self) -> Option<&'static str>;
}

/// What a value must be beyond its type.
trait Cell {
    fn is_sound(&self) -> bool {
        true
    }
}

impl Cell for u32 {}
impl Cell for u64 {}
impl Cell for String {}
impl Cell for Cow<'static, str> {}

/// A quantity: finite and not negative.
impl Cell for f64 {
    fn is_sound(&self) -> bool {
        self.is_finite() && *self >= 0.0
    }
}

impl Cell for Option<f64> {
    fn is_sound(&self) -> bool {
        self.as_ref().is_none_or(Cell::is_sound)
    }
}

/// Declares a row by its file, its name and its columns, of which those that were added later have a default.
macro_rules! row {
    (
        $(#[$doc:meta])*
        $file:literal $name:ident $(added $($added:ident)+)? { $($(#[$meta:meta])* $column:ident: $type:ty,)* }
    ) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
        pub struct $name {
            $($(#[$meta])* pub $column: $type,)*
        }

        impl Row for $name {
            const FILE: &'static str = $file;
            const COLUMNS: &'static [&'static str] = &[$(stringify!($column)),*];
            const ADDED: &'static [&'static str] = &[$($(stringify!($added)),+)?];

            fn unsound(&self) -> Option<&'static str> {
                let cells = [$((stringify!($column), self.$column.is_sound())),*];
                cells.into_iter().find(|(_, sound)| !sound).map(|(column, _)| column)
            }
        }
    };
}

/// Declares the row of `frames.csv`: its counters, each by what it is of [`FrameCounts`], and its times, each by the
/// stages that it sums.
macro_rules! frame_row {
    (
        counters { $($(#[$counter_doc:meta])* $counter:ident: $type:ty = $count:expr;)* }
        times { $($(#[$time_doc:meta])* $time:ident = $stages:expr;)* }
    ) => {
        row! {
            /// A frame: the counters of the atemporal run, and GPU milliseconds, of each stage the minimum over the
            /// temporal runs; `None` where nothing was timed.
            "frames.csv" FrameRow added fragments_hidden lights_dropped lights_skipped depth_discontinuity octree_rebuilds octree_bytes
                octree_tables_hashed octree_bytes_uploaded octree_extra_indices {
                /// Frame number in the recording.
                frame: u32,
                /// Its time in the recording, seconds.
                #[serde(serialize_with = "cell::plain")]
                time_s: f64,
                $($(#[$counter_doc])* $counter: $type,)*
                $($(#[$time_doc])* #[serde(serialize_with = "cell::optional_ms")] $time: Option<f64>,)*
            }
        }

        impl FrameRow {
            /// The row of a frame.
            pub fn new(counts: &FrameCounts, minima: &StageMinima) -> Self {
                fn get<T>(counts: &FrameCounts, count: fn(&FrameCounts) -> T) -> T {
                    count(counts)
                }
                Self {
                    frame: counts.frame,
                    time_s: counts.time_s,
                    $($counter: get(counts, $count),)*
                    $($time: minima.sum(counts.frame, $stages),)*
                }
            }

            /// The counters, by column.
            pub fn counters(&self) -> impl Iterator<Item = (&'static str, u64)> {
                [$((stringify!($counter), u64::from(self.$counter))),*].into_iter()
            }

            /// The columns of times that a stage of this kind counts among.
            pub fn columns_of(kind: &str) -> impl Iterator<Item = &'static str> {
                let columns: [(&'static str, &[&str]); _] = [$((stringify!($time), $stages)),*];
                columns.into_iter().filter(move |(_, kinds)| kinds.contains(&kind)).map(|(column, _)| column)
            }

            /// The times, by column, milliseconds.
            pub fn times(&self) -> impl Iterator<Item = (&'static str, Option<f64>)> {
                [$((stringify!($time), self.$time)),*].into_iter()
            }
        }
    };
}

frame_row! {
    counters {
        /// Rendering cameras.
        views: u32 = |counts| counts.views;
        /// Grids: one a view for Indi, one for Encl.
        clusterings: u32 = |counts| counts.clusterings.len() as u32;
        /// Clusters of all grids.
        clusters: u64 = FrameCounts::clusters;
        /// Clusters with at least one visible fragment.
        visible_clusters: u64 = FrameCounts::visible_clusters;
        /// Sum of the lengths of all light lists.
        light_indices: u64 = FrameCounts::light_indices;
        /// Evaluations of one light for one fragment.
        lighting_computations: u64 = |counts| counts.counters.lighting_computations;
        /// Those closer than the light's radius R1.
        needed_computations: u64 = |counts| counts.counters.needed_computations;
        /// Sphere against cluster tests, of nodes of the hierarchy too.
        intersection_tests: u64 = FrameCounts::intersection_tests;
        /// Invocations of the shading pass that passed the depth test; with overdraw, of masked surfaces those that no opaque
        /// surface hides.
        fragments_shaded: u64 = |counts| counts.counters.fragments_shaded;
        /// Those of them that something hides in the end, with overdraw.
        #[serde(default)]
        fragments_hidden: u64 = |counts| counts.counters.fragments_hidden;
        /// Fragments that are seen whose cluster was not marked visible: none.
        fragments_without_cluster: u64 = |counts| counts.counters.fragments_without_cluster;
        /// Light indices that did not fit: none.
        light_indices_dropped: u64 = FrameCounts::light_indices_dropped;
        /// Visible clusters that did not fit: none.
        visible_clusters_dropped: u64 = FrameCounts::visible_clusters_dropped;
        /// Lights that capped lists were too full for; of other lists none.
        #[serde(default)]
        lights_dropped: u64 = |counts| counts.counters.lights_dropped;
        /// Lights that get onto no list of a cluster that they meet, for by its normal cones they lie behind all of its samples.
        #[serde(default)]
        lights_skipped: u64 = |counts| counts.counters.lights_skipped;
        /// Mean over neighbouring pixels of the first view of the octaves by which their distances differ, millionths.
        #[serde(default)]
        depth_discontinuity: u64 = FrameCounts::depth_discontinuity;
        /// How often the frame built an octree over the lights: not where they are those of the last.
        #[serde(default)]
        octree_rebuilds: u64 = FrameCounts::octree_rebuilds;
        /// What the octree's tables take, bytes.
        #[serde(default)]
        octree_bytes: u64 = FrameCounts::octree_bytes;
        /// Tables of the octree that the frame hashed: all where it built one.
        #[serde(default)]
        octree_tables_hashed: u64 = FrameCounts::octree_tables_hashed;
        /// What the frame took to the device of it, bytes.
        #[serde(default)]
        octree_bytes_uploaded: u64 = FrameCounts::octree_bytes_uploaded;
        /// Light indices of lights that do not reach all of their leaf, in octrees that are kept.
        #[serde(default)]
        octree_extra_indices: u64 = FrameCounts::octree_extra_indices;
    }
    times {
        /// The whole frame.
        gpu_ms_frame = &[stages::FRAME];
        /// Everything that clusters, over all clusterings; of an octree, its way to the device.
        gpu_ms_cluster = &["frame/cluster", "frame/octree"];
        /// Depth pass and marking of visible clusters (Gelderen figure 6.8), over clusterings and views; of a method
        /// without clusters, its depth pass.
        gpu_ms_visibility = &[
            "frame/depth", "frame/cluster/depth", "frame/cluster/mark", "frame/cluster/sort_tiles", "frame/cluster/bounds",
            "frame/cluster/cones",
        ];
        /// What it takes to know the lengths of the light lists, over clusterings.
        gpu_ms_count_lights = &stages::COUNTING;
        /// Writing of the light lists, over clusterings.
        gpu_ms_assign_lights = &stages::ASSIGNING;
        /// Shading, over views.
        gpu_ms_shade = &["frame/gbuffer", "frame/light", "frame/shade"];
    }
}

row! {
    /// The grid and the counters of one clustering of one frame.
    "clusterings.csv" ClusteringRow {
        /// Frame number in the recording.
        frame: u32,
        /// Which clustering of the frame.
        clustering: u32,
        /// Clusters along x.
        dx: u32,
        /// Clusters along y.
        dy: u32,
        /// Clusters along z.
        dz: u32,
        /// Clusters with at least one visible fragment.
        visible_clusters: u64,
        /// Sum of the lengths of the light lists.
        light_indices: u64,
        /// Sphere against cluster tests.
        intersection_tests: u64,
        /// Hash over all lists in order, 16 hexadecimal digits.
        lists_hash: String,
    }
}

row! {
    /// How many clusters and fragments fall into one bin. Of kind `lights_per_cluster`, `fragments` counts those in the
    /// clusters of the bin; of kind `lights_per_fragment`, shaded fragments, and `clusters` those whose lists have that
    /// length.
    "histograms.csv" HistogramRow {
        /// Frame number in the recording.
        frame: u32,
        /// Which clustering of the frame; which view, without clusters.
        clustering: u32,
        /// One of [`KINDS`].
        kind: Cow<'static, str>,
        /// How many lights or fragments.
        bin: u32,
        /// Clusters.
        clusters: u64,
        /// Fragments.
        fragments: u64,
    }
}

/// By how many lights clusters are counted in `histograms.csv`.
pub const LIGHTS_PER_CLUSTER: &str = "lights_per_cluster";
/// By how many fragments clusters are counted.
pub const FRAGMENTS_PER_CLUSTER: &str = "fragments_per_cluster";
/// By how many lights shaded fragments are counted.
pub const LIGHTS_PER_FRAGMENT: &str = "lights_per_fragment";

/// The kinds of `histograms.csv`, in their order.
pub const KINDS: [&str; 3] = [LIGHTS_PER_CLUSTER, FRAGMENTS_PER_CLUSTER, LIGHTS_PER_FRAGMENT];

row! {
    /// One stage of one frame of one temporal run.
    "timings.csv" TimingRow {
        /// Temporal run, from 0.
        run: u32,
        /// Frame number in the recording.
        frame: u32,
        /// Path in the stage tree.
        stage: String,
        /// GPU time, milliseconds; `None` where the device has no timestamps.
        #[serde(serialize_with = "cell::optional_ms")]
        gpu_ms: Option<f64>,
        /// CPU time spent recording it, milliseconds.
        #[serde(serialize_with = "cell::ms")]
        cpu_ms: f64,
    }
}

row! {
    /// What one structure takes of the device's memory in the temporal runs, over all clusterings.
    "memory.csv" MemoryRow {
        /// Name of the structure.
        structure: String,
        /// What it is for: the name of a [`Purpose`](crate::measure::Purpose).
        purpose: String,
        /// Allocated at the end, bytes.
        allocated: u64,
        /// What a frame needs of that, mean over frames, bytes.
        used: u64,
        /// What the frame that needs most needs, bytes.
        most: u64,
    }
}

row! {
    /// One table of the octree of a frame that built one.
    "octree.csv" OctreeRow {
        /// Frame number in the recording.
        frame: u32,
        /// `structure`: branches; `data`: filled leaves.
        table: String,
        /// Depth of the nodes that are its keys.
        depth: u32,
        /// How many nodes it holds.
        keys: u64,
        /// Slots a side, m.
        slot_side: u32,
        /// Offsets a side, r.
        offset_side: u32,
        /// What its slots take, bytes.
        slot_bytes: u64,
        /// What its offsets take, bytes.
        offset_bytes: u64,
        /// Lights of all its leaves.
        light_indices: u64,
    }
}

impl OctreeRow {
    /// The row of a table of the octree of a frame.
    pub fn new(frame: u32, table: &OctreeTable) -> Self {
        Self {
            frame,
            table: table.kind.name().into(),
            depth: table.depth,
            keys: table.memory.keys,
            slot_side: table.memory.side,
            offset_side: table.memory.offset_side,
            slot_bytes: table.memory.slot_bytes,
            offset_bytes: table.memory.offset_bytes,
            light_indices: table.light_indices,
        }
    }
}

row! {
    /// One step of building an octree beside the timed frames.
    "octree_builds.csv" OctreeBuildRow {
        /// When: the name of a [`BuildPhase`].
        phase: String,
        /// Frame number in the recording.
        frame: u32,
        /// Which step: one of [`BuildTimes::STEPS`](crate::octree::BuildTimes::STEPS).
        step: String,
        /// What it took the host, milliseconds.
        #[serde(serialize_with = "cell::ms")]
        cpu_ms: f64,
        /// Lights of the frame.
        lights: u64,
        /// Nodes that the tables hold.
        nodes: u64,
    }
}

impl OctreeBuildRow {
    /// The rows of a build, step by step.
    pub fn of(phase: BuildPhase, build: &OctreeBuild) -> impl Iterator<Item = Self> {
        let OctreeBuild { frame, lights, nodes, times } = *build;
        times.steps().into_iter().map(move |(step, seconds)| Self {
            phase: phase.to_string(),
            frame,
            step: step.into(),
            cpu_ms: 1e3 * seconds,
            lights,
            nodes,
        })
    }
}

impl MemoryRow {
    /// The row of a structure.
    pub fn new(memory: &StructureMemory) -> Self {
        let StructureMemory { structure, purpose, allocated, used, most } = *memory;
        Self { structure: structure.into(), purpose: purpose.to_string(), allocated, used, most }
    }
}

/// How cells are written.
pub(super) mod cell {
    use serde::Serializer;

    /// As short as the number allows.
    pub fn plain<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(value)
    }

    /// Milliseconds to the nanosecond.
    pub fn ms<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{value:.6}"))
    }

    /// Milliseconds to the nanosecond, or an empty cell.
    pub fn optional_ms<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
        match value {
            Some(value) => ms(value, serializer),
            None => serializer.serialize_none(),
        }
    }
}
