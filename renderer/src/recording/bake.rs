//! Baking waypoints to a recording, so that any scene can be flown without a window.
//!
//! A waypoint file is JSON; metres, seconds, radians:
//!
//! ```json
//! {
//!   "format": "manylight.waypoints/1",
//!   "fov": 1.5, "near": 0.4, "far": 100, "dt_s": 0.011111111111111112,
//!   "hmd": {"may be": "left out; as in a recording"},
//!   "rain": {"may be": "left out; as in a recording, else it rains in the box of the scene that is flown"},
//!   "waypoints": [
//!     {"position": [0, 2, 0], "target": [0, 2, -5], "time_s": 0},
//!     {"position": [4, 2, 0], "target": [0, 2, -5], "time_s": 2.5},
//!     {"position": [9, 6, 9], "target": [0, 2, -5], "time_s": 3, "cut": true}
//!   ]
//! }
//! ```
//!
//! There are at least two waypoints, their times rise, and `fov` spans the longer axis of the image. The camera
//! passes through every position at its time, looking at that waypoint's target, +Y up. At a waypoint with `cut` (left
//! out: no) it jumps: until then it stands at the waypoint before, if it got there, and there a flight of its own begins.
//! The first frame is at the first waypoint's time, the last one at or at most `dt_s` before the last one's.

mod spline;

use super::format::{MAX_COORDINATE, check_clock_and_depths, check_fov, check_position};
use super::{Format, Frame, Hmd, Recording, RecordingFile, Source, file_name, read, sha256, stem};
use crate::json::{self, Check, Problem};
use crate::lights::rain::RainParameters;
use crate::{Error, Result};
use glam::DVec3;
use serde::Deserialize;
use spline::Spline;
use std::path::Path;

/// More frames than this (three hours at 90 Hz) are taken for a slip in `dt_s` or a time.
const MAX_FRAMES: f64 = 1e6;

/// Nearer than this, metres, a target gives no direction.
const MIN_TARGET_DISTANCE: f64 = 1e-6;

/// The version mark of the waypoint format.
#[derive(Debug, Clone, Copy, Deserialize)]
enum WaypointFormat {
    #[serde(rename = "manylight.waypoints/1")]
    V1,
}

/// The fields of a waypoint file; see the module's text.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct WaypointFile {
    #[serde(rename = "format")]
    _format: WaypointFormat,
    fov: f64,
    near: f64,
    far: f64,
    dt_s: f64,
    hmd: Option<Hmd>,
    rain: Option<RainParameters>,
    waypoints: Vec<Waypoint>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct Waypoint {
    position: DVec3,
    target: DVec3,
    time_s: f64,
    #[serde(default)]
    cut: bool,
}

impl Check for WaypointFile {
    fn check(&self) -> Result<(), Problem> {
        check_fov(self.fov).map_err(|problem| problem.under("fov"))?;
        check_clock_and_depths(self.dt_s, self.near, self.far)?;
        self.rain.map_or(Ok(()), |rain| rain.check()).map_err(|problem| problem.under("rain"))?;
        for (index, waypoint) in self.waypoints.iter().enumerate() {
            waypoint.check().map_err(|problem| problem.under(index).under("waypoints"))?;
        }
        if let Some(index) = self.waypoints.windows(2).position(|pair| pair[0].time_s >= pair[1].time_s) {
            let message =
                format!("does not lie after {} of the waypoint before", self.waypoints[index].time_s);
            return Err(Problem::new(message).under("time_s").under(index + 1).under("waypoints"));
        }
        if self.waypoints.first().is_some_and(|first| first.cut) {
            let message = "there is nothing before the first waypoint to cut from: leave it out";
            return Err(Problem::new(message).under("cut").under(0).under("waypoints"));
        }
        if self.waypoints.len() < 2 {
            return Err(Problem::new("give at least two waypoints").under("waypoints"));
        }
        let frames = self.frame_count();
        if frames > MAX_FRAMES {
            let message = format!("makes {frames} frames; at most {MAX_FRAMES} can be baked");
            return Err(Problem::new(message).under("dt_s"));
        }
        match &self.hmd {
            Some(hmd) => hmd
                .check()
                .and_then(|()| hmd.check_rows(frames as usize))
                .map_err(|problem| problem.under("hmd")),
            None => Ok(()),
        }
    }
}

