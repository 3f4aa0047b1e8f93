//! A frame of the street in stereo by every method, counted and pictured; with fewer pixels than anyone would measure.

use crate::Result;
use crate::config::{Config, Scopes};
use crate::engine::{Engine, FramePlan, LargestGrid, Mode, Session, look_at_frame, plan_frames};
use crate::inputs::Inputs;
use crate::lights::{FrameLights, LightTally};
use crate::measure::{FrameCounts, ViewPixels};
use crate::pass::Faults;
use crate::{config::FrameRange, methods::Method};

/// Brute force over all lights, the truth, the six methods of the default replay, tiles, and what else is done with clusters:
/// all of them or visible ones, by their samples, by rectangles on the screen; cells of the world, models, and leaves of an octree.
pub const METHODS: [&str; 14] = [
    "all-lights",
    "indi-persp-64",
    "encl-persp-64",
    "indi-ortho-4",
    "encl-ortho-4",
    "indi-displ-64-32",
    "encl-displ-64-32",
    "tiled-16",
    "t-e-28",
    "sc-e-48-40",
    "clustered-mm-32",
    "g-20",
    "m",
    "hashed-0.5-3",
];

/// The frame of the recording, and pixels of a view: those of the golden counts.
pub const FRAME: u32 = 300;
const RESOLUTION: [u32; 2] = [96, 64];

/// What one method made of the frame.
#[derive(Debug, PartialEq)]
pub struct Look {
    /// The method's name.
    pub method: &'static str,
    /// What it counted.
    pub counts: FrameCounts,
    /// A view each.
    pub pixels: Vec<ViewPixels>,
}

/// What all methods make of the frame.
pub struct Frames {
    /// One view an eye.
    pub session: Session,
    /// Of the frame, but for method and scopes.
    config: Config,
    /// In the order of [`METHODS`], the truth first.
    pub looks: Vec<Look>,
}

impl Frames {
    /// All methods, with every stage timed.
    pub fn new(config: &Config, inputs: &Inputs, msaa: u32, faults: Faults) -> Result<Self> {
        let frames = FrameRange { first: FRAME, end: Some(FRAME + 1), step: 1 };
        let config = Config { resolution: RESOLUTION, msaa, frames, ..config.clone() };
        let mut session = Session::new(&config, &inputs.scene, inputs.recording.view_set())?;
        session.tracker.faults = faults;
        let mut this = Self { session, config, looks: vec![] };
        for method in METHODS {
            let look = this.look(inputs, method, Scopes::All)?;
            this.looks.push(look);
        }
        Ok(this)
    }

    /// What a method makes of the frame with these scopes timed.
    pub fn look(&mut self, inputs: &Inputs, name: &'static str, scopes: Scopes) -> Result<Look> {
        let method: Method = name.parse()?;
        let names: Vec<String> = inputs.recording.view_names().into_iter().map(str::to_owned).collect();
        let frame = self.with_engine(inputs, (method, scopes), |engine, session, input| {
            look_at_frame(engine, session, input, (0.0, Some(&names)), &mut |_| Ok(()))
        })?;
        self.session.context.check_validation()?;
        Ok(Look { method: name, counts: frame.counts, pixels: frame.pixels })
    }

    /// What `body` makes of the frame with an engine for it.
    pub fn with_engine<R>(
        &mut self,
        inputs: &Inputs,
        (method, scopes): (Method, Scopes),
        body: impl FnOnce(&mut Engine, &mut Session, (&FramePlan, FrameLights)) -> Result<R>,
    ) -> Result<R> {
        let run = Config { methods: vec![method], scopes, ..self.config.clone() };
        let plans = plan_frames(&run, &inputs.recording)?;
        let mut source = inputs.light_source(&run.lights_from()[0])?;
        let lights = source.at_frame(FRAME);
        let mode = Mode::counting(&run, LightTally::of(lights.list));
        let mut engine = Engine::new(&mut self.session, &run, LargestGrid::of(&plans), mode)?;
        body(&mut engine, &mut self.session, (&plans[0], lights))
    }

    /// Its configuration by a method.
    pub fn run(&self, method: Method) -> Config {
        Config { methods: vec![method], ..self.config.clone() }
    }
}
