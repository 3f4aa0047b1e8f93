//! The scene axis: scenes with their recordings, as JSON and as a flag.

use super::{FrameRange, Lighting, SceneEntry, schema, values};
use crate::lights::LatticeBox;
use schemars::JsonSchema;
use serde::Deserialize;
use std::fmt;
use std::str::FromStr;

/// One scene of the axis as JSON carries it.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "SceneEntry")]
#[serde(
    deny_unknown_fields,
    expecting = "an object with a scene and a recording, and maybe resolution, frames, lights and light_volumes"
)]
pub(super) struct RawSceneEntry {
    /// Scene: `street`, `temple`, `hall`, `city`, or the path of a .gltf, .glb or .obj file.
    #[schemars(length(min = 1))]
    scene: String,
    /// Recording: a bundled name, or the path of a JSON file.
    #[schemars(length(min = 1))]
    recording: String,
    /// Width and height of each view in this scene, pixels, instead of the configuration's.
    #[serde(default, deserialize_with = "values::de::resolution")]
    #[schemars(schema_with = "schema::resolution")]
    resolution: Option<[u32; 2]>,
    /// Frames to render of this recording, instead of the configuration's.
    #[serde(default)]
    #[schemars(schema_with = "schema::frames")]
    frames: Option<FrameRange>,
    /// Lights that are made in this scene, instead of the configuration's.
    #[serde(default)]
    lights: Vec<Lighting>,
    /// Boxes of `volume` in this scene, instead of the configuration's.
    #[serde(default)]
    #[schemars(with = "Vec<String>")]
    light_volumes: Vec<LatticeBox>,
}

impl TryFrom<RawSceneEntry> for SceneEntry {
    type Error = String;

    fn try_from(raw: RawSceneEntry) -> Result<Self, String> {
        let RawSceneEntry { scene, recording, resolution, frames, lights, light_volumes } = raw;
        values::passed(Self { scene, recording, resolution, frames, lights, light_volumes }, Self::check)
    }
}

impl SceneEntry {
    /// Refuses names that name nothing and values out of range.
    fn check(&self) -> Result<(), String> {
        values::check_text(&self.scene).map_err(|message| format!("scene: {message}"))?;
        values::check_text(&self.recording).map_err(|message| format!("recording: {message}"))?;
        self.resolution.as_ref().map_or(Ok(()), values::check_resolution)?;
        values::check_lights(&self.lights)?;
        self.frames.as_ref().map_or(Ok(()), FrameRange::check)
    }
}

/// Refuses an empty list of scenes.
pub(super) fn check_given(scenes: &[SceneEntry]) -> Result<(), String> {
    if scenes.is_empty() {
        return Err("no scene: give at least one with its recording, or leave the field out".into());
    }
    Ok(())
}

/// Refuses scenes with names that name nothing or values out of range.
pub(super) fn check_all(scenes: &[SceneEntry]) -> Result<(), String> {
    scenes.iter().try_for_each(SceneEntry::check)
}

impl fmt::Display for SceneEntry {
    /// Writes `SCENE=RECORDING[,WxH][,A..B/STEP]`, without lights of its own.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.scene, self.recording)?;
        if let Some([width, height]) = self.resolution {
            write!(f, ",{width}x{height}")?;
        }
        self.frames.map_or(Ok(()), |frames| write!(f, ",{frames}"))
    }
}

impl FromStr for SceneEntry {
    type Err = String;

    /// Reads `SCENE=RECORDING[,WxH][,A..B/STEP]`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!("`{text}` is no scene with its recording such as street=bistro or street=bistro,640x720")
        };
        let (scene, rest) = text.split_once('=').ok_or_else(wrong)?;
        let mut parts = rest.split(',').map(str::trim);
        let recording = parts.next().unwrap_or_default();
        let mut entry = Self::new(scene.trim(), recording);
        for part in parts {
            match values::resolution(part) {
                Ok(resolution) if entry.resolution.is_none() => entry.resolution = Some(resolution),
                _ if entry.frames.is_none() => entry.frames = Some(part.parse()?),
                _ => return Err(wrong()),
            }
        }
        values::passed(entry, Self::check)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_are_read_as_documented_and_survive_being_written() {
        for text in ["street=bistro", "a/b.gltf=c.json,640x720", "t=suntem,250..681/430", "t=s,4x3,5.."] {
            let entry: SceneEntry = text.parse().unwrap();
            assert_eq!(entry.to_string(), text);
        }
        for wrong in
            ["", "street", "=bistro", "street=", "street=b,0x4", "street=b,4x4,4x4", "street=b,1..2,3..4"]
        {
            assert!(wrong.parse::<SceneEntry>().is_err(), "{wrong}");
        }
    }
}