impl Check for Waypoint {
    fn check(&self) -> Result<(), Problem> {
        check_position(self.position).map_err(|problem| problem.under("position"))?;
        check_position(self.target).map_err(|problem| problem.under("target"))?;
        if self.time_s.abs() > MAX_COORDINATE {
            let message = format!("{} is not within +-{MAX_COORDINATE} s", self.time_s);
            return Err(Problem::new(message).under("time_s"));
        }
        if self.position.distance(self.target) < MIN_TARGET_DISTANCE {
            return Err(Problem::new("must lie away from the position").under("target"));
        }
        Ok(())
    }
}

impl WaypointFile {
    fn start_s(&self) -> f64 {
        self.waypoints[0].time_s
    }

    /// Frames from the first to the last waypoint, a whole number.
    fn frame_count(&self) -> f64 {
        let span = self.waypoints[self.waypoints.len() - 1].time_s - self.start_s();
        // A last waypoint that means to fall on a frame does, whatever the quotient's last bits are.
        (span / self.dt_s + 1e-6).floor() + 1.0
    }

    /// The heads of all frames.
    fn frames(&self) -> Result<Vec<Frame>> {
        let flights: Vec<Flight> = self.waypoints.chunk_by(|_, next| !next.cut).map(Flight::new).collect();
        let mut yaw = 0.0;
        (0..self.frame_count() as u32)
            .map(|frame| {
                let time = self.start_s() + f64::from(frame) * self.dt_s;
                // A cut that means to fall on a frame does.
                let begun = flights.partition_point(|flight| flight.start_s <= time + 1e-6 * self.dt_s);
                let [position, target] = flights[begun.max(1) - 1].at(time);
                let angles = look_along(target - position, yaw).ok_or_else(|| {
                    let message = "the splined target meets the position; move a waypoint, or add one";
                    Error::input(format!("at {time} s (frame {frame}) {message}"))
                })?;
                yaw = angles[0];
                Ok(Frame::from_angles(position, angles[0], angles[1], self.fov))
            })
            .collect()
    }
}

/// What lies between two cuts.
struct Flight {
    start_s: f64,
    positions: Spline,
    targets: Spline,
}

impl Flight {
    /// Through these waypoints, at least one.
    fn new(waypoints: &[Waypoint]) -> Self {
        let knots = |value: fn(&Waypoint) -> DVec3| {
            Spline::new(waypoints.iter().map(|waypoint| (waypoint.time_s, value(waypoint))).collect())
        };
        Self {
            start_s: waypoints[0].time_s,
            positions: knots(|waypoint| waypoint.position),
            targets: knots(|waypoint| waypoint.target),
        }
    }

    /// Position and target.
    fn at(&self, time: f64) -> [DVec3; 2] {
        [self.positions.at(time), self.targets.at(time)]
    }
}

/// Yaw and pitch (radians) of a camera that looks along `direction`; straight up or down it keeps `last_yaw`.
fn look_along(direction: DVec3, last_yaw: f64) -> Option<[f64; 2]> {
    if direction.length() < MIN_TARGET_DISTANCE {
        return None;
    }
    let level = direction.x.hypot(direction.z);
    let upright = level < 1e-9 * direction.length();
    let yaw = if upright { last_yaw } else { (-direction.x).atan2(-direction.z) };
    Some([yaw, direction.y.atan2(level)])
}

/// Bakes the waypoint file at `path` (format: see [the module](self)) to a recording named after it.
///
/// # Errors
/// [`Error::File`] with line, column and field where the file is no waypoint file, or its spline leads a frame's
/// position through its target.
pub fn bake(path: impl AsRef<Path>) -> Result<Recording> {
    let path = path.as_ref();
    let bytes = read(path)?;
    let waypoints: WaypointFile = json::parse(path, &bytes)?;
    let frames = waypoints.frames().map_err(|error| Error::file(path, error))?;
    let file = RecordingFile {
        format: Format::V1,
        source: Source {
            text: format!("baked from the {} waypoints of {}", waypoints.waypoints.len(), file_name(path)),
            sha256: Some(sha256(&bytes)),
        },
        dt_s: waypoints.dt_s,
        near: waypoints.near,
        far: waypoints.far,
        rain: waypoints.rain,
        hmd: waypoints.hmd,
        frames,
    };
    Recording::new(&stem(path), file).map_err(|error| Error::file(path, error))
}

#[cfg(test)]
mod tests;
