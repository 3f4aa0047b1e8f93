//! The frames of a run between which a measure of them lies.

use super::FrameCounts;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The frames of least and of most depth discontinuity among those that a run counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Extremes {
    /// Frame number of the first frame of the least.
    pub least: u32,
    /// Frame number of the last frame of the most.
    pub most: u32,
}

impl Extremes {
    /// Those of some frames; `None` without any.
    pub fn of(frames: &[FrameCounts]) -> Option<Self> {
        let least = frames.iter().min_by_key(|frame| frame.depth_discontinuity())?.frame;
        let most = frames.iter().max_by_key(|frame| frame.depth_discontinuity())?.frame;
        Some(Self { least, most })
    }

    /// Whether a frame is one of the two.
    pub fn contains(&self, frame: u32) -> bool {
        [self.least, self.most].contains(&frame)
    }
}

impl fmt::Display for Extremes {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "frames {} (least) and {} (most)", self.least, self.most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::DeviceCounts;

    fn frame((frame, depth_steps): (u32, u64)) -> FrameCounts {
        let counters = DeviceCounts { depth_steps, depth_pairs: 1 << 10, ..DeviceCounts::default() };
        FrameCounts { frame, counters, ..FrameCounts::default() }
    }

    #[test]
    fn the_outer_ones_of_equal_frames_are_told() {
        let of = |steps: &[(u32, u64)]| Extremes::of(&steps.iter().copied().map(frame).collect::<Vec<_>>());
        let found = of(&[(3, 9 << 20), (5, 1 << 20), (7, 9 << 20), (9, 1 << 20)]).unwrap();
        assert_eq!(
            (found, found.to_string()),
            (Extremes { least: 5, most: 7 }, "frames 5 (least) and 7 (most)".into())
        );
        assert!(found.contains(5) && !found.contains(3));
        assert_eq!(of(&[(4, 1)]), Some(Extremes { least: 4, most: 4 }));
        assert_eq!(of(&[]), None);
    }
}
