//! The product of the axes, and what its runs are called.

use crate::config::{Config, ExrFrames, SceneEntry, resolution_name};
use crate::output::{PlannedRun, planned_runs};
use crate::{Error, Result};
use std::path::{Path, PathBuf};

/// The runs of one scene with one recording in one resolution.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Its directory in the output, empty where there is one part.
    pub directory: String,
    /// The configuration of this scene alone; [`Config::out`] is where its runs lie.
    pub config: Config,
    /// In the order of [`Config::cases`], without what is excluded.
    pub runs: Vec<PlannedRun>,
}

impl Part {
    /// What tells a run from all others of the sweep: its directory below the output.
    pub fn full_name(&self, run: &PlannedRun) -> String {
        if self.directory.is_empty() { run.name.clone() } else { format!("{}/{}", self.directory, run.name) }
    }

    /// Where a run lies when it is complete.
    pub fn path(&self, run: &PlannedRun) -> PathBuf {
        self.config.out.join(&run.name)
    }
}

/// All runs that a configuration asks for, by scene.
///
/// # Errors
/// Two scenes would share a directory, an image is asked for of a frame that no scene renders, no run is left, or one
/// has a test that cannot serve its method.
pub fn parts(config: &Config) -> Result<Vec<Part>> {
    check_images(config, &config.scene_entries())?;
    let scenes = config.by_scene();
    let directories = directories(&scenes)?;
    let mut parts = Vec::new();
    for (mut scene, directory) in scenes.into_iter().zip(directories) {
        if !directory.is_empty() {
            scene.out.push(&directory);
        }
        let mut runs = planned_runs(&scene);
        runs.retain(|run| !config.exclude.iter().any(|rule| rule.matches(&run.config)));
        runs.iter().try_for_each(PlannedRun::check)?;
        parts.push(Part { directory, config: scene, runs });
    }
    parts.retain(|part| !part.runs.is_empty());
    if parts.is_empty() {
        return Err(Error::input("exclude: no run is left: leave a rule out, or add to the axes"));
    }
    Ok(parts)
}

/// A directory for each: the scene's name, and behind it the recording's and the resolution where the name does not tell it.
fn directories(scenes: &[Config]) -> Result<Vec<String>> {
    if scenes.len() == 1 {
        return Ok(vec![String::new()]);
    }
    let names: Vec<String> = (0..scenes.len()).map(|place| directory(scenes, place)).collect();
    match names.iter().enumerate().find(|(i, name)| names[..*i].contains(name)) {
        Some((_, twin)) => Err(Error::Input(format!(
            "scenes: two of them would be written to the directory {twin}: give each scene and recording once"
        ))),
        None => Ok(names),
    }
}

fn directory(scenes: &[Config], place: usize) -> String {
    let called = |config: &Config| [stem(&config.scene), stem(&config.recording)];
    let ([scene, recording], resolution) = (called(&scenes[place]), scenes[place].resolution);
    let others = scenes.iter().enumerate().filter(|(other, _)| *other != place).map(|(_, config)| config);
    let namesakes: Vec<&Config> = others.filter(|other| called(other)[0] == scene).collect();
    let mut name = scene;
    if namesakes.iter().any(|other| called(other)[1] != recording || other.resolution == resolution) {
        name += &format!("-{recording}");
    }
    if namesakes.iter().any(|other| called(other)[1] == recording && other.resolution != resolution) {
        name += &format!("-{}", resolution_name(resolution));
    }
    name
}

