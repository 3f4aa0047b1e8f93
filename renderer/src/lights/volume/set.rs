//! Names of light sets: how many times as many lights along each axis.

use crate::lights::spelled;
use std::fmt;
use std::str::FromStr;

/// Multipliers of a lattice along the axes of its box, each 1, 2 or 3; written `2x_1y_3z`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LightSet([u32; 3]);

impl LightSet {
    /// The lattice as it stands.
    pub const ONE: Self = Self([1; 3]);

    /// All sets whose multipliers do not grow from x to z: one of each factor.
    pub(super) fn descending() -> impl Iterator<Item = Self> {
        (1..=3).flat_map(|x| (1..=x).flat_map(move |y| (1..=y).map(move |z| Self([x, y, z]))))
    }

    /// How many times as many lights there are.
    pub fn factor(self) -> u32 {
        self.0.iter().product()
    }

    /// The lattice of this set over that of [`Self::ONE`].
    pub(super) fn times(self, lattice: [u32; 3]) -> [u32; 3] {
        std::array::from_fn(|axis| self.0[axis] * lattice[axis])
    }
}

impl fmt::Display for LightSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self([x, y, z]) = self;
        write!(f, "{x}x_{y}y_{z}z")
    }
}

impl FromStr for LightSet {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        let part = |part: &str, axis: char| match part.strip_suffix(axis)? {
            "1" => Some(1),
            "2" => Some(2),
            "3" => Some(3),
            _ => None,
        };
        let read = || {
            let mut parts = text.split('_');
            let set = [part(parts.next()?, 'x')?, part(parts.next()?, 'y')?, part(parts.next()?, 'z')?];
            parts.next().is_none().then_some(Self(set))
        };
        read()
            .ok_or_else(|| format!("`{text}` is no set of lights such as 2x_1y_3z, with factors 1, 2 and 3"))
    }
}

spelled!(LightSet);
