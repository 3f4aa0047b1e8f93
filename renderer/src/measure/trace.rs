//! When stages ran, for traces.

/// When one stage of one frame ran, nanoseconds. Host and device have a clock each, and how far apart they are is not
/// measured: the device's is placed so that its first stage begins where the first frame's recording ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StageSpan {
    /// Path in the stage tree, such as `frame/cluster[0]/count_lights`.
    pub stage: String,
    /// Start and end on the device; `None` where the stage has no timestamps.
    pub gpu_ns: Option<[u64; 2]>,
    /// Start and end of its recording on the host.
    pub cpu_ns: [u64; 2],
}

/// All stages of one frame of one temporal run, parents before children, in execution order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameTrace {
    /// Number of the temporal run, from 0.
    pub run: u32,
    /// Frame number in the recording.
    pub frame: u32,
    /// Stages in execution order.
    pub stages: Vec<StageSpan>,
}
