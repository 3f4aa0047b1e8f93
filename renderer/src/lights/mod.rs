//! Point and spot lights of one frame, wherever they come from: a generator (rain, gamma, volumes), a CSV file, the scene.

mod attenuation;
mod csv_file;
mod gamma;
mod generator;
mod lighting;
mod motion;
mod place;
pub mod rain;
mod random;
mod spelled;
mod spot;
mod spotted;
mod volume;

pub use attenuation::Attenuation;
pub use csv_file::{LightsFile, load_csv};
pub use gamma::{GammaLights, GammaRadii, GammaRecipe};
pub use generator::{Generated, GeneratedBox, Generator, GeneratorKind, Surroundings};
pub use lighting::{Lighting, LightsFrom};
pub use motion::LightMotion;
pub use place::{Corners, LightBox};
pub use spot::{ConeFalloff, Spot};
pub use spotted::SpotShare;
pub use volume::{LatticeBox, LightSet, VolumeRecipe};

use self::rain::Rain;
use self::spelled::spelled;
use crate::geometry::{LightVolume, SphericalSector};
use crate::scene::SceneLight;
use crate::{Error, Result};
use glam::DVec3;
use serde::Serialize;

/// A point light, or a spot light. Its influence ends at `r1` (Gelderen appendix A).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Light {
    /// Place of the light in the world, metres.
    pub position: [f32; 3],
    /// Linear colour, multiplies the attenuation.
    pub tint: [f32; 3],
    /// Intensity I of the light.
    pub intensity: f32,
    /// Cut-off I0 of the intensity.
    pub cutoff: f32,
    /// Near radius R0: the distance is clamped to at least this, metres.
    pub r0: f32,
    /// Influence radius R1 = sqrt(I/I0), metres.
    pub r1: f32,
    /// The cone that the light shines into; `None` where it shines all around.
    pub spot: Option<Spot>,
}

impl Light {
    /// A light whose influence ends at R1 = sqrt(I/I0), where I/d^2 falls to I0 (Gelderen appendix A).
    pub fn new(position: [f32; 3], tint: [f32; 3], intensity: f32, cutoff: f32, r0: f32) -> Self {
        Self { position, tint, intensity, cutoff, r0, r1: (intensity / cutoff).sqrt(), spot: None }
    }

    /// The light with its cone, where it has one.
    pub fn shining(self, spot: Option<Spot>) -> Self {
        Self { spot, ..self }
    }

    /// Place of the light in the world, metres.
    pub fn place(&self) -> DVec3 {
        DVec3::from_array(self.position.map(f64::from))
    }

    /// What a spot light reaches, world space; `None` of a light that shines all around.
    pub fn sector(&self) -> Option<SphericalSector> {
        self.spot.map(|spot| spot.sector(self.place(), self.r1.into()))
    }

    /// What the light reaches, in a world whose origin lies at `origin` (world space, metres).
    pub fn volume(&self, origin: DVec3) -> LightVolume {
        match self.sector() {
            None => LightVolume::sphere(self.place() - origin, self.r1.into()),
            Some(sector) => LightVolume::sector(SphericalSector { apex: sector.apex - origin, ..sector }),
        }
    }

    /// The part of the light that goes through its cone towards a point (world space), 0 to 1 (KHR_lights_punctual).
    pub fn cone_part(&self, point: DVec3) -> f64 {
        let towards = (point - self.place()).normalize_or_zero();
        self.spot.map_or(1.0, |spot| spot.falloff().at(spot.axis().dot(towards)))
    }

