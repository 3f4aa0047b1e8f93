//! Goes through the chosen runs: skips what is done, records what fails, keeps what is complete.

use super::group::{self, Member, Tally};
use super::writer::{Files, device};
use super::{Failure, Fingerprint, Part, failure};
use crate::audience::Audience;
use crate::config::Config;
use crate::engine::{plan_frames, shader_library};
use crate::inputs::Inputs;
use crate::measure::Extremes;
use crate::output::{
    DeviceInfo, PlannedRun, check_run, is_complete, prepare_output, remove_abandoned, saved_fingerprint,
};
use crate::recording::{self, Recording};
use crate::replay::{Failed, Player, Watch, device_info, frame_total, shape_note};
use crate::scene::{Scene, procedural};
use crate::{Error, Result};
use std::path::Path;
use std::sync::atomic::AtomicBool;

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
    audience: &'a dyn Audience,
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
        let Config { exr, resolution, frames, methods, .. } = &self.part.config;
        let shape = match exr.is_empty() {
            true => None,
            false => shape_note(&self.inputs.recording, frames.first, *resolution)?,
        };
        Ok(self.inputs.notes(methods).chain(shape))
    }
}

/// A part under way.
struct Stage<'o> {
    open: &'o Open<'o>,
    /// `None` after a failure, which may have lost the device.
    player: Option<Player<'o>>,
    /// Runs that are counted, to be timed in turn.
    group: Vec<Member<'o>>,
    /// The frames that were found for pictures, as they were told last: runs of a scene have the same.
    told: Option<Extremes>,
}

impl<'o> Stage<'o> {
    /// The player at hand, or a new one.
    fn player(&mut self) -> Result<&mut Player<'o>> {
        let player = match self.player.take() {
            Some(player) => player,
            None => Player::new(&self.open.part.config, self.open.inputs)?,
        };
        Ok(self.player.insert(player))
    }

    /// Whether the engines of the group and that of one more run are more than the device should hold.
    fn is_overfilled_by(&self, more: &Member) -> bool {
        self.player.as_ref().is_some_and(|player| group::overfills(player, &self.group, more))
    }

    /// What is new about the frames that a run found for its pictures.
    fn news(&mut self, extremes: Option<Extremes>) -> Option<String> {
        let found = extremes.filter(|_| self.told != extremes)?;
        self.told = extremes;
        Some(format!("images of depth discontinuity: {found}"))
    }

    fn time(&mut self, interrupt: &AtomicBool) -> Result<(), Failed> {
        match &mut self.player {
            Some(player) => group::time(player, &mut self.group, interrupt),
            None => Ok(()),
        }
    }
}

