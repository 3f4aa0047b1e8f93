//! Recordings: a camera's way through a scene, frame by frame, with the rain that falls meanwhile.
//!
//! A recording is a JSON file. `format` is `manylight.recording/1`; metres, seconds, radians; every number is a
//! decimal that reads back to the same bits:
//!
//! ```json
//! {
//!   "format": "manylight.recording/1",
//!   "source": {"text": "where it came from", "sha256": "of the file it was made from; may be left out"},
//!   "dt_s": 0.011111111111111112,
//!   "near": 0.4,
//!   "far": 100.0,
//!   "rain": {
//!     "seed": 1,
//!     "box_min": [-60, -20, -60], "box_max": [80, 60, 60],
//!     "velocity_min": [0.2, -20, 1], "velocity_max": [1.2, -14, 2.3],
//!     "tint": [0.5, 1],
//!     "gravity_step": [0, -0.04, 0], "damping": 0.99, "respawn_slab": 0.01
//!   },
//!   "hmd": {
//!     "name": "may be left out with the whole hmd",
//!     "eyes": [
//!       {"name": "left", "rows": [[-0.03, 0, 0, 0, 0, 0, 1, -1.4, 1.2, -1.5, 1.5]]},
//!       {"name": "window", "rows": [[0, 0, 0, 0, 0, 0, 1, -1, 1, -1, 1]], "mirror": [[0, 0, -1, -36]]}
//!     ]
//!   },
//!   "frames": [
//!     [17.8, 4.9, -41.8, 0, 0, 0, 1, 1.26]
//!   ]
//! }
//! ```
//!
//! Without `rain`, it rains in the box around the scene that is flown.
//!
//! A row of `frames` is the head of one frame, `[x, y, z, qx, qy, qz, qw, fov]`: position, world-from-head unit
//! quaternion, field of view along the longer axis of the image. A row of an eye is
//! `[x, y, z, qx, qy, qz, qw, x0, x1, y0, y1]`: head-from-eye position and unit quaternion, and the frustum's
//! signed side tangents; one row holds for all frames, else there is one row a frame. Heads and eyes look down
//! their -Z, +Y up. With an `hmd` there is one view an eye and `fov` rests; without one there is one view.
//!
//! An eye with a `mirror` sees the world reflected at a plane of the world, the points p with n·p = offset, a row of
//! `[nx, ny, nz, offset]` with n of length 1: left and right change places, and what lies behind the plane, where n does
//! not point, is not seen. It looks from where its own row says, so that its picture lies pixel by pixel on what an eye
//! of the same row sees through the mirror's frame. One row holds for all frames, else there is one row a frame.
//!
//! Playback ([`Recording::views`]) is a pure function of the frame number. Recordings come from files and from
//! the binary ([`load`]), from the thesis's own program ([`import_bin`]) and from waypoints ([`bake()`]).

pub mod bake;
mod format;
mod import;
mod write;

pub use bake::bake;
pub(crate) use format::MAX_COORDINATE;
pub use format::{Eye, EyeRow, Format, Frame, Hmd, MirrorRow, RecordingFile, Source};
pub use import::{ImportOptions, import_bin};

use crate::geometry::Frustum;
use crate::geometry::views::{Mirror, Pose, View, ViewSet};
use crate::json::{self, Check};
use crate::lights::rain::RainParameters;
use crate::{Error, Result};
use sha2::{Digest, Sha256};
use std::path::Path;

/// The recordings in the binary, by name.
const BUNDLED: [(&str, &str); 10] = [
    ("bistro", include_str!("../../../recordings/bistro.json")),
    ("suntem", include_str!("../../../recordings/suntem.json")),
    ("hall", include_str!("../../../recordings/hall.json")),
    ("aisle", include_str!("../../../recordings/aisle.json")),
    ("street", include_str!("../../../recordings/street.json")),
    ("city", include_str!("../../../recordings/city.json")),
    ("bistro-vive", include_str!("../../../recordings/bistro-vive.json")),
    ("bistro-mirror", include_str!("../../../recordings/bistro-mirror.json")),
    ("suntem-vive", include_str!("../../../recordings/suntem-vive.json")),
    ("hall-vive", include_str!("../../../recordings/hall-vive.json")),
];

/// The name of the one view of a recording without HMD.
const MONO: &str = "mono";

/// A checked recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    name: String,
    file: RecordingFile,
    sha256: String,
}

/// The names of the recordings in the binary.
pub fn bundled_names() -> impl Iterator<Item = &'static str> {
    BUNDLED.iter().map(|(name, _)| *name)
}

/// Loads a recording: a bundled one by its name, else the file at that path.
///
/// # Errors
/// [`Error::File`] with line, column and field where the file is no recording; [`Error::Input`] where a plain
/// name is neither bundled nor a file.
pub fn load(name_or_path: &str) -> Result<Recording> {
    if let Some((name, text)) = BUNDLED.iter().find(|(name, _)| *name == name_or_path) {
        return parse(name, Path::new(name), text.as_bytes());
    }
    let path = Path::new(name_or_path);
    let plain = path.extension().is_none() && path.components().count() <= 1;
    if plain && !path.exists() {
        return Err(unknown_name(name_or_path));
    }
    parse(&stem(path), path, &read(path)?)
}

/// The bytes of the file at `path`.
fn read(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).map_err(|error| Error::file(path, error))
}

fn parse(name: &str, path: &Path, bytes: &[u8]) -> Result<Recording> {
    let file = json::parse::<RecordingFile>(path, bytes)?;
    Ok(Recording { name: name.to_owned(), file, sha256: sha256(bytes) })
}

