//! Stage times: the minimum over the runs of each stage, then sums over views and clusterings.

use crate::measure::FrameTimes;
use std::collections::BTreeMap;

/// GPU time of every stage of every frame, milliseconds: its minimum over the temporal runs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StageMinima {
    frames: BTreeMap<u32, BTreeMap<String, f64>>,
}

/// The stage of everything.
pub const FRAME: &str = "frame";

/// What it takes to know the lengths of the light lists, from lights as the frame has them.
pub const COUNTING: [&str; 14] = [
    "frame/cluster/transform_lights",
    "frame/cluster/cull_lights",
    "frame/cluster/build_hierarchy",
    "frame/cluster/count_lights",
    "frame/cluster/light_rectangles",
    "frame/cluster/count_rectangles",
    "frame/cluster/mesh_frames",
    "frame/cluster/shell_points",
    "frame/cluster/shell_spots",
    "frame/cluster/clear_lists",
    "frame/cluster/fill_points",
    "frame/cluster/fill_spots",
    "frame/cluster/count_points",
    "frame/cluster/count_spots",
];

/// Where each list begins.
const OFFSETS: &str = "frame/cluster/light_offsets";

/// Writing of the light lists.
pub const ASSIGNING: [&str; 4] = [
    "frame/cluster/assign_lights",
    "frame/cluster/fill_rectangles",
    "frame/cluster/write_lists",
    "frame/cluster/sort_lists",
];

/// What frames do only where that which it is made of has changed.
const ON_CHANGE: &str = "frame/cluster/build_boxes";

/// Whether every frame has the stage with this path if one has.
pub(super) fn is_everyones(path: &str) -> bool {
    !kind(path).starts_with(ON_CHANGE)
}

/// Whether the stage with this path lies between lights and light lists: counting, offsets, writing.
pub fn makes_lists(path: &str) -> bool {
    let kind = kind(path);
    COUNTING.iter().chain(&ASSIGNING).chain([&OFFSETS]).any(|stage| *stage == kind)
}

impl StageMinima {
    /// Takes the minimum of each stage of each frame over the runs in `times`, which may come in any order.
    pub fn from_times(times: &[FrameTimes]) -> Self {
        let mut frames: BTreeMap<u32, BTreeMap<String, f64>> = BTreeMap::new();
        for frame in times {
            let minima = frames.entry(frame.frame).or_default();
            for stage in &frame.stages {
                let minimum = minima.entry(stage.stage.clone()).or_insert(f64::INFINITY);
                *minimum = minimum.min(stage.gpu_ms);
            }
        }
        Self { frames }
    }

    /// The time of the stages of these kinds in a frame, milliseconds. Stages that did not occur took no time, unless
    /// the frame alone was timed.
    pub fn sum(&self, frame: u32, kinds: &[&str]) -> Option<f64> {
        let minima = self.frames.get(&frame)?;
        let is_timed = kinds.contains(&FRAME) || minima.keys().any(|path| path != FRAME);
        let stages = minima.iter().filter(|(path, _)| kinds.contains(&kind(path).as_str()));
        // A fold, for the sum of nothing is -0.
        is_timed.then(|| stages.fold(0.0, |sum, (_, ms)| sum + ms))
    }
}

