//! Goes through the chosen runs: skips what is done, records what fails, keeps what is complete.

use super::writer::{Files, device};
use super::{Failure, Fingerprint, Part, failure};
use crate::config::Config;
use crate::engine::{plan_frames, shader_library};
use crate::inputs::Inputs;
use crate::output::{
    DeviceInfo, PlannedRun, check_run, is_complete, prepare_output, remove_abandoned, saved_fingerprint,
};
use crate::recording::{self, Recording};
use crate::replay::{Player, Watch, device_info, frame_total, shape_note};
use crate::scene::{Scene, procedural};
use crate::{Error, Result};
use std::cell::Cell;
use std::path::Path;
use std::sync::atomic::AtomicBool;

/// The user's side of a sweep.
pub trait Reporter {
    /// This is under way.
    fn say(&self, what: &str);
    /// A frame was submitted.
    fn advance(&self);
    /// So many frames need not be rendered.
    fn skip(&self, frames: u64);
    /// Good to know.
    fn note(&self, text: &str);
    /// A run failed, and the sweep goes on.
    fn failed(&self, failure: &Failure);
}

/// What has become of the runs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outcome {
    /// How many were made.
    pub made: usize,
    /// How many were there already.
    pub skipped: usize,
    /// Those that failed, in order.
    pub failed: Vec<Failure>,
}

/// A sweep under way.
pub struct Sweep<'a> {
    parts: &'a [Part],
    recordings: Vec<Recording>,
    force: bool,
    interrupt: &'a AtomicBool,
    reporter: &'a dyn Reporter,
    /// So far.
    pub outcome: Outcome,
    /// Whether a part was opened: before that, bad input ends the sweep.
    under_way: bool,
}

/// A part whose inputs are loaded.
struct Open<'a> {
    part: &'a Part,
    inputs: &'a Inputs,
    /// Frames that one run submits.
    frames: u64,
}

impl Open<'_> {
    /// What is good to know before its runs are made.
    fn notes(&self) -> Result<impl Iterator<Item = String>> {
        let Config { exr, resolution, frames, .. } = &self.part.config;
        let shape = match exr.is_empty() {
            true => None,
            false => shape_note(&self.inputs.recording, frames.first, *resolution)?,
        };
        Ok(self.inputs.rain_note().into_iter().chain(shape))
    }
}

/// Runs to make, each with its fingerprint.
type Pending<'r> = Vec<(&'r PlannedRun, String)>;

impl<'a> Sweep<'a> {
    /// Checks all that can be checked without a device or a scene in memory. With `force`, complete runs are made again.
    ///
    /// # Errors
    /// A recording or a scene is missing, a frame is outside its recording, a method cannot serve the views.
    pub fn new(
        parts: &'a [Part],
        force: bool,
        interrupt: &'a AtomicBool,
        reporter: &'a dyn Reporter,
    ) -> Result<Self> {
        let recordings = parts.iter().map(check_part).collect::<Result<_>>()?;
        Ok(Self {
            parts,
            recordings,
            force,
            interrupt,
            reporter,
            outcome: Outcome::default(),
            under_way: false,
        })
    }

    /// How many frames are submitted if nothing is skipped.
    ///
    /// # Errors
    /// A frame outside its recording.
    pub fn frames(&self) -> Result<u64> {
        let parts = self.parts.iter().zip(&self.recordings);
        parts.map(|(part, recording)| frame_total(&part.config, recording, part.runs.len())).sum()
    }

    /// Makes the runs.
    ///
    /// # Errors
    /// Bad input before the first run, output that cannot be written, an interruption, a validation message at the
    /// device's end; a run's own failure is in the outcome.
    pub fn run(&mut self) -> Result<()> {
        let Some(first) = self.parts.first() else { return Ok(()) };
        let device = device(&device_info(&first.config)?);
        let shaders = shader_library(&first.config)?.sources_sha256()?;
        for part in self.parts {
            prepare_output(&part.config.out)?;
            remove_abandoned(&part.config.out);
        }
        let mut scene: Option<(&str, Scene)> = None;
        let recordings = std::mem::take(&mut self.recordings);
        for (part, recording) in self.parts.iter().zip(recordings) {
            let frames = frame_total(&part.config, &recording, 1)?;
            let loaded = scene.take().filter(|(name, _)| *name == part.config.scene).map(|(_, scene)| scene);
            match Inputs::load_with(&part.config, recording, loaded) {
                Ok(inputs) => {
                    self.run_part(&Open { part, inputs: &inputs, frames }, &device, &shaders)?;
                    scene = Some((&part.config.scene, inputs.scene));
                }
                Err(error) if !self.under_way => return Err(error),
                Err(error) => {
                    for run in &part.runs {
                        self.fail(part, run, frames, &error)?;
                    }
                }
            }
            self.under_way = true;
        }
        Ok(())
    }

