//! Looks that a replay takes at the frames it has pictures of, beside what their views show.

use super::onlooker::Onlooker;
use super::{Base, Camera, Show, drawn_plainly, paint};
use crate::Result;
use crate::config::Config;
use crate::engine::{FramePlan, Session};
use crate::inputs::Inputs;
use crate::lights::{Generator, LightsFrom};
use crate::methods::Method;
use crate::output::PlannedRun;
use crate::shading::ShadingPipeline;
use image::RgbImage;

/// A look at a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// From above at clusters and frusta (Gelderen figure 4.8).
    Birdseye,
    /// From above at the volumes of lights (Tegelaers figures 3.2 to 3.4).
    Plan,
    /// From the first view at what its G-buffer holds (Tegelaers figure 4.3).
    Gbuffer,
}

impl Look {
    const ALL: [Self; 3] = [Self::Birdseye, Self::Plan, Self::Gbuffer];

    /// As files are named by it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Birdseye => "birdseye",
            Self::Plan => "plan",
            Self::Gbuffer => "gbuffer",
        }
    }

    /// The looks at frames of a run. Lights and G-buffer are the same by every method: runs of brute force show them.
    pub(crate) fn of(run: &PlannedRun) -> impl Iterator<Item = Self> + use<> {
        let naive = run.method == Method::AllLights;
        let in_volumes = matches!(run.lights, LightsFrom::Generated(Generator::Volume(..), ..));
        let deferred = run.config.pipeline[0] == ShadingPipeline::Deferred;
        let assigns = run.method.assigns();
        Self::ALL.into_iter().filter(move |look| match look {
            Self::Birdseye => assigns,
            Self::Plan => naive && in_volumes,
            Self::Gbuffer => naive && deferred,
        })
    }

    fn camera(self) -> Camera {
        match self {
            Self::Birdseye | Self::Plan => Camera::BirdsEye,
            Self::Gbuffer => Camera::View(0),
        }
    }

    fn show(self) -> Show {
        let nothing = Show::default();
        match self {
            Self::Birdseye => Show { base: Base::Clusters, frusta: true, ..nothing },
            Self::Plan => Show { frusta: true, lights: true, ..nothing },
            Self::Gbuffer => Show { base: Base::Gbuffer, ..nothing },
        }
    }
}

/// Renders the frame of `plan` once more, apart from its run, and looks at it.
///
/// # Errors
/// Whatever fails on the device.
pub(crate) fn look(
    inputs: &Inputs,
    session: &mut Session,
    (run, plan): (&PlannedRun, &FramePlan),
    look: Look,
) -> Result<RgbImage> {
    let config: &Config = &drawn_plainly(&run.config);
    let names: Vec<String> = inputs.recording.view_names().into_iter().map(str::to_owned).collect();
    let onlooker = Onlooker { run: config, names: &names, plan, camera: look.camera(), show: look.show() };
    Ok(paint(&onlooker, inputs, session, run)?.image)
}