/// A stage's path without the numbers of views and clusterings.
pub(crate) fn kind(path: &str) -> String {
    let mut depth = 0_u32;
    path.chars()
        .filter(|c| {
            match c {
                '[' => depth += 1,
                ']' => depth = depth.saturating_sub(1),
                _ => return depth == 0,
            }
            false
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{FrameCounts, StageTime};
    use crate::output::rows::FrameRow;

    /// The times of frame 7 by column, without `gpu_ms_`.
    fn columns(minima: &StageMinima) -> Vec<(&'static str, Option<f64>)> {
        let row = FrameRow::new(&FrameCounts { frame: 7, ..FrameCounts::default() }, minima);
        row.times().map(|(column, ms)| (column.strip_prefix("gpu_ms_").unwrap(), ms)).collect()
    }

    fn times(run: u32, stages: &[(&str, f64)]) -> FrameTimes {
        let stages =
            stages.iter().map(|&(stage, gpu_ms)| StageTime { stage: stage.into(), gpu_ms, cpu_ms: 0.0 });
        FrameTimes { run, frame: 7, stages: stages.collect() }
    }

    #[test]
    fn minima_are_taken_per_stage_before_stages_are_summed() {
        let minima = StageMinima::from_times(&[
            times(
                0,
                &[
                    ("frame", 20.0),
                    ("frame/lights", 0.5),
                    ("frame/cluster[0]", 6.0),
                    ("frame/cluster[0]/depth[0]", 1.0),
                    ("frame/cluster[0]/mark[0]", 2.0),
                    ("frame/cluster[0]/cull_lights", 0.25),
                    ("frame/cluster[0]/build_hierarchy", 0.125),
                    ("frame/cluster[0]/count_lights", 1.0),
                    ("frame/cluster[0]/assign_lights", 2.0),
                    ("frame/cluster[1]", 9.0),
                    ("frame/cluster[1]/depth[1]", 4.0),
                    ("frame/cluster[1]/count_lights", 3.0),
                    ("frame/shade[0]", 5.0),
                    ("frame/shade[0]/opaque", 4.0),
                    ("frame/shade[1]", 3.0),
                ],
            ),
            times(
                1,
                &[
                    ("frame", 21.0),
                    ("frame/cluster[0]", 8.0),
                    ("frame/cluster[0]/depth[0]", 0.5),
                    ("frame/cluster[0]/mark[0]", 3.0),
                    ("frame/cluster[1]", 7.0),
                    ("frame/cluster[1]/depth[1]", 6.0),
                    ("frame/cluster[1]/count_lights", 2.0),
                    ("frame/shade[0]", 6.0),
                    ("frame/shade[1]", 1.0),
                ],
            ),
        ]);
        let expected = [
            ("frame", Some(20.0)),
            ("cluster", Some(6.0 + 7.0)),
            ("visibility", Some(0.5 + 2.0 + 4.0)),
            ("count_lights", Some(0.25 + 0.125 + 1.0 + 2.0)),
            ("assign_lights", Some(2.0)),
            ("shade", Some(5.0 + 1.0)),
        ];
        assert_eq!(columns(&minima), expected);
        assert!(columns(&StageMinima::default()).iter().all(|(_, ms)| ms.is_none()));
    }

    #[test]
    fn counting_takes_lights_into_clusters_space_by_every_way() {
        let counting = |stages: &[&str]| {
            let timed: Vec<(String, f64)> =
                stages.iter().map(|stage| (format!("frame/cluster[0]/{stage}"), 1.0)).collect();
            let timed: Vec<(&str, f64)> = timed.iter().map(|(stage, ms)| (stage.as_str(), *ms)).collect();
            columns(&StageMinima::from_times(&[times(0, &timed)]))[3]
        };
        let brute = ["compact", "transform_lights", "count_lights", "light_offsets", "assign_lights"];
        assert_eq!(counting(&brute), ("count_lights", Some(2.0)));
        let scatter = ["compact", "cull_lights", "count_lights", "light_offsets", "assign_lights"];
        assert_eq!(counting(&scatter), ("count_lights", Some(2.0)));
        assert_eq!(
            brute.map(|stage| makes_lists(&format!("frame/cluster[1]/{stage}"))),
            [false, true, true, true, true]
        );
        assert!(!makes_lists("frame/cluster[0]") && !makes_lists("frame/lights"));
    }

    #[test]
    fn stages_of_all_views_at_once_count_as_those_of_each() {
        let at_once = StageMinima::from_times(&[times(
            0,
            &[
                ("frame", 20.0),
                ("frame/cluster[0]", 6.0),
                ("frame/cluster[0]/depth", 1.0),
                ("frame/cluster[0]/mark[0]", 2.0),
                ("frame/cluster[1]", 3.0),
                ("frame/cluster[1]/mark[1]", 0.5),
                ("frame/shade", 5.0),
            ],
        )]);
        let expected = [("cluster", Some(6.0 + 3.0)), ("visibility", Some(1.0 + 2.0 + 0.5))];
        assert_eq!(columns(&at_once)[1..3], expected);
        assert_eq!(columns(&at_once)[5], ("shade", Some(5.0)));
    }

    #[test]
    fn what_was_not_timed_is_not_zero() {
        let frame_alone = columns(&StageMinima::from_times(&[times(0, &[("frame", 2.0)])]));
        assert_eq!(frame_alone[0], ("frame", Some(2.0)));
        assert!(frame_alone[1..].iter().all(|(_, ms)| ms.is_none()));
        let stages =
            [("frame", 2.0), ("frame/depth[0]", 0.25), ("frame/depth[1]", 0.5), ("frame/shade[0]", 1.0)];
        let all_lights = columns(&StageMinima::from_times(&[times(0, &stages)]));
        assert_eq!(all_lights[1..3], [("cluster", Some(0.0)), ("visibility", Some(0.75))]);
    }
}
