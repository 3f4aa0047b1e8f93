//! Lights of any generator, of which a part are made spots.
//!
//! ```text
//! LightSource ──(each frame)──> lights ──┐
//! SpotShare, seed ──> cone of each ──────┴──> lights, some with cones
//! ```

use super::random::{generator, normal, uniform_vector};
use super::{FrameLights, Light, LightSource, Spot};
use rand_pcg::Pcg32;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Outer half angles of the cones that are made, degrees.
const OUTER_DEGREES: [f32; 2] = [15.0, 45.0];

/// The inner half angle of such a cone, of the outer one.
const INNER_PART: f32 = 0.5;

/// What tells the random numbers of cones apart from those of lives of lights, which count from 0.
const CONE_LIFE: u32 = u32::MAX;

/// Which part of the lights that are made are spots, 0 to 1. They are spread evenly among the others: of the first n lights
/// floor(n * share) are spots, so that half of any number are half points, half spots (Örtegren section 5.1).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "f64")]
pub struct SpotShare(#[schemars(range(min = 0, max = 1))] f64);

impl SpotShare {
    /// Whether any light is a spot.
    pub fn is_any(self) -> bool {
        self.0 > 0.0
    }

    /// Whether a light is a spot.
    fn has(self, light: u32) -> bool {
        let before = |count: u32| (f64::from(count) * self.0).floor();
        before(light) < ((f64::from(light) + 1.0) * self.0).floor()
    }

    /// The cone of a light that is a spot: all directions are as likely, outer half angles are uniform in 15 to 45 degrees, inner ones
    /// half of that.
    pub(super) fn cone(self, seed: u64, light: u32) -> Option<Spot> {
        self.has(light).then(|| {
            let mut random = generator(seed, light, CONE_LIFE);
            let [outer, _, _] = uniform_vector(&mut random, [OUTER_DEGREES[0]; 3], [OUTER_DEGREES[1]; 3]);
            let outer = outer.to_radians();
            Spot::new(direction(&mut random), INNER_PART * outer, outer)
        })
    }
}

/// Uniform among all directions.
fn direction(random: &mut Pcg32) -> [f32; 3] {
    loop {
        let along = [0; 3].map(|_| normal(random) as f32);
        if along.iter().map(|part| part * part).sum::<f32>() > 1e-6 {
            return along;
        }
    }
}

impl TryFrom<f64> for SpotShare {
    type Error = String;

    fn try_from(share: f64) -> Result<Self, String> {
        if (0.0..=1.0).contains(&share) {
            return Ok(Self(share));
        }
        Err(format!("{share} is no part of the lights: it is from 0 (points alone) to 1 (spots alone)"))
    }
}

impl FromStr for SpotShare {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let share: f64 = text.parse().map_err(|_| format!("`{text}` is no number such as 0.5"))?;
        share.try_into()
    }
}

impl fmt::Display for SpotShare {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A source of which some lights have cones, which stay as they are.
pub(super) struct Spotted {
    source: Box<dyn LightSource>,
    cones: Vec<Option<Spot>>,
    lights: Vec<Light>,
    /// That of the lights at hand.
    revision: Option<u64>,
}

impl Spotted {
    /// `count` lights of `source`, of which `share` get cones.
    pub fn new(source: Box<dyn LightSource>, (share, seed): (SpotShare, u64), count: u32) -> Self {
        let cones: Vec<_> = (0..count).map(|light| share.cone(seed, light)).collect();
        Self { source, lights: Vec::with_capacity(cones.len()), cones, revision: None }
    }
}

impl LightSource for Spotted {
    fn at_frame(&mut self, frame: u32) -> FrameLights<'_> {
        let FrameLights { list, revision } = self.source.at_frame(frame);
        if self.revision != Some(revision) {
            self.lights.clear();
            self.lights.extend(list.iter().zip(&self.cones).map(|(light, spot)| light.shining(*spot)));
            self.revision = Some(revision);
        }
        FrameLights { list: &self.lights, revision }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lights::{Lighting, StaticLights};

    fn share(part: f64) -> SpotShare {
        part.try_into().unwrap()
    }

    #[test]
    fn of_any_number_of_lights_the_part_that_was_asked_for_are_spots() {
        for (part, count, spots) in
            [(0.0, 1000, 0), (1.0, 1000, 1000), (0.5, 999, 499), (0.5, 4000, 2000), (0.25, 10, 2)]
        {
            let found = (0..count).filter(|&light| share(part).has(light)).count();
            assert_eq!(found, spots, "{part} of {count}");
        }
        let first: Vec<bool> = (0..4).map(|light| share(0.5).has(light)).collect();
        assert_eq!(first, [false, true, false, true]);
    }

    #[test]
    fn cones_differ_by_light_and_by_seed_and_point_everywhere() {
        let cones: Vec<Spot> = (0..2000).filter_map(|light| share(1.0).cone(7, light)).collect();
        assert!(cones.iter().all(|cone| cone.check().is_ok()));
        let mean = cones.iter().map(Spot::axis).sum::<glam::DVec3>() / 2000.0;
        assert!(mean.length() < 0.06, "{mean}");
        let degrees = cones.iter().map(|cone| f64::from(cone.outer.to_degrees())).sum::<f64>() / 2000.0;
        assert!((degrees - 30.0).abs() < 0.8, "{degrees}");
        assert_ne!(share(1.0).cone(7, 3), share(1.0).cone(8, 3));
        assert_eq!(share(1.0).cone(7, 3), share(0.5).cone(7, 3));
    }

    #[test]
    fn a_source_keeps_its_lights_but_for_their_cones() {
        let lighting = Lighting::with_count(6);
        let lights: Vec<_> = (0..6).map(|_| lighting.light()).collect();
        let mut spotted = Spotted::new(Box::new(StaticLights(lights.clone())), (share(0.5), 1), 6);
        let found = spotted.at_frame(3).list.to_vec();
        assert_eq!(found.iter().filter(|light| light.spot.is_some()).count(), 3);
        assert!(found.iter().zip(&lights).all(|(found, light)| found.shining(None) == *light));
        assert_eq!(spotted.at_frame(9).revision, spotted.at_frame(3).revision);
    }

    #[test]
    fn what_is_no_part_is_refused() {
        for wrong in ["-0.1", "1.5", "NaN", "half"] {
            assert!(wrong.parse::<SpotShare>().is_err(), "{wrong}");
        }
        assert_eq!("0.5".parse::<SpotShare>().unwrap().to_string(), "0.5");
    }
}
