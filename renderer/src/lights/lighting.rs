//! Where the lights of a run come from, and how many and how strong those are that are made.

use super::{Generator, Light, SpotShare};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

/// N lights of one intensity, cut-off and near radius.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "RawLighting")]
pub struct Lighting {
    /// Number of lights N.
    pub count: u32,
    /// Intensity I of each light.
    pub intensity: f32,
    /// Cut-off I0 of each light.
    pub cutoff: f32,
    /// Near radius R0, metres.
    pub r0: f32,
}

/// Where the lights of one run come from.
#[derive(Debug, Clone, PartialEq)]
pub enum LightsFrom {
    /// Lights that are made, of this number and strength, and which part of them are spots.
    Generated(Generator, Lighting, SpotShare),
    /// Static lights of a CSV file.
    File(PathBuf),
    /// The scene's own point lights.
    Scene,
}

/// A lighting as JSON carries it: all but the count may be left out.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with a count, and maybe intensity, cutoff and r0")]
struct RawLighting {
    /// How many lights.
    #[schemars(range(min = 1))]
    count: u32,
    /// Intensity I.
    #[serde(default = "Lighting::default_intensity")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    intensity: f64,
    /// Intensity cut-off I0; lights reach R1 = sqrt(I/I0) metres.
    #[serde(default = "Lighting::default_cutoff")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    cutoff: f64,
    /// Near radius R0, metres, below R1.
    #[serde(default = "Lighting::default_r0")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    r0: f64,
}

impl TryFrom<RawLighting> for Lighting {
    type Error = String;

    fn try_from(raw: RawLighting) -> Result<Self, String> {
        let RawLighting { count, intensity, cutoff, r0 } = raw;
        Self { count, intensity: intensity as f32, cutoff: cutoff as f32, r0: r0 as f32 }.check()
    }
}

impl Lighting {
    /// `count` lights of the intensity, cut-off and near radius that are used where none are given.
    pub fn with_count(count: u32) -> Self {
        Self {
            count,
            intensity: Self::default_intensity() as f32,
            cutoff: Self::default_cutoff() as f32,
            r0: Self::default_r0() as f32,
        }
    }

    fn default_intensity() -> f64 {
        100.0
    }

    fn default_cutoff() -> f64 {
        0.5
    }

    fn default_r0() -> f64 {
        0.1
    }

    /// Influence radius R1 = sqrt(I/I0), metres.
    pub fn r1(&self) -> f32 {
        (self.intensity / self.cutoff).sqrt()
    }

    /// A light of this strength in the world's origin, white.
    pub(super) fn light(&self) -> Light {
        Light::new([0.0; 3], [1.0; 3], self.intensity, self.cutoff, self.r0)
    }

    /// A light that ends at `r1` metres, where its intensity I0*R1^2 has fallen to the cut-off. Its near radius is at most
    /// R1/2.
    pub(super) fn light_of_radius(&self, position: [f32; 3], tint: [f32; 3], r1: f32) -> Light {
        let (cutoff, r0) = (self.cutoff, self.r0.min(0.5 * r1));
        Light { position, tint, intensity: cutoff * r1 * r1, cutoff, r0, r1, spot: None }
    }

    /// Refuses zero lights, values that are not positive and finite, and R0 not below R1.
    pub(crate) fn check(self) -> Result<Self, String> {
        if self.count == 0 {
            return Err("0 lights: the count is at least 1".into());
        }
        for (name, value) in [("intensity", self.intensity), ("cutoff", self.cutoff), ("r0", self.r0)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(format!("{name} {value}: it must be a finite number above 0"));
            }
        }
        if self.r1().is_finite() && self.r0 < self.r1() {
            return Ok(self);
        }
        Err(format!("r0 {}: it must be below the influence radius sqrt(I/I0) = {}", self.r0, self.r1()))
    }
}

impl fmt::Display for Lighting {
    /// Writes `N,I,I0,R0`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{},{}", self.count, self.intensity, self.cutoff, self.r0)
    }
}

impl FromStr for Lighting {
    type Err = String;

    /// Reads `N[,I[,I0[,R0]]]`.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is no lighting N[,I,I0,R0] such as 1000 or 10000,20,0.5,0.1");
        let mut parts = text.split(',').map(str::trim);
        let mut lighting = Self::with_count(parts.next().unwrap_or_default().parse().map_err(|_| wrong())?);
        for value in [&mut lighting.intensity, &mut lighting.cutoff, &mut lighting.r0] {
            if let Some(part) = parts.next() {
                *value = part.parse().map_err(|_| wrong())?;
            }
        }
        if parts.next().is_some() { Err(wrong()) } else { lighting.check() }
    }
}

impl LightsFrom {
    /// Number and strength of lights that are made.
    pub fn lighting(&self) -> Option<Lighting> {
        match self {
            Self::Generated(_, lighting, _) => Some(*lighting),
            Self::File(_) | Self::Scene => None,
        }
    }
}

impl fmt::Display for LightsFrom {
    /// Writes what tells the lights of one run from another's: the count, the file, or `scene`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Generated(_, lighting, _) => write!(f, "{}", lighting.count),
            Self::File(path) => write!(f, "{}", path.display()),
            Self::Scene => f.write_str("scene"),
        }
    }
}
