//! Importing the recordings of the thesis's own program: what its user did, played through its camera.

mod camera;
mod decode;

use super::{
    Format, Frame, Hmd, Recording, RecordingFile, Source, file_name, format::round_to, read, sha256, stem,
};
use crate::lights::rain::RainParameters;
use crate::{Error, Result};
use camera::Simulation;
use std::path::Path;

/// The time step of the thesis's recordings, seconds.
const DT_S: f64 = 1.0 / 90.0;

/// What an import adds to what the file holds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ImportOptions {
    /// Eyes for a stereo recording; the file itself knows none.
    pub hmd: Option<Hmd>,
}

/// Decodes a `.bin` recording of Gelderen's program and simulates its camera, one frame for each list of events.
/// The rain is that of his chapter 6.
///
/// # Errors
/// [`Error::File`] where the file cannot be read, is cut short, or is no such recording.
pub fn import_bin(path: impl AsRef<Path>, options: &ImportOptions) -> Result<Recording> {
    let path = path.as_ref();
    let bytes = read(path)?;
    import(path, &bytes, options)
}

fn import(path: &Path, bytes: &[u8], options: &ImportOptions) -> Result<Recording> {
    let decoded = decode::decode(bytes).map_err(|message| Error::file(path, message))?;
    let camera = decoded.camera;
    let mut simulation = Simulation::new(&camera, DT_S as f32);
    let frames = decoded.frames.iter().map(|events| Frame::from(simulation.step(events))).collect();
    let file = RecordingFile {
        format: Format::V1,
        source: Source {
            text: format!("{}, recorded with the program of Gelderen's thesis", file_name(path)),
            sha256: Some(sha256(bytes)),
        },
        dt_s: DT_S,
        // Rounded, as single-precision decimals such as 0.4 are meant.
        near: round_to(f64::from(-camera.z_near), 1e6),
        far: round_to(f64::from(-camera.z_far), 1e6),
        rain: Some(RainParameters::default()),
        hmd: options.hmd.clone(),
        frames,
    };
    Recording::new(&stem(path), file).map_err(|error| Error::file(path, error))
}

#[cfg(test)]
mod tests;
