//! A device with one scene on it, on which runs are played.

use super::count::{self, Counted};
use super::turns::{self, Failed, Seat};
use super::{RunSink, Watch};
use crate::Result;
use crate::assign::Assigner;
use crate::config::{Config, Runs};
use crate::engine::{Engine, LargestGrid, Mode, Session, plan_frames};
use crate::inputs::Inputs;
use crate::output::PlannedRun;
use crate::vk::{Context, DeviceInfo, DeviceOptions};

/// The device that `config` chooses.
///
/// # Errors
/// There is none, or it lacks something.
pub fn device_info(config: &Config) -> Result<DeviceInfo> {
    let options = DeviceOptions {
        device: config.device.clone(),
        validate: config.validate,
        ..DeviceOptions::default()
    };
    Ok(Context::new(&options)?.info.clone())
}

/// Plays runs of one scene at one resolution.
pub struct Player<'a> {
    inputs: &'a Inputs,
    session: Session,
}

impl<'a> Player<'a> {
    /// Opens the device and brings the scene there.
    ///
    /// # Errors
    /// The device is missing, lacks something (timestamps, where times decide how many runs are made), or cannot hold the scene.
    pub fn new(config: &'a Config, inputs: &'a Inputs) -> Result<Self> {
        let session = Session::new(config, &inputs.scene, inputs.recording.view_set())?;
        if config.runs == Runs::Auto {
            session.context.require_timestamps()?;
        }
        Ok(Self { inputs, session })
    }

    /// Whether the device can play a run: its shaders compile, its buffers fit.
    ///
    /// # Errors
    /// They do not.
    pub fn check(&mut self, run: &PlannedRun) -> Result<()> {
        let plans = plan_frames(&run.config, &self.inputs.recording)?;
        let lights = self.inputs.light_tally(&run.lights)?;
        for counting in [true, false] {
            // Where counts decide, brute force stands for all: which way it will be is not known yet.
            let assigner = run.assign.fixed().unwrap_or(Assigner::Brute);
            let mode = Mode { assigner, counting, ..Mode::counting(&run.config, lights) };
            Engine::check(&mut self.session, &run.config, LargestGrid::of(&plans), &mode)?;
        }
        Ok(())
    }

    /// Plays one run into the sink. After an error the device may be lost: go on with another player.
    ///
    /// # Errors
    /// As [`super::replay`].
    pub fn play(&mut self, run: &PlannedRun, watch: &Watch, sink: &mut dyn RunSink) -> Result<()> {
        let counted = &mut Some(self.count(run, watch, sink)?);
        self.time(vec![Seat { run, counted, watch, sink }]).map_err(|failed| failed.error)
    }

    /// Begins a run in the sink and counts it; it is to be timed then. After an error the device may be lost.
    ///
    /// # Errors
    /// As [`super::replay`].
    pub fn count(&mut self, run: &PlannedRun, watch: &Watch, sink: &mut dyn RunSink) -> Result<Counted> {
        sink.begin(run)?;
        let counted = count::count(self.inputs, &mut self.session, run, (watch, sink))?;
        self.session.context.check_validation()?;
        Ok(counted)
    }

    /// Makes a run ready to be timed without counting it: buffers grow where a timed frame needs more.
    ///
    /// # Errors
    /// The device cannot play the run, or views cannot be served.
    pub fn prepare(&mut self, run: &PlannedRun) -> Result<Counted> {
        let counted = count::prepare(self.inputs, &mut self.session, run)?;
        Engine::check(&mut self.session, &run.config, counted.largest(), &counted.mode(false))?;
        Ok(counted)
    }

    /// Times runs that are counted, or prepared, in turn, each into its sink. After an error the device may be lost.
    ///
    /// # Errors
    /// As [`super::replay`], with the run it happened to. Of the others those that were not finished in their sinks are not
    /// timed, and can be.
    pub fn time(&mut self, group: Vec<Seat>) -> Result<(), Failed> {
        turns::time(self.inputs, &mut self.session, group)
    }

    /// What timing a counted run takes of the device's memory, bytes.
    pub fn bytes(&self, run: &PlannedRun, counted: &Counted) -> u64 {
        Engine::bytes(&self.session, &run.config, counted.largest(), &counted.mode(false))
    }

    /// The device's own memory, bytes.
    pub fn device_bytes(&self) -> u64 {
        self.session.context.limits.device_local_bytes
    }

    /// Lets the device go; what it says at its end counts too.
    ///
    /// # Errors
    /// A validation message.
    pub fn finish(self) -> Result<()> {
        let log = self.session.context.validation_log();
        drop(self.session);
        log.check()
    }
}