fn stem(name: &str) -> String {
    Path::new(name).file_stem().map_or_else(|| name.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Where scenes render different frames, each gives the images of those it has; somebody must have each.
fn check_images(config: &Config, entries: &[SceneEntry]) -> Result<()> {
    let (ExrFrames::List(frames), true) = (&config.exr, entries.len() > 1) else { return Ok(()) };
    let rendered = |frame| entries.iter().any(|entry| entry.frames.unwrap_or(config.frames).contains(frame));
    match frames.iter().find(|frame| !rendered(**frame)) {
        Some(frame) => Err(Error::Input(format!(
            "exr: frame {frame} is among the frames of no scene: widen frames, or leave it out"
        ))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lights::Lighting;

    fn config(scenes: &[&str], exclude: &[&str]) -> Config {
        Config {
            scenes: scenes.iter().map(|text| text.parse().unwrap()).collect(),
            exclude: exclude.iter().map(|text| text.parse().unwrap()).collect(),
            methods: ["indi-ortho-4", "encl-ortho-4"].map(|name| name.parse().unwrap()).to_vec(),
            lights: vec![Lighting::with_count(10), Lighting::with_count(20)],
            ..Config::default()
        }
    }

    fn names(config: &Config) -> Vec<String> {
        let parts = parts(config).unwrap();
        parts.iter().flat_map(|part| part.runs.iter().map(|run| part.full_name(run))).collect()
    }

    #[test]
    fn runs_are_the_product_of_the_axes() {
        let flat = ["indi-ortho-4_10", "encl-ortho-4_10", "indi-ortho-4_20", "encl-ortho-4_20"];
        assert_eq!(names(&config(&[], &[])), flat);
        assert_eq!(names(&config(&["temple=suntem"], &[])), flat);
        let all = names(&config(&["street=bistro", "street=bistro-vive", "x/temple.gltf=suntem"], &[]));
        assert_eq!(all.len(), 12);
        assert_eq!(all[0], "street-bistro/indi-ortho-4_10");
        assert_eq!(all[7], "street-bistro-vive/encl-ortho-4_20");
        assert_eq!(all[8], "temple/indi-ortho-4_10");
    }

    #[test]
    fn rules_leave_runs_out_and_keep_the_names_of_others() {
        let left =
            names(&config(&["street=bistro", "temple=suntem"], &["scene=street", "lights=10,method=encl-*"]));
        assert_eq!(left, ["temple/indi-ortho-4_10", "temple/indi-ortho-4_20", "temple/encl-ortho-4_20"]);
        assert!(parts(&config(&[], &["method=*"])).unwrap_err().to_string().contains("no run is left"));
    }

    #[test]
    fn scenes_have_their_own_resolution_frames_and_images() {
        let mut config = config(&["street=bistro,8x4", "temple=suntem,5..9/2"], &[]);
        config.exr = "40,7".parse().unwrap();
        let parts = parts(&config).unwrap();
        assert_eq!((parts[0].config.resolution, parts[1].config.resolution), ([8, 4], [320, 180]));
        assert_eq!(parts[0].config.exr, "40".parse().unwrap());
        assert_eq!(parts[1].config.exr, "7".parse().unwrap());
        assert_eq!(parts[1].config.out, Path::new("out/temple"));
        config.exr = "3".parse().unwrap();
        assert!(super::parts(&config).unwrap_err().to_string().contains("frame 3"));
    }

    #[test]
    fn every_scene_is_replayed_in_every_resolution_in_a_directory_of_its_own() {
        let directories = |scenes: &[&str], resolutions: &[[u32; 2]]| {
            let config = Config { resolutions: resolutions.to_vec(), ..config(scenes, &[]) };
            let parts = parts(&config).unwrap();
            let told = |part: &Part| (part.directory.clone(), part.config.resolution);
            assert!(parts.iter().all(|part| part.runs.iter().all(|run| run.config.resolutions.is_empty())));
            parts.iter().map(told).collect::<Vec<_>>()
        };
        let named = |all: &[(&str, [u32; 2])]| {
            all.iter().map(|(name, size)| ((*name).to_owned(), *size)).collect::<Vec<_>>()
        };
        let two = [[8, 8], [16, 8]];
        assert_eq!(directories(&["street=bistro"], &two[..1]), named(&[("", [8, 8])]));
        assert_eq!(
            directories(&["street=bistro"], &two),
            named(&[("street-8x8", [8, 8]), ("street-16x8", [16, 8])])
        );
        // A scene that has a resolution keeps it.
        assert_eq!(
            directories(&["street=bistro", "street=street", "temple=suntem,4x4"], &two),
            named(&[
                ("street-bistro-8x8", [8, 8]),
                ("street-bistro-16x8", [16, 8]),
                ("street-street-8x8", [8, 8]),
                ("street-street-16x8", [16, 8]),
                ("temple", [4, 4]),
            ])
        );
        let narrowed = Config { resolutions: two.to_vec(), ..config(&[], &["resolution=8x*"]) };
        assert_eq!(parts(&narrowed).unwrap().len(), 1);
    }

    #[test]
    fn scenes_that_share_a_directory_are_refused() {
        let error = parts(&config(&["a/x.gltf=bistro", "b/x.gltf=bistro"], &[])).unwrap_err().to_string();
        assert!(error.contains("x-bistro"), "{error}");
    }

    #[test]
    fn the_configuration_of_a_run_asks_for_it_alone() {
        let parts = parts(&config(&["street=bistro", "temple=suntem"], &[])).unwrap();
        let alone = super::parts(&parts[1].runs[3].config).unwrap();
        assert_eq!(alone.len(), 1);
        assert_eq!(alone[0].runs.len(), 1);
        assert_eq!(alone[0].runs[0].method, parts[1].runs[3].method);
        assert_eq!(alone[0].runs[0].lights, parts[1].runs[3].lights);
    }
}