    /// The smallest sphere around all that the light reaches: middle (world space) and radius, metres.
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        match self.sector() {
            None => (self.place(), self.r1.into()),
            Some(sector) => sector.bounding_sphere(),
        }
    }

    /// This light where its influence ends at `r1` metres: nearer than sqrt(I/I0), the cut-off is raised to I/R1^2, so
    /// that the light still fades to nothing there.
    pub fn ending_at(self, r1: f32) -> Self {
        if !(r1 > 0.0 && r1 < self.r1) {
            return Self { r1, ..self };
        }
        let cutoff = f64::from(self.intensity) / f64::from(r1).powi(2);
        Self { cutoff: cutoff.min(f64::from(f32::MAX)) as f32, r1, ..self }
    }

    /// Finds the first value that no light can have: its column in a lights file, and what it must be.
    pub(crate) fn check(&self) -> Result<(), (&'static str, String)> {
        for (column, value) in ["x", "y", "z"].into_iter().zip(self.position) {
            require(value.is_finite(), column, value, "a coordinate in metres")?;
        }
        for (column, value) in ["r", "g", "b"].into_iter().zip(self.tint) {
            require(value.is_finite() && value >= 0.0, column, value, "a tint, 0 or above")?;
        }
        let positive = |value: f32| value.is_finite() && value > 0.0;
        require(positive(self.intensity), "i", self.intensity, "an intensity above 0")?;
        require(positive(self.cutoff), "i0", self.cutoff, "a cut-off above 0")?;
        require(positive(self.r1), "r1", self.r1, "a radius above 0, in metres")?;
        let below = format!("a near radius above 0 and below the influence radius {}", self.r1);
        require(self.r0 > 0.0 && self.r0 < self.r1, "r0", self.r0, &below)?;
        self.spot.map_or(Ok(()), |spot| spot.check())
    }
}

fn require(
    holds: bool,
    column: &'static str,
    value: f32,
    wanted: &str,
) -> Result<(), (&'static str, String)> {
    if holds { Ok(()) } else { Err((column, format!("{value} is not {wanted}"))) }
}

/// The lights of one frame.
#[derive(Debug, Clone, Copy)]
pub struct FrameLights<'a> {
    /// Light k keeps its place from frame to frame.
    pub list: &'a [Light],
    /// Two lists of one source with the same revision are the same.
    pub revision: u64,
}

/// How many lights frames have at most, and whether any of them shines into a cone alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LightTally {
    /// Most lights of all frames.
    pub count: u32,
    /// Whether some are spots: shaders then ask every light for its cone.
    pub spots: bool,
}

impl LightTally {
    /// That of these lights.
    pub fn of(lights: &[Light]) -> Self {
        Self { count: lights.len() as u32, spots: lights.iter().any(|light| light.spot.is_some()) }
    }
}

/// What gives every frame its lights: those that move, such as rain, or those that stay.
pub trait LightSource {
    /// The lights of `frame`.
    fn at_frame(&mut self, frame: u32) -> FrameLights<'_>;
}

/// Lights that do not change.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticLights(pub Vec<Light>);

impl LightSource for StaticLights {
    fn at_frame(&mut self, _: u32) -> FrameLights<'_> {
        FrameLights { list: &self.0, revision: 0 }
    }
}

impl LightSource for Rain {
    fn at_frame(&mut self, frame: u32) -> FrameLights<'_> {
        self.advance_to(frame);
        FrameLights { list: self.lights(), revision: frame.into() }
    }
}

/// An empty list with room for `count` elements, or an error instead of an abort.
fn reserve<T>(count: u32) -> Result<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(count as usize)
        .map_err(|_| Error::input(format!("{count} lights do not fit into memory; ask for fewer")))?;
    Ok(list)
}

/// The point and spot lights that a scene brings along (KHR_lights_punctual), with cut-off I0 and near radius R0 (metres).
///
/// The file's luminous intensity is taken as I as it stands, for both mean E = I/d^2 at distance d; its colour is
/// the tint. R1 = min(sqrt(I/I0), range): where the range is the shorter one, the light's cut-off is raised to
/// I/range^2, so that the light still fades to nothing at R1. R0 is at most R1/2. Lights of no intensity or range
/// light nothing and are left out.
///
/// # Errors
/// [`Error::Input`] where the cut-off or R0 is no number above 0, a light has a value that is no light's, or
/// no light is left; lights are numbered as the scene has them.
pub fn from_scene(lights: &[SceneLight], cutoff: f32, r0: f32) -> Result<Vec<Light>> {
    for (name, value) in [("cut-off I0", cutoff), ("near radius R0", r0)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(Error::input(format!("scene lights: a {name} of {value} is not above 0")));
        }
    }
    let lit = lights.iter().enumerate().filter(|(_, light)| reaches_something(light));
    let found = lit
        .map(|(index, light)| {
            let light = from_scene_light(light, cutoff, r0);
            light.check().map_err(|(field, message)| {
                Error::input(format!("scene light {index}: {field}: {message}"))
            })?;
            Ok(light)
        })
        .collect::<Result<Vec<_>>>()?;
    if found.is_empty() {
        return Err(Error::input(
            "the scene has no point or spot lights that reach anything (KHR_lights_punctual); use rain or a lights file",
        ));
    }
    Ok(found)
}

