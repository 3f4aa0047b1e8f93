//! Volumes of lights as they are asked for.

use crate::lights::place::{LightBox, numbers};
use crate::lights::spelled;
use std::fmt;
use std::str::FromStr;

/// An oriented box with lights on a lattice, written `[BOX:]NXxNYxNZ[:QX,QY,QZ,QW][:R1]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LatticeBox {
    /// The box before it is turned; the box of the lights where `None`.
    pub place: Option<LightBox>,
    /// Lights along each of its axes in the set 1x_1y_1z.
    pub lattice: [u32; 3],
    /// How it is turned about its middle: a quaternion x, y, z, w of any length but 0.
    pub turn: Option<[f32; 4]>,
    /// Where its lights end, metres; as the lighting has it where `None`.
    pub r1: Option<f32>,
}

impl LatticeBox {
    /// Lights of the set 1x_1y_1z.
    pub(super) fn light_count(&self) -> u32 {
        self.lattice.iter().product()
    }
}

impl fmt::Display for LatticeBox {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { place, lattice: [nx, ny, nz], turn, r1 } = self;
        if let Some(place) = place {
            write!(f, "{place}:")?;
        }
        write!(f, "{nx}x{ny}x{nz}")?;
        if let Some([x, y, z, w]) = turn {
            write!(f, ":{x},{y},{z},{w}")?;
        }
        r1.map_or(Ok(()), |r1| write!(f, ":{r1}"))
    }
}

impl FromStr for LatticeBox {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "`{text}` is no volume of lights [BOX:]NXxNYxNZ[:QX,QY,QZ,QW][:R1] such as -5,0,-5,5,4,5:10x4x10"
            )
        };
        let mut parts = text.split(':').peekable();
        let first = *parts.peek().ok_or_else(wrong)?;
        let mut volume = Self { place: None, lattice: [0; 3], turn: None, r1: None };
        if lattice(first).is_none() && text.contains(':') {
            volume.place = Some(first.parse()?);
            parts.next();
        }
        volume.lattice = parts.next().and_then(lattice).ok_or_else(wrong)?;
        if let Some(turn) = parts.next_if(|part| part.contains(',')) {
            volume.turn = Some(numbers(turn).ok_or_else(wrong)?);
        }
        if let Some(r1) = parts.next() {
            let [r1] = numbers(r1).ok_or_else(wrong)?;
            volume.r1 = Some(r1);
        }
        if parts.next().is_some() { Err(wrong()) } else { volume.check(text) }
    }
}

impl LatticeBox {
    /// Refuses lattices without lights, quaternions without direction, and radii that no light has.
    fn check(self, text: &str) -> Result<Self, String> {
        let count = self.lattice.iter().try_fold(1_u32, |count, &n| count.checked_mul(n));
        if count.is_none_or(|count| count == 0) {
            return Err(format!("the volume {text} has no light along an axis, or more than {}", u32::MAX));
        }
        let length = self.turn.map_or(1.0, |turn| turn.iter().map(|part| part * part).sum::<f32>());
        if !(length.is_finite() && length > 1e-12) {
            return Err(format!("the volume {text} is turned by a quaternion of no length"));
        }
        match self.r1 {
            Some(r1) if !(1e-3..=1e6).contains(&r1) => {
                Err(format!("the volume {text} has lights of radius {r1} m: it lies within 0.001..1000000"))
            }
            _ => Ok(self),
        }
    }
}

/// Three whole numbers with an `x` between.
fn lattice(text: &str) -> Option<[u32; 3]> {
    let read = |part: &str| part.trim().parse().ok();
    text.split('x').map(read).collect::<Option<Vec<_>>>()?.try_into().ok()
}

spelled!(LatticeBox);
