//! A device with one scene on it, on which runs are played one after the other.

use super::{RunSink, Watch, replay_run};
use crate::Result;
use crate::assign::Assigner;
use crate::config::Config;
use crate::engine::{Engine, LargestGrid, Mode, Session, plan_frames};
use crate::inputs::Inputs;
use crate::output::PlannedRun;
use crate::vk::{Context, DeviceInfo, DeviceOptions};

/// The device that `config` chooses.
///
/// # Errors
/// There is none, or it lacks something.
pub fn device_info(config: &Config) -> Result<DeviceInfo> {
    let options = DeviceOptions { device: config.device.clone(), validate: config.validate };
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
    /// The device is missing, lacks something, or cannot hold the scene.
    pub fn new(config: &'a Config, inputs: &'a Inputs) -> Result<Self> {
        let session = Session::new(config, &inputs.scene, inputs.recording.view_set())?;
        Ok(Self { inputs, session })
    }

    /// Whether the device can play a run: its shaders compile, its buffers fit.
    ///
    /// # Errors
    /// They do not.
    pub fn check(&mut self, run: &PlannedRun) -> Result<()> {
        let plans = plan_frames(&run.config, &self.inputs.recording)?;
        let lights = self.inputs.light_count(&run.lights)?;
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
        sink.begin(run)?;
        let result = replay_run(self.inputs, &mut self.session, run, (watch, sink))?;
        self.session.context.check_validation()?;
        sink.finish(run, result)
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
