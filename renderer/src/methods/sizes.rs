//! Sizes in a method's name: plain decimal numbers, and for some sizes the unit that they are in.

use std::fmt;
use std::ops::Index;

/// What a size is called that is a number of slices.
pub(super) const SLICES: &str = "SLICES";
/// What a size is called that is in radii of the smallest light, or in metres where `m` follows the number.
pub(super) const NODE: &str = "SIZE";
/// What a size is called that is a depth, which may be 0.
pub(super) const DEPTH: &str = "DEPTH";

/// Names of sizes that are whole numbers.
const WHOLE: [&str; 4] = ["COLUMNS", "ROWS", SLICES, DEPTH];

/// What is written behind a number of metres.
const METRES: &str = "m";

/// What a size measures in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unit {
    /// What sizes of that name are in where nothing follows the number.
    Own,
    /// Metres, where sizes of that name are in something else: the name of the method has `m` behind the number.
    Metres,
}

/// One size of a method.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Size {
    /// What the number counts.
    pub unit: Unit,
    /// How many of them, not below 0.
    pub number: f64,
}

impl From<f64> for Size {
    fn from(number: f64) -> Self {
        Self { unit: Unit::Own, number }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.unit {
            Unit::Own => write!(f, "{}", self.number),
            Unit::Metres => write!(f, "{}{METRES}", self.number),
        }
    }
}

impl Size {
    /// Reads a plain decimal number, maybe with its unit: digits and at most one point, no sign, no exponent.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let (digits, unit) = text.strip_suffix(METRES).map_or((text, Unit::Own), |rest| (rest, Unit::Metres));
        let plain = digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
        let number: f64 = if plain { digits.parse().ok()? } else { return None };
        number.is_finite().then_some(Self { unit, number })
    }

    /// Whether it is a size of this name: above 0 but for depths, a whole number of what is counted, and in metres only where
    /// that is a choice.
    pub(super) fn fits(&self, name: &str) -> bool {
        let least = self.number > 0.0 || name == DEPTH;
        let whole = self.number.fract() == 0.0 || !WHOLE.contains(&name);
        least && whole && (self.unit == Unit::Own || name == NODE)
    }

    /// What stands for sizes of a name in a regular expression.
    pub fn expression(name: &str) -> &'static str {
        if name == NODE { "-[0-9.]+m?" } else { "-[0-9.]+" }
    }
}

/// The sizes of a method as its kind reads them: the numbers by index.
pub(super) struct Sizes<'a>(pub &'a [Size]);

impl Sizes<'_> {
    /// What a size measures in.
    pub fn unit(&self, place: usize) -> Unit {
        self.0[place].unit
    }
}

impl Index<usize> for Sizes<'_> {
    type Output = f64;

    fn index(&self, place: usize) -> &f64 {
        &self.0[place].number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_read_and_print_the_same() {
        for text in ["0", "0.5", "64", "2m", "0.25m"] {
            assert_eq!(Size::parse(text).unwrap().to_string(), text);
        }
        for text in ["", "m", "-1", "1e3", "nan", "1.5.2", "2mm", "2 m", "2cm"] {
            assert_eq!(Size::parse(text), None, "{text}");
        }
    }

    #[test]
    fn a_size_fits_names_whose_numbers_it_can_be() {
        let fits = |text: &str| {
            let size = Size::parse(text).unwrap();
            ["PIXELS", SLICES, NODE, DEPTH].map(|name| size.fits(name))
        };
        assert_eq!(fits("3"), [true; 4]);
        assert_eq!(fits("0"), [false, false, false, true]);
        assert_eq!(fits("1.5"), [true, false, true, false]);
        assert_eq!(fits("3m"), [false, false, true, false]);
    }
}
