//! What checks run on: a device with single passes on it, and whole frames, each made when it is first asked for.

use super::frames::Frames;
use crate::Result;
use crate::assign::Conservative;
use crate::config::{Assign, Config, Test};
use crate::engine::workbench::{Case, Workbench};
use crate::inputs::Inputs;
use crate::pass::Faults;
use crate::replay::device_info;
use crate::vk::DeviceInfo;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// What is tested.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// As in the configuration of a replay.
    pub device: Option<String>,
    /// As in the configuration of a replay.
    pub shaders: Option<PathBuf>,
    /// Whether the validation layers are on.
    pub validate: bool,
    /// Names of the checks that run; all where there are none.
    pub checks: Vec<String>,
}

/// Views of the workbench, pixels.
const RESOLUTION: [u32; 2] = [64, 32];

/// What checks run on.
pub struct Context {
    options: Options,
    config: Config,
    inputs: Inputs,
    faults: Faults,
    bench: Option<Workbench>,
    /// By samples a pixel.
    frames: BTreeMap<u32, Result<Frames>>,
}

impl Context {
    /// The built-in scene and recording, for the device that `options` choose.
    ///
    /// # Errors
    /// None but faults of the program: nothing is read from files.
    pub fn new(options: Options) -> Result<Self> {
        Self::with_faults(options, Faults::default())
    }

    /// The same with synchronisation left out, for tests.
    pub(super) fn with_faults(options: Options, faults: Faults) -> Result<Self> {
        let Options { device, shaders, validate, .. } = options.clone();
        let config = Config { device, shaders, validate, ..Config::default() };
        let inputs = Inputs::load(&config)?;
        Ok(Self { options, config, inputs, faults, bench: None, frames: BTreeMap::new() })
    }

    pub(super) fn options(&self) -> &Options {
        &self.options
    }

    /// The device.
    ///
    /// # Errors
    /// There is none, or it cannot be used.
    pub fn device(&self) -> Result<DeviceInfo> {
        device_info(&self.config)
    }

    /// A case on the device, whose lists are built and tested so.
    pub(super) fn bench(&mut self, (assign, test): (Assign, Test), case: Case) -> Result<&mut Workbench> {
        self.bench_with(Config { assign: vec![assign], test: vec![test], ..self.config.clone() }, case)
    }

    /// A case on the device, whose meshes are rasterised so.
    pub(super) fn rasterising(&mut self, way: Conservative, case: Case) -> Result<&mut Workbench> {
        self.bench_with(Config { conservative: vec![way], ..self.config.clone() }, case)
    }

    fn bench_with(&mut self, config: Config, case: Case) -> Result<&mut Workbench> {
        let config = Config { resolution: RESOLUTION, ..config };
        let made = match self.bench.take() {
            Some(bench) => bench.replace(&config, case)?,
            None => Workbench::new(&config, &self.inputs.scene, case, self.faults)?,
        };
        Ok(self.bench.insert(made))
    }

    /// The frames of all methods with so many samples a pixel.
    pub(super) fn frames(&mut self, samples: u32) -> Result<&mut Frames> {
        Ok(self.frames_and_inputs(samples)?.0)
    }

    /// The same, with what they are made from.
    pub(super) fn frames_and_inputs(&mut self, samples: u32) -> Result<(&mut Frames, &Inputs)> {
        let Self { inputs, config, faults, frames, .. } = self;
        let made = frames.entry(samples);
        let made = made.or_insert_with(|| Frames::new(config, inputs, samples, *faults));
        made.as_mut().map(|frames| (frames, &*inputs)).map_err(|error| error.clone())
    }
}
