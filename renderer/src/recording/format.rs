//! The recording file, `manylight.recording/1`, as data.

use crate::geometry::views::{Mirror, Pose};
use crate::json::{Check, Problem};
use crate::lights::rain::RainParameters;
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// Largest magnitude of a coordinate, metres: beyond it single precision is coarser than 0.1 m.
pub(crate) const MAX_COORDINATE: f64 = 1e6;

/// Least distance of the near plane, metres: with the farthest far plane, depths are then far from single precision's least
/// numbers.
const MIN_NEAR: f64 = 1e-6;

/// Largest tangent of a frustum's side: 89.94 degrees.
const MAX_TANGENT: f64 = 1000.0;

/// Least distance between the tangents of opposite sides, and that in parts of the larger one: thinner frusta leave single
/// precision too few numbers for pixels and clusters.
const MIN_EXTENT: f64 = 1e-6;
const MIN_EXTENT_PER_TANGENT: f64 = 1e-4;

/// How far a quaternion's length may be from 1.
const UNIT_TOLERANCE: f64 = 1e-6;

/// The version mark of the recording format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Format {
    /// The version this program reads and writes.
    #[serde(rename = "manylight.recording/1")]
    V1,
}

/// The fields of a recording file, in file order; every number is a decimal that reads back to the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordingFile {
    /// Mark of the format and its version.
    pub format: Format,
    /// Where the recording came from.
    pub source: Source,
    /// Time from one frame to the next, seconds; the rain's step too.
    pub dt_s: f64,
    /// Distance of the near plane, metres.
    pub near: f64,
    /// Distance of the far plane, metres.
    pub far: f64,
    /// The falling lights; without them it rains in the scene's own box.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rain: Option<RainParameters>,
    /// The head-mounted display; without one, there is one view with the frames' field of view.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hmd: Option<Hmd>,
    /// Head and eyes of each frame.
    pub frames: Vec<Frame>,
}

/// Where a recording came from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Source of the recording, for people: file, program, author.
    pub text: String,
    /// Hex SHA-256 of the file it was made from, if it was made from one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
}

/// A head-mounted display: its eyes, fixed to the head or moving from frame to frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hmd {
    /// Name of the head-mounted display.
    pub name: String,
    /// In view order, at least one.
    pub eyes: Vec<Eye>,
}

/// One eye of a head-mounted display.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Eye {
    /// Name of the view in images: letters, digits, `-` and `_`.
    pub name: String,
    /// One row that holds for all frames, or one row a frame.
    pub rows: Vec<EyeRow>,
    /// Where the eye sees the world in a mirror: its plane, one that holds for all frames, or one a frame.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mirror: Vec<MirrorRow>,
}

/// Head of one frame; in the file `[x, y, z, qx, qy, qz, qw, fov]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 8]", into = "[f64; 8]")]
pub struct Frame {
    /// World from head: position in metres, unit quaternion.
    pub head: Pose,
    /// Field of view along the longer axis of the image, radians.
    pub fov: f64,
}

/// One eye of one frame; in the file `[x, y, z, qx, qy, qz, qw, x0, x1, y0, y1]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 11]", into = "[f64; 11]")]
pub struct EyeRow {
    /// Head from eye: position in metres, unit quaternion.
    pub pose: Pose,
    /// Signed tangents x0 < x1 (left, right), y0 < y1 (bottom, top) of the frustum's sides.
    pub tangents: [f64; 4],
}

/// The mirror of one eye in one frame; in the file `[nx, ny, nz, offset]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 4]", into = "[f64; 4]")]
pub struct MirrorRow(pub Mirror);

impl From<[f64; 4]> for MirrorRow {
    fn from([x, y, z, offset]: [f64; 4]) -> Self {
        Self(Mirror { normal: DVec3::new(x, y, z), offset })
    }
}

impl From<MirrorRow> for [f64; 4] {
    fn from(MirrorRow(mirror): MirrorRow) -> Self {
        let DVec3 { x, y, z } = mirror.normal;
        [x, y, z, mirror.offset]
    }
}