/// Whether an error that met a run ends the sweep: what cannot be written fails for every run, and nothing is gained by
/// rendering on.
fn ends_all(error: &Error, files: &Files) -> bool {
    files.broken || matches!(error, Error::Interrupted(_))
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
        audience: &'a dyn Audience,
    ) -> Result<Self> {
        let recordings = parts.iter().map(check_part).collect::<Result<_>>()?;
        Ok(Self {
            parts,
            recordings,
            force,
            interrupt,
            audience,
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
                self.audience.skip(open.frames);
            } else {
                pending.push((run, wanted));
            }
        }
        if pending.is_empty() {
            return Ok(());
        }
        for note in open.notes()? {
            self.audience.note(&note);
        }
        let (player, pending) = self.checked(open, pending)?;
        self.make(Stage { open, player, group: vec![], told: None }, pending)
    }

    /// Counts the runs one by one, and times them in groups.
    fn make<'o>(&mut self, mut stage: Stage<'o>, pending: Pending<'o>) -> Result<()>
    where
        'a: 'o,
    {
        let runs: Vec<&PlannedRun> = pending.iter().map(|(run, _)| *run).collect();
        let most = group::most(&stage.open.part.config);
        for (place, (run, fingerprint)) in pending.into_iter().enumerate() {
            let size = stage.group.len();
            if stage.group.last().is_some_and(|last| group::ends_with(last.run, size, &runs[place..])) {
                self.time(&mut stage)?;
            }
            self.count(&mut stage, run, fingerprint)?;
            if stage.group.len() >= most {
                self.time(&mut stage)?;
            }
        }
        self.time(&mut stage)?;
        stage.player.map_or(Ok(()), Player::finish)
    }

    /// Whether the run in `directory` is the one that is wanted, and whole; says why it is made again where not.
    fn is_there(&self, directory: &Path, fingerprint: &str) -> bool {
        if !is_complete(directory) {
            return false;
        }
        match check_run(directory) {
            Ok(()) => saved_fingerprint(directory).is_some_and(|saved| saved == fingerprint),
            Err(error) => {
                self.audience.note(&format!("{error}; the run is made again"));
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

    /// Counts a run and puts it into the group, before which that is timed where the run does not fit in.
    fn count<'o>(&mut self, stage: &mut Stage<'o>, run: &'o PlannedRun, fingerprint: String) -> Result<()>
    where
        'a: 'o,
    {
        let Open { part, inputs, frames } = *stage.open;
        let (audience, tally) = (self.audience, Tally::new(frames));
        let watch = Watch { interrupt: self.interrupt, progress: &|| tally.step(|| audience.advance()) };
        let mut files = Files::new((part, inputs), fingerprint, audience);
        match stage.player().and_then(|player| player.count(run, &watch, &mut files)) {
            Ok(counted) => {
                tally.counted();
                stage.news(counted.extremes()).iter().for_each(|news| audience.note(news));
                let member = Member { run, files, tally, counted: Some(counted) };
                if stage.is_overfilled_by(&member) {
                    self.time(stage)?;
                }
                stage.group.push(member);
                Ok(())
            }
            Err(error) if ends_all(&error, &files) => Err(error),
            Err(error) => {
                stage.player = None;
                self.fail(part, run, tally.left(), &error)
            }
        }
    }

    /// Times the group. Where one of its runs fails, the others that are not complete are timed anew, without it.
    fn time(&mut self, stage: &mut Stage) -> Result<()> {
        let part = stage.open.part;
        while !stage.group.is_empty() {
            let timed = match stage.player() {
                Ok(_) => stage.time(self.interrupt),
                Err(error) => Err(Failed { seat: 0, error }),
            };
            let at_fault = timed.as_ref().err().map(|failed| stage.group.remove(failed.seat));
            self.keep_finished(stage)?;
            let (Err(Failed { error, .. }), Some(member)) = (timed, at_fault) else { continue };
            if ends_all(&error, &member.files) {
                return Err(error);
            }
            // The device may be lost.
            stage.player = None;
            self.fail(part, member.run, member.tally.left(), &error)?;
            stage.group.iter().for_each(|member| member.tally.again());
        }
        Ok(())
    }

    /// Lets go of the runs of the group that are written.
    fn keep_finished(&mut self, stage: &mut Stage) -> Result<()> {
        let part = stage.open.part;
        let (finished, left): (Vec<_>, Vec<_>) =
            std::mem::take(&mut stage.group).into_iter().partition(|member| member.files.finished);
        stage.group = left;
        for member in &finished {
            failure::forget(part, member.run)?;
            self.outcome.made += 1;
            self.audience.skip(member.tally.left());
        }
        let timed = finished.iter().filter_map(|member| Some((member.run, member.files.timing.as_ref()?)));
        for note in group::notes(part, &timed.collect::<Vec<_>>()) {
            self.audience.note(&note);
        }
        Ok(())
    }

    /// Records a failure; `frames` will not be rendered.
    fn fail(&mut self, part: &Part, run: &PlannedRun, frames: u64, error: &Error) -> Result<()> {
        let failure = Failure::new(part, run, error);
        failure.write(part, run)?;
        self.audience.skip(frames);
        self.audience.note(&format!("{} failed: {}", failure.run, failure.error));
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