/// False where intensity or range is 0, or the range so short that I/range^2 is no number any more.
fn reaches_something(light: &SceneLight) -> bool {
    let bounded = |range: f32| light.intensity / (range * range) < f32::INFINITY;
    light.intensity != 0.0 && light.range.is_none_or(bounded)
}

fn from_scene_light(light: &SceneLight, cutoff: f32, r0: f32) -> Light {
    let unbounded = Light::new(light.position.to_array(), light.color, light.intensity, cutoff, r0);
    let bounded = match light.range {
        Some(range) if range < unbounded.r1 => unbounded.ending_at(range),
        _ => unbounded,
    };
    Light { r0: r0.min(0.5 * bounded.r1), spot: light.spot, ..bounded }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lights::Lighting;
    use crate::lights::rain::RainParameters;
    use glam::Vec3;

    fn scene_light(intensity: f32, range: Option<f32>) -> SceneLight {
        SceneLight {
            position: Vec3::new(1.0, 2.0, 3.0),
            color: [1.0, 0.5, 0.25],
            intensity,
            range,
            spot: None,
        }
    }

    #[test]
    fn scene_lights_end_at_the_cutoff_or_at_their_range() {
        let lights = [
            scene_light(8.0, None),
            scene_light(0.0, None),
            scene_light(8.0, Some(2.0)),
            scene_light(8.0, Some(9.0)),
            scene_light(8.0, Some(0.1)),
            scene_light(8.0, Some(0.0)),
            scene_light(8.0, Some(1e-30)),
        ];
        let found = from_scene(&lights, 0.5, 0.1).unwrap();
        let radii: Vec<_> = found.iter().map(|l| (l.cutoff, l.r0, l.r1)).collect();
        assert_eq!(radii[..3], [(0.5, 0.1, 4.0), (2.0, 0.1, 2.0), (0.5, 0.1, 4.0)]);
        assert_eq!((radii.len(), radii[3].1, radii[3].2), (4, 0.05, 0.1));
        assert_eq!(found[0].position, [1.0, 2.0, 3.0]);
        assert_eq!(found[0].tint, [1.0, 0.5, 0.25]);
        assert_eq!(found[0].intensity, 8.0);
    }

    #[test]
    fn scene_lights_that_cannot_be_are_refused() {
        let message = |lights: &[SceneLight]| from_scene(lights, 0.5, 0.1).unwrap_err().to_string();
        assert!(message(&[]).contains("no point or spot lights"));
        assert!(message(&[scene_light(0.0, None)]).contains("no point or spot lights"));
        assert!(message(&[scene_light(-1.0, None)]).starts_with("scene light 0: i: -1"));
        assert!(message(&[scene_light(1.0, None), scene_light(f32::NAN, None)]).starts_with("scene light 1"));
        assert!(
            message(&[scene_light(1.0, Some(0.0))]).contains("no point or spot lights that reach anything")
        );
        assert!(message(&[scene_light(1.0, Some(-1.0))]).starts_with("scene light 0: r1: -1"));
        assert!(from_scene(&[scene_light(1.0, None)], 0.0, 0.1).is_err());
        assert!(from_scene(&[scene_light(1.0, None)], 0.5, f32::NAN).is_err());
    }

    #[test]
    fn a_source_gives_the_lights_of_any_frame() {
        let lighting = Lighting { count: 10, intensity: 20.0, cutoff: 0.5, r0: 0.1 };
        let at = |frame| Rain::new(&RainParameters::default(), &lighting, 1.0 / 90.0, frame).unwrap();
        let mut source = at(0);
        let mut revisions = vec![];
        for frame in [7, 3, 3, 40] {
            let lights = source.at_frame(frame);
            assert_eq!(lights.list, at(frame).lights());
            revisions.push(lights.revision);
        }
        assert!(revisions[1] == revisions[2] && revisions[0] != revisions[1] && revisions[2] != revisions[3]);
        let lights = at(5).lights().to_vec();
        let mut source = StaticLights(lights.clone());
        assert_eq!(source.at_frame(9).list, lights);
        assert_eq!(source.at_frame(9).revision, source.at_frame(2).revision);
    }
}