impl From<[f64; 8]> for Frame {
    fn from([x, y, z, qx, qy, qz, qw, fov]: [f64; 8]) -> Self {
        Self { head: pose([x, y, z, qx, qy, qz, qw]), fov }
    }
}

impl From<Frame> for [f64; 8] {
    fn from(frame: Frame) -> Self {
        let [x, y, z, qx, qy, qz, qw] = numbers(&frame.head);
        [x, y, z, qx, qy, qz, qw, frame.fov]
    }
}

impl From<[f64; 11]> for EyeRow {
    fn from([x, y, z, qx, qy, qz, qw, x0, x1, y0, y1]: [f64; 11]) -> Self {
        Self { pose: pose([x, y, z, qx, qy, qz, qw]), tangents: [x0, x1, y0, y1] }
    }
}

impl From<EyeRow> for [f64; 11] {
    fn from(row: EyeRow) -> Self {
        let [x, y, z, qx, qy, qz, qw] = numbers(&row.pose);
        let [x0, x1, y0, y1] = row.tangents;
        [x, y, z, qx, qy, qz, qw, x0, x1, y0, y1]
    }
}

fn pose([x, y, z, qx, qy, qz, qw]: [f64; 7]) -> Pose {
    Pose { position: DVec3::new(x, y, z), rotation: DQuat::from_xyzw(qx, qy, qz, qw), mirror: None }
}

fn numbers(pose: &Pose) -> [f64; 7] {
    let (p, q) = (pose.position, pose.rotation);
    [p.x, p.y, p.z, q.x, q.y, q.z, q.w]
}

impl Frame {
    /// A frame whose head is turned by `yaw` about +Y, then by `pitch` about its own +X (radians), rounded to
    /// 1e-6 m and 1e-10 in quaternion and field of view, so that the last bits of a platform's sine and cosine
    /// stay out of recordings.
    pub(super) fn from_angles(position: DVec3, yaw: f64, pitch: f64, fov: f64) -> Self {
        let q = DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(pitch);
        let fine = |value: f64| round_to(value, 1e10);
        Self {
            head: Pose {
                position: position.to_array().map(|value| round_to(value, 1e6)).into(),
                rotation: DQuat::from_xyzw(fine(q.x), fine(q.y), fine(q.z), fine(q.w)),
                mirror: None,
            },
            fov: fine(fov),
        }
    }
}

/// `value` rounded to a multiple of 1/`per_unit`, without a negative zero.
pub(super) fn round_to(value: f64, per_unit: f64) -> f64 {
    (value * per_unit).round() / per_unit + 0.0
}

impl Hmd {
    /// The HTC Vive of Gelderen's chapter 6: both eyes 30.7 mm beside and 15 mm behind the head's centre.
    pub fn vive() -> Self {
        let eye = |name: &str, x: f64, tangents: [f64; 4]| Eye {
            name: name.to_owned(),
            rows: vec![EyeRow { pose: pose([x, 0.0, 0.015, 0.0, 0.0, 0.0, 1.0]), tangents }],
            mirror: vec![],
        };
        Self {
            name: "HTC Vive".to_owned(),
            eyes: vec![
                eye("left", -0.0307, [-1.3896277, 1.2424954, -1.4736392, 1.4612536]),
                eye("right", 0.0307, [-1.2475655, 1.3957016, -1.473202, 1.4637187]),
            ],
        }
    }

    /// This recording with one more eye, in the middle of the head, that sees in `mirror` all that the others see with
    /// their own tangents.
    pub fn with_mirror(mut self, mirror: Mirror) -> Self {
        let tangents = self.eyes.iter().flat_map(|eye| &eye.rows).map(|row| row.tangents);
        let widest =
            |a: [f64; 4], b: [f64; 4]| [a[0].min(b[0]), a[1].max(b[1]), a[2].min(b[2]), a[3].max(b[3])];
        let tangents = tangents.reduce(widest).unwrap_or([-1.0, 1.0, -1.0, 1.0]);
        let row = EyeRow { pose: Pose::IDENTITY, tangents };
        self.eyes.push(Eye { name: "mirror".to_owned(), rows: vec![row], mirror: vec![MirrorRow(mirror)] });
        self
    }

