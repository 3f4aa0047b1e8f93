//! Built-in scenes, generated in code: a Parisian street, a temple of the sun, a galleried hall and a city of
//! ziggurats.
//!
//! Street and temple stand where the scenes of Gelderen's chapter 6 and appendix C stood (metres, +Y up, inside the rain
//! box x -60..80, y -20..60, z -60..60 with a little of the temple's forecourt beyond it), so that the
//! `bistro` and `suntem` recordings fly through their free space; the `hall` recording flies through the hall, which lies
//! around the origin, as does the city with a recording of its name. Generation uses no platform's
//! trigonometry and a portable random generator: the same bytes on every machine.

mod architecture;
mod builder;
mod city;
mod clearance;
mod hall;
mod maths;
mod mesh;
mod palette;
mod patterns;
mod props;
mod street;
mod temple;
#[cfg(test)]
mod tests;
mod texture;

pub use clearance::distance_to_geometry;

use super::Scene;

/// How finely a built-in scene is tessellated and furnished.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    /// About 50 thousand triangles: the default.
    Small,
    /// About 500 thousand triangles.
    Medium,
    /// About 3 million triangles.
    Large,
}

impl Size {
    /// What [`by_name`] appends to a scene's name.
    fn suffix(self) -> &'static str {
        match self {
            Self::Small => "",
            Self::Medium => "-medium",
            Self::Large => "-large",
        }
    }
}

/// Every name that [`by_name`] knows.
pub const NAMES: [&str; 8] =
    ["street", "street-medium", "street-large", "temple", "temple-medium", "temple-large", "hall", "city"];

/// A street with facades, shops, trees and a café, which the `bistro` recording flies through.
pub fn street(size: Size) -> Scene {
    street::build(size).finish(&format!("street{}", size.suffix()))
}

/// A temple with a nave, a domed sanctuary, a cloister and a garden, for the `suntem` recording.
pub fn temple(size: Size) -> Scene {
    temple::build(size).finish(&format!("temple{}", size.suffix()))
}

/// A hall with aisles, two storeys of galleries and a vault, of about 250 thousand triangles: an interior such as papers
/// on many lights measure in, for the `hall` recording.
pub fn hall() -> Scene {
    hall::build().finish("hall")
}

/// A city of stepped towers between streets around a great ziggurat, of about 180 thousand triangles, such as Tegelaers
/// measures hashed light assignment in, for the `city` recording.
pub fn city() -> Scene {
    city::build().finish("city")
}

/// The built-in scene of that name (one of [`NAMES`]), if there is one.
pub fn by_name(name: &str) -> Option<Scene> {
    Some(match name {
        "street" => street(Size::Small),
        "street-medium" => street(Size::Medium),
        "street-large" => street(Size::Large),
        "temple" => temple(Size::Small),
        "temple-medium" => temple(Size::Medium),
        "temple-large" => temple(Size::Large),
        "hall" => hall(),
        "city" => city(),
        _ => return None,
    })
}

/// How much a generator spends on each kind of thing.
#[derive(Debug, Clone, Copy)]
struct Detail {
    /// Longest side of a quad on walls and ground, metres.
    step: f32,
    /// Segments around a thing of about a metre.
    round: u32,
    /// Leaf cards of one tree.
    leaves: u32,
    /// 0 has flat shapes, 1 adds window frames, rails and bars, 2 adds small ornaments.
    level: u32,
}

impl Detail {
    /// Quads along a side of `length` metres.
    fn cells(&self, length: f32) -> u32 {
        ((length / self.step).ceil() as u32).max(1)
    }

    /// Segments around a thing that is `scale` times a metre, at least `least`.
    fn around(&self, scale: f32, least: u32) -> u32 {
        ((self.round as f32 * scale) as u32).max(least)
    }
}
