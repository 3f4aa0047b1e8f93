//! Frame selections: `A..B/STEP` and the list of frames of which something is written.

use super::values::passed;
use super::{ExrFrames, FrameRange};
use crate::{Error, Result};
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

impl FrameRange {
    /// The chosen frame numbers, ascending, of a recording with `available` frames.
    ///
    /// # Errors
    /// The range reaches beyond the recording.
    pub fn frames(&self, available: u32) -> Result<Vec<u32>> {
        let end = self.end.unwrap_or(available);
        if self.first >= available || end > available {
            return Err(Error::input(format!(
                "frames {self} reach beyond the recording: it has {available} frames, 0..{available}"
            )));
        }
        Ok((self.first..end).step_by(self.step as usize).collect())
    }

    /// Whether `frame` is in the range, given that the recording has it.
    pub fn contains(&self, frame: u32) -> bool {
        frame >= self.first
            && self.end.is_none_or(|end| frame < end)
            && (frame - self.first).is_multiple_of(self.step.max(1))
    }

    /// Refuses an empty range and a step of zero.
    pub(super) fn check(&self) -> Result<(), String> {
        if self.step == 0 {
            return Err("a step of 0 frames: the step is at least 1".into());
        }
        match self.end {
            Some(end) if end <= self.first => Err(format!(
                "{}..{end} holds no frame: the end is left out and must be above the start",
                self.first
            )),
            _ => Ok(()),
        }
    }
}

impl FromStr for FrameRange {
    type Err = String;

    /// Reads `A..B/STEP` (B left out), where A, B and `/STEP` may each be missing, `/STEP`, or one number.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is no range of frames such as 300..600/40, ..600, /40 or 300");
        let number = |part: &str| part.parse::<u32>().map_err(|_| wrong());
        let (span, step) = match text.split_once('/') {
            Some((span, step)) => (span, Some(number(step)?)),
            None => (text, None),
        };
        let (first, end) = match span.split_once("..") {
            Some((first, end)) => (
                if first.is_empty() { 0 } else { number(first)? },
                if end.is_empty() { None } else { Some(number(end)?) },
            ),
            None if step.is_none() => {
                let frame = number(span)?;
                (frame, Some(frame.checked_add(1).ok_or_else(wrong)?))
            }
            None if span.is_empty() => (0, None),
            None => return Err(wrong()),
        };
        passed(Self { first, end, step: step.unwrap_or(1) }, Self::check)
    }
}

impl fmt::Display for FrameRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..", self.first)?;
        if let Some(end) = self.end {
            write!(f, "{end}")?;
        }
        if self.step != 1 {
            write!(f, "/{}", self.step)?;
        }
        Ok(())
    }
}

impl TryFrom<String> for FrameRange {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl Serialize for FrameRange {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl ExrFrames {
    /// Whether no frame is asked for.
    pub fn is_empty(&self) -> bool {
        matches!(self, Self::List(frames) if frames.is_empty())
    }

    /// Whether this frame is asked for by name, given that it is rendered: which frames counting finds is not known yet.
    pub fn contains(&self, frame: u32) -> bool {
        match self {
            Self::All => true,
            Self::Discontinuity => false,
            Self::List(frames) => frames.binary_search(&frame).is_ok(),
        }
    }

    /// Refuses frames that `field` asks for but that are not rendered; `rendered` is ascending.
    ///
    /// # Errors
    /// Names the first such frame.
    pub fn check_rendered(&self, field: &str, rendered: &[u32]) -> Result<()> {
        let Self::List(frames) = self else { return Ok(()) };
        match frames.iter().find(|frame| rendered.binary_search(frame).is_err()) {
            None => Ok(()),
            Some(frame) => Err(Error::input(format!(
                "{field}: frame {frame} is not among the frames rendered: widen frames, or leave it out"
            ))),
        }
    }

    /// These frames without those that `rendered` leaves out.
    #[must_use]
    pub fn within(&self, rendered: &FrameRange) -> Self {
        match self {
            Self::All | Self::Discontinuity => self.clone(),
            Self::List(frames) => {
                Self::List(frames.iter().copied().filter(|frame| rendered.contains(*frame)).collect())
            }
        }
    }

    /// Refuses frames that only counting finds.
    pub(super) fn check_named(&self) -> Result<(), String> {
        match self {
            Self::Discontinuity => {
                Err("discontinuity finds frames for images alone: name frames, or say all".into())
            }
            Self::All | Self::List(_) => Ok(()),
        }
    }

    fn from_frames(mut frames: Vec<u32>) -> Self {
        frames.sort_unstable();
        frames.dedup();
        Self::List(frames)
    }
}

impl FromStr for ExrFrames {
    type Err = String;

    /// Reads `all`, `none`, `discontinuity` or frame numbers with commas between.
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "all" => Ok(Self::All),
            "none" => Ok(Self::List(Vec::new())),
            "discontinuity" => Ok(Self::Discontinuity),
            list => list
                .split(',')
                .map(|frame| frame.trim().parse())
                .collect::<Result<Vec<u32>, _>>()
                .map(Self::from_frames)
                .map_err(|_| {
                    format!(
                        "`{text}` is neither `all`, `none`, `discontinuity` nor frame numbers such as 300,580"
                    )
                }),
        }
    }
}

impl Serialize for ExrFrames {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::All => serializer.serialize_str("all"),
            Self::Discontinuity => serializer.serialize_str("discontinuity"),
            Self::List(frames) => frames.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for ExrFrames {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ExrVisitor)
    }
}

struct ExrVisitor;

impl<'de> Visitor<'de> for ExrVisitor {
    type Value = ExrFrames;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of frame numbers, \"all\", \"none\" or \"discontinuity\"")
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<ExrFrames, E> {
        text.parse().map_err(E::custom)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<ExrFrames, A::Error> {
        let mut frames = Vec::new();
        while let Some(frame) = seq.next_element()? {
            frames.push(frame);
        }
        Ok(ExrFrames::from_frames(frames))
    }
}