    /// Every eye's rows must be one, or one for each of `frames`, and so must its mirror's where it has one.
    pub(super) fn check_rows(&self, frames: usize) -> Result<(), Problem> {
        for (index, eye) in self.eyes.iter().enumerate() {
            let rows = [("rows", eye.rows.len()), ("mirror", eye.mirror.len().max(1))];
            if let Some((field, rows)) = rows.into_iter().find(|&(_, rows)| rows != 1 && rows != frames) {
                let message = format!("has {rows} rows; give 1, or {frames}, one a frame");
                return Err(Problem::new(message).under(field).under(index).under("eyes"));
            }
        }
        Ok(())
    }
}

impl Check for RecordingFile {
    fn check(&self) -> Result<(), Problem> {
        self.source.check().map_err(|problem| problem.under("source"))?;
        check_clock_and_depths(self.dt_s, self.near, self.far)?;
        self.rain.map_or(Ok(()), |rain| rain.check()).map_err(|problem| problem.under("rain"))?;
        if self.frames.is_empty() {
            return Err(Problem::new("a recording needs at least one frame").under("frames"));
        }
        if let Some(hmd) = &self.hmd {
            hmd.check()
                .and_then(|()| hmd.check_rows(self.frames.len()))
                .map_err(|problem| problem.under("hmd"))?;
        }
        for (index, frame) in self.frames.iter().enumerate() {
            frame.check().map_err(|problem| problem.under(index).under("frames"))?;
        }
        Ok(())
    }
}

/// The rules for time step and depth range, with their names in recordings and waypoint files.
pub(super) fn check_clock_and_depths(dt_s: f64, near: f64, far: f64) -> Result<(), Problem> {
    // Single precision counts: the rain's step is taken in it.
    if !(dt_s.is_finite() && dt_s as f32 > 0.0) {
        return Err(Problem::new(format!("{dt_s} is no time step; give seconds above 0")).under("dt_s"));
    }
    if !(near.is_finite() && near > 0.0) {
        return Err(Problem::new(format!("{near} is no distance; give metres above 0")).under("near"));
    }
    if near < MIN_NEAR {
        let message =
            format!("{near:e} m is nearer than single precision holds depths; give at least {MIN_NEAR:e} m");
        return Err(Problem::new(message).under("near"));
    }
    if !(far as f32 > near as f32 && far <= MAX_COORDINATE) {
        let message = format!("{far} must lie above near ({near}) and within {MAX_COORDINATE} m");
        return Err(Problem::new(message).under("far"));
    }
    Ok(())
}

/// A position in metres, as the first elements of a row or as a row of its own.
pub(super) fn check_position(position: DVec3) -> Result<(), Problem> {
    match position.to_array().iter().position(|value| value.is_nan() || value.abs() > MAX_COORDINATE) {
        Some(axis) => {
            let message = format!("{} is not within +-{MAX_COORDINATE} m", position[axis]);
            Err(Problem::new(message).under(axis))
        }
        None => Ok(()),
    }
}

/// A field of view in radians.
pub(super) fn check_fov(fov: f64) -> Result<(), Problem> {
    if !(fov > 0.0 && fov < std::f64::consts::PI) {
        return Err(Problem::new(format!("{fov} is no field of view; give radians between 0 and pi")));
    }
    let (least, most) = (2.0 * (0.5 * MIN_EXTENT).atan(), 2.0 * MAX_TANGENT.atan());
    if !(least..=most).contains(&fov) {
        let message =
            format!("{fov} is beyond what single precision holds; give {least:.1e} to {most:.4} radians");
        return Err(Problem::new(message));
    }
    Ok(())
}