fn unknown_name(name: &str) -> Error {
    let near = bundled_names()
        .max_by(|a, b| strsim::jaro_winkler(name, a).total_cmp(&strsim::jaro_winkler(name, b)));
    let hint = near.filter(|near| strsim::jaro_winkler(name, near) > 0.8);
    let hint = hint.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
    let names = bundled_names().collect::<Vec<_>>().join(", ");
    Error::input(format!("`{name}` is neither a bundled recording ({names}) nor a file{hint}"))
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// The name of the file alone: what recordings say of where they came from holds on every machine.
fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

impl Recording {
    /// A recording of these fields, called `name`.
    ///
    /// # Errors
    /// [`Error::Input`] that names the field whose value is out of range or contradicts another.
    pub fn new(name: &str, file: RecordingFile) -> Result<Self> {
        file.check().map_err(|problem| Error::input(format!("recording {name}: {problem}")))?;
        let sha256 = sha256(write::to_json(&file)?.as_bytes());
        Ok(Self { name: name.to_owned(), file, sha256 })
    }

    /// Bundled name or file stem.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// All fields of the recording's file.
    pub fn file(&self) -> &RecordingFile {
        &self.file
    }

    /// Hex SHA-256 of the JSON file it was loaded from, or that [`Recording::save`] would write.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// How many frames there are, at least 1.
    pub fn frame_count(&self) -> u32 {
        self.file.frames.len() as u32
    }

    /// Time of `frame` since the first frame, seconds.
    pub fn time(&self, frame: u32) -> f64 {
        f64::from(frame) * self.file.dt_s
    }

    /// The falling lights; they step by the recording's `dt_s` a frame. `None` where it rains in the scene's own box.
    pub fn rain(&self) -> Option<&RainParameters> {
        self.file.rain.as_ref()
    }

    /// Names of the views, in the order of [`Recording::views`].
    pub fn view_names(&self) -> Vec<&str> {
        match &self.file.hmd {
            Some(hmd) => hmd.eyes.iter().map(|eye| eye.name.as_str()).collect(),
            None => vec![MONO],
        }
    }

    /// How many views there are, and whether some see the world in a mirror.
    pub fn view_set(&self) -> ViewSet {
        let mirrors = |hmd: &Hmd| hmd.eyes.iter().any(|eye| !eye.mirror.is_empty());
        ViewSet { count: self.view_names().len(), mirrors: self.file.hmd.as_ref().is_some_and(mirrors) }
    }

    /// The views of `frame`: one an eye of the HMD, with its tangents whatever the resolution; without an HMD
    /// one, symmetric, its field of view along the longer axis of `resolution` (width and height of a view in
    /// pixels).
    ///
    /// # Errors
    /// [`Error::Input`] where there is no such frame, or the resolution has no pixels.
    pub fn views(&self, frame: u32, resolution: [u32; 2]) -> Result<Vec<View>> {
        if resolution.contains(&0) {
            let [width, height] = resolution;
            return Err(Error::input(format!("a resolution of {width}x{height} has no pixels")));
        }
        let row = self.file.frames.get(frame as usize).ok_or_else(|| {
            let (name, count) = (&self.name, self.frame_count());
            Error::input(format!("recording {name} has no frame {frame}; it has 0 to {}", count - 1))
        })?;
        Ok(match &self.file.hmd {
            Some(hmd) => hmd.eyes.iter().map(|eye| self.eye_view(row, eye, frame)).collect(),
            None => vec![View {
                pose: unit(&row.head),
                frustum: self.frustum(symmetric_tangents(row.fov, resolution)),
            }],
        })
    }

    fn eye_view(&self, frame: &Frame, eye: &Eye, number: u32) -> View {
        let row = of_frame(&eye.rows, number).expect("a checked recording has one row, or one a frame");
        let mirror = of_frame(&eye.mirror, number).map(|row| unit_mirror(&row.0));
        let (head, eye) = (unit(&frame.head), unit(&row.pose));
        let pose = Pose {
            position: head.position + head.rotation * eye.position,
            rotation: (head.rotation * eye.rotation).normalize(),
            mirror,
        };
        View { pose, frustum: self.frustum(row.tangents) }
    }

    fn frustum(&self, [x0, x1, y0, y1]: [f64; 4]) -> Frustum {
        Frustum { x0, x1, y0, y1, z0: -self.file.far, z1: -self.file.near }
    }
}

/// The row of a frame among rows of all frames, or the one that holds for all; `None` of none.
fn of_frame<T>(rows: &[T], frame: u32) -> Option<&T> {
    if let [row] = rows { Some(row) } else { rows.get(frame as usize) }
}

/// A mirror's plane with its normal's length, 1 within the format's tolerance, made 1.
fn unit_mirror(mirror: &Mirror) -> Mirror {
    Mirror { normal: mirror.normal.normalize(), ..*mirror }
}

/// A pose with its quaternion's length, 1 within the format's tolerance, made 1.
fn unit(pose: &Pose) -> Pose {
    Pose { rotation: pose.rotation.normalize(), ..*pose }
}

/// x0, x1, y0, y1 of a field of view (radians) that spans the longer axis.
fn symmetric_tangents(fov: f64, [width, height]: [u32; 2]) -> [f64; 4] {
    let longer = f64::from(width.max(height));
    let half = (0.5 * fov).tan();
    let (x, y) = (half * (f64::from(width) / longer), half * (f64::from(height) / longer));
    [-x, x, -y, y]
}

#[cfg(test)]
mod tests;
