//! Boxes that lights are made in.

use super::spelled;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// A box along the axes of the world, metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Corners {
    /// Lowest corner.
    pub min: [f32; 3],
    /// Highest corner.
    pub max: [f32; 3],
}

impl Corners {
    /// Length of each side, metres.
    pub fn sides(&self) -> [f64; 3] {
        std::array::from_fn(|axis| f64::from(self.max[axis]) - f64::from(self.min[axis]))
    }
}

/// Which box lights are made in.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum LightBox {
    /// The box around the scene.
    #[default]
    Scene,
    /// The box in which the recording's rain falls.
    Rain,
    /// A box of its own.
    Corners(Corners),
}

impl fmt::Display for LightBox {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene => f.write_str("scene"),
            Self::Rain => f.write_str("rain"),
            Self::Corners(Corners { min: [x0, y0, z0], max: [x1, y1, z1] }) => {
                write!(f, "{x0},{y0},{z0},{x1},{y1},{z1}")
            }
        }
    }
}

impl FromStr for LightBox {
    type Err = String;

    /// Reads `scene`, `rain` or `X0,Y0,Z0,X1,Y1,Z1` with the lowest corner first.
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "scene" => return Ok(Self::Scene),
            "rain" => return Ok(Self::Rain),
            _ => {}
        }
        let wrong =
            || format!("`{text}` is no box: `scene`, `rain` or X0,Y0,Z0,X1,Y1,Z1 such as -5,0,-5,5,4,5");
        let [x0, y0, z0, x1, y1, z1] = numbers(text).ok_or_else(wrong)?;
        let corners = Corners { min: [x0, y0, z0], max: [x1, y1, z1] };
        if [x0, y0, z0, x1, y1, z1].iter().any(|value| value.abs() > 1e6) {
            return Err(format!("the box {text} reaches beyond +-1e6 m"));
        }
        match corners.sides().iter().all(|side| *side > 0.0) {
            true => Ok(Self::Corners(corners)),
            false => Err(format!("the box {text} is empty: X1, Y1 and Z1 must lie above X0, Y0 and Z0")),
        }
    }
}

spelled!(LightBox);

/// So many finite numbers with commas between.
pub(super) fn numbers<const N: usize>(text: &str) -> Option<[f32; N]> {
    let read = |part: &str| part.trim().parse::<f32>().ok().filter(|number| number.is_finite());
    text.split(',').map(read).collect::<Option<Vec<_>>>()?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_read_as_they_are_written() {
        let corners = LightBox::Corners(Corners { min: [-5.0, 0.0, -5.5], max: [5.0, 4.0, 5.25] });
        for (text, place) in
            [("scene", LightBox::Scene), ("rain", LightBox::Rain), ("-5,0,-5.5,5,4,5.25", corners)]
        {
            assert_eq!((text.parse(), place.to_string()), (Ok(place), text.to_owned()));
        }
        for (wrong, start) in [
            ("", "`` is no box"),
            ("street", "`street` is no box"),
            ("1,2,3", "`1,2,3` is no box"),
            ("0,0,0,1,1,inf", "`0,0,0,1,1,inf` is no box"),
            ("0,0,0,1,1,1,1", "`0,0,0,1,1,1,1` is no box"),
            ("0,0,0,1,0,1", "the box 0,0,0,1,0,1 is empty"),
            ("0,0,0,1,1,2e6", "the box 0,0,0,1,1,2e6 reaches beyond"),
        ] {
            let message = wrong.parse::<LightBox>().unwrap_err();
            assert!(message.starts_with(start), "{wrong}: {message}");
        }
    }
}