/// The tangents of two opposite sides.
fn check_tangents(low: f64, high: f64) -> Result<(), Problem> {
    if !(low.is_finite() && high.is_finite() && low < high) {
        let message = format!("tangents {low} and {high} are not in order; give the lower one first");
        return Err(Problem::new(message));
    }
    let largest = low.abs().max(high.abs());
    if largest > MAX_TANGENT {
        let message =
            format!("tangents {low} and {high} are not within +-{MAX_TANGENT}; give a narrower frustum");
        return Err(Problem::new(message));
    }
    let least = MIN_EXTENT.max(MIN_EXTENT_PER_TANGENT * largest);
    if high - low < least {
        let message = format!(
            "tangents {low} and {high} lie too close for single precision; give them at least {least:.1e} apart"
        );
        return Err(Problem::new(message));
    }
    Ok(())
}

fn check_pose(pose: &Pose) -> Result<(), Problem> {
    check_position(pose.position)?;
    let length = pose.rotation.length();
    if (length - 1.0).abs() <= UNIT_TOLERANCE {
        return Ok(());
    }
    Err(Problem::new(format!("the quaternion (elements 3 to 6) has length {length}, not 1")))
}

impl Check for Frame {
    fn check(&self) -> Result<(), Problem> {
        check_pose(&self.head)?;
        check_fov(self.fov).map_err(|problem| problem.under(7))
    }
}

impl Check for EyeRow {
    fn check(&self) -> Result<(), Problem> {
        check_pose(&self.pose)?;
        let [x0, x1, y0, y1] = self.tangents;
        check_tangents(x0, x1).map_err(|problem| problem.under(7))?;
        check_tangents(y0, y1).map_err(|problem| problem.under(9))
    }
}

impl Check for Hmd {
    fn check(&self) -> Result<(), Problem> {
        if self.eyes.is_empty() {
            return Err(Problem::new("an HMD needs at least one eye").under("eyes"));
        }
        for (index, eye) in self.eyes.iter().enumerate() {
            let twin = self.eyes[..index].iter().any(|other| other.name == eye.name);
            let check = if twin { Err(taken(&eye.name)) } else { eye.check() };
            check.map_err(|problem| problem.under(index).under("eyes"))?;
        }
        Ok(())
    }
}

fn taken(name: &str) -> Problem {
    Problem::new(format!("`{name}` names two eyes")).under("name")
}

impl Check for Eye {
    fn check(&self) -> Result<(), Problem> {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if self.name.is_empty() || !self.name.chars().all(plain) {
            let message = format!("`{}` is no name; use letters, digits, - and _", self.name);
            return Err(Problem::new(message).under("name"));
        }
        for (index, row) in self.rows.iter().enumerate() {
            row.check().map_err(|problem| problem.under(index).under("rows"))?;
        }
        for (index, row) in self.mirror.iter().enumerate() {
            row.check().map_err(|problem| problem.under(index).under("mirror"))?;
        }
        Ok(())
    }
}

impl Check for MirrorRow {
    fn check(&self) -> Result<(), Problem> {
        let Mirror { normal, offset } = self.0;
        if offset.is_nan() || offset.abs() > MAX_COORDINATE {
            return Err(Problem::new(format!("{offset} is not within +-{MAX_COORDINATE} m")).under(3));
        }
        let length = normal.length();
        if (length - 1.0).abs() <= UNIT_TOLERANCE {
            return Ok(());
        }
        Err(Problem::new(format!("the normal (elements 0 to 2) has length {length}, not 1")))
    }
}

impl Check for Source {
    fn check(&self) -> Result<(), Problem> {
        match &self.sha256 {
            Some(hash) if hash.len() != 64 || !hash.bytes().all(|b| b.is_ascii_hexdigit()) => {
                Err(Problem::new("is no SHA-256; give 64 hex digits, or leave it out").under("sha256"))
            }
            _ => Ok(()),
        }
    }
}