    fn run_part(&mut self, open: &Open, device: &DeviceInfo, shaders: &str) -> Result<()> {
        let fingerprint = Fingerprint::new(open.inputs, device, shaders);
        let mut pending: Pending = Vec::new();
        for run in &open.part.runs {
            let wanted = fingerprint.of(&run.config)?;
            if !self.force && self.is_there(&open.part.path(run), &wanted) {
                failure::forget(open.part, run)?;
                self.outcome.skipped += 1;
                self.reporter.skip(open.frames);
            } else {
                pending.push((run, wanted));
            }
        }
        if pending.is_empty() {
            return Ok(());
        }
        for note in open.notes()? {
            self.reporter.note(&note);
        }
        let (mut player, pending) = self.checked(open, pending)?;
        for (run, fingerprint) in pending {
            let mut current =
                match player.take().map_or_else(|| Player::new(&open.part.config, open.inputs), Ok) {
                    Ok(player) => player,
                    Err(error) => {
                        self.fail(open.part, run, open.frames, &error)?;
                        continue;
                    }
                };
            if self.play(open, &mut current, run, fingerprint)? {
                player = Some(current);
            }
        }
        player.map_or(Ok(()), Player::finish)
    }

    /// Whether the run in `directory` is the one that is wanted, and whole; says why it is made again where not.
    fn is_there(&self, directory: &Path, fingerprint: &str) -> bool {
        if !is_complete(directory) {
            return false;
        }
        match check_run(directory) {
            Ok(()) => saved_fingerprint(directory).is_some_and(|saved| saved == fingerprint),
            Err(error) => {
                self.reporter.note(&format!("{error}; the run is made again"));
                false
            }
        }
    }

    /// Opens the device, and sorts out what it cannot play before anything is played.
    fn checked<'o, 'r>(
        &mut self,
        open: &Open<'o>,
        pending: Pending<'r>,
    ) -> Result<(Option<Player<'o>>, Pending<'r>)> {
        let mut player = match Player::new(&open.part.config, open.inputs) {
            Ok(player) => player,
            Err(error) if !self.under_way => return Err(error),
            // Tried again, and recorded, run by run.
            Err(_) => return Ok((None, pending)),
        };
        let mut playable: Pending = Vec::new();
        for (run, fingerprint) in pending {
            match player.check(run) {
                Ok(()) => playable.push((run, fingerprint)),
                Err(error) if !self.under_way => return Err(error),
                Err(error) => self.fail(open.part, run, open.frames, &error)?,
            }
        }
        Ok((Some(player), playable))
    }

    /// Makes one run; says whether the player is still good.
    fn play(
        &mut self,
        open: &Open,
        player: &mut Player,
        run: &PlannedRun,
        fingerprint: String,
    ) -> Result<bool> {
        let (part, inputs, reporter) = (open.part, open.inputs, self.reporter);
        let submitted = Cell::new(0);
        let progress = || {
            submitted.set(submitted.get() + 1);
            reporter.advance();
        };
        let watch = Watch { interrupt: self.interrupt, progress: &progress };
        let mut files = Files { part, inputs, reporter, fingerprint, writer: None, broken: false };
        let played = player.play(run, &watch, &mut files);
        let broken = files.broken;
        drop(files);
        match played {
            Ok(()) => {
                failure::forget(part, run)?;
                self.outcome.made += 1;
                Ok(true)
            }
            // What cannot be written fails for every run: nothing is gained by rendering on.
            Err(error) if broken || matches!(error, Error::Interrupted(_)) => Err(error),
            Err(error) => {
                self.fail(part, run, open.frames.saturating_sub(submitted.get()), &error)?;
                Ok(false)
            }
        }
    }

    /// Records a failure; `frames` will not be rendered.
    fn fail(&mut self, part: &Part, run: &PlannedRun, frames: u64, error: &Error) -> Result<()> {
        let failure = Failure::new(part, run, error);
        failure.write(part, run)?;
        self.reporter.skip(frames);
        self.reporter.failed(&failure);
        self.outcome.failed.push(failure);
        Ok(())
    }
}

/// Loads a part's recording and plans all its runs; looks for its scene.
fn check_part(part: &Part) -> Result<Recording> {
    let config = &part.config;
    let recording = recording::load(&config.recording)?;
    for run in &part.runs {
        plan_frames(&run.config, &recording)?;
    }
    let path = Path::new(&config.scene);
    if !procedural::NAMES.contains(&config.scene.as_str()) && !path.is_file() {
        // The loader knows best what to say.
        crate::scene::load(path)?;
    }
    Ok(recording)
}
