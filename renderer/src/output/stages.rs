//! Stage times: the minimum over the runs of each stage, then sums over views and clusterings.

use crate::measure::FrameTimes;
use std::collections::BTreeMap;

/// GPU time of every stage of every frame, milliseconds: its minimum over the temporal runs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StageMinima {
    frames: BTreeMap<u32, BTreeMap<String, f64>>,
}

/// GPU times of one frame as `frames.csv` has them, milliseconds; `None` where nothing was timed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct GpuTimes {
    /// The whole frame.
    pub frame: Option<f64>,
    /// Everything that clusters, over all clusterings.
    pub cluster: Option<f64>,
    /// Depth pass and marking of visible clusters (Gelderen figure 6.8), over clusterings and views.
    pub visibility: Option<f64>,
    /// Counting of the lights of each cluster, over clusterings.
    pub count_lights: Option<f64>,
    /// Writing of the light lists, over clusterings.
    pub assign_lights: Option<f64>,
    /// Shading, over views.
    pub shade: Option<f64>,
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

    /// The times of one frame. A kind of stage that did not occur took no time, unless the frame alone was timed.
    pub fn frame(&self, frame: u32) -> GpuTimes {
        let Some(minima) = self.frames.get(&frame) else { return GpuTimes::default() };
        let detailed = minima.keys().any(|path| path != "frame");
        let sum = |kinds: &[&str]| {
            let stages = minima.iter().filter(|(path, _)| kinds.contains(&kind(path).as_str()));
            // A fold, for the sum of nothing is -0.
            detailed.then(|| stages.fold(0.0, |sum, (_, ms)| sum + ms))
        };
        GpuTimes {
            frame: minima.get("frame").copied(),
            cluster: sum(&["frame/cluster"]),
            visibility: sum(&["frame/cluster/depth", "frame/cluster/mark"]),
            count_lights: sum(&COUNTING),
            assign_lights: sum(&["frame/cluster/assign_lights"]),
            shade: sum(&["frame/shade"]),
        }
    }
}

/// What it takes to know the lengths of the lists.
const COUNTING: [&str; 3] =
    ["frame/cluster/cull_lights", "frame/cluster/build_hierarchy", "frame/cluster/count_lights"];

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
    use crate::measure::StageTime;

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
        let expected = GpuTimes {
            frame: Some(20.0),
            cluster: Some(6.0 + 7.0),
            visibility: Some(0.5 + 2.0 + 4.0),
            count_lights: Some(0.25 + 0.125 + 1.0 + 2.0),
            assign_lights: Some(2.0),
            shade: Some(5.0 + 1.0),
        };
        assert_eq!(minima.frame(7), expected);
        assert_eq!(minima.frame(8), GpuTimes::default());
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
        let of_frame = at_once.frame(7);
        assert_eq!(of_frame.visibility, Some(1.0 + 2.0 + 0.5));
        assert_eq!((of_frame.cluster, of_frame.shade), (Some(6.0 + 3.0), Some(5.0)));
    }

    #[test]
    fn what_was_not_timed_is_not_zero() {
        let frame_alone = StageMinima::from_times(&[times(0, &[("frame", 2.0)])]);
        assert_eq!(frame_alone.frame(7), GpuTimes { frame: Some(2.0), ..GpuTimes::default() });
        let all_lights = StageMinima::from_times(&[times(0, &[("frame", 2.0), ("frame/shade[0]", 1.0)])]);
        assert_eq!(all_lights.frame(7).cluster, Some(0.0));
    }
}
