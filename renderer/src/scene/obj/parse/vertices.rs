//! Positions with their colours, texture coordinates and normals.

use super::super::lines::number;
use super::super::oddities::{Kind, count, shown};
use super::Parser;
use crate::Result;

impl Parser<'_> {
    /// `v x y z`, `v x y z w`, `v x y z r g b`.
    pub(super) fn vertex(&mut self, line: usize, rest: &str) -> Result<()> {
        let (values, words) = numbers::<6>(rest);
        let mut position = [values[0], values[1], values[2]];
        if !position.iter().all(|x| x.is_finite()) {
            position = [f32::NAN; 3];
            self.bad_numbers(line, Kind::Position, "v", rest, 3)?;
        } else if words == 4 {
            position = self.weighted(line, position, values[3])?;
        } else if words == 5 || words > 6 {
            let what = format_args!("v has {words} numbers; x y z, x y z w and x y z r g b are read");
            self.oddities.note(line, Kind::Stray, what)?;
        }
        self.geometry.positions.push(position);
        let color = (words >= 6).then_some([values[3], values[4], values[5]]);
        self.color(line, color)
    }

    /// Homogeneous coordinates, as points in space.
    fn weighted(&mut self, line: usize, position: [f32; 3], weight: f32) -> Result<[f32; 3]> {
        let divided = position.map(|x| x / weight);
        if divided.iter().all(|x| x.is_finite()) {
            return Ok(divided);
        }
        self.oddities.note(line, Kind::Weight, format_args!("v has a weight of {weight}"))?;
        Ok(position)
    }

    fn color(&mut self, line: usize, color: Option<[f32; 3]>) -> Result<()> {
        if *self.colored.get_or_insert(color.is_some()) != color.is_some() {
            let what = "some vertices have colours and some have none";
            self.oddities.note(line, Kind::NoColor, what)?;
        }
        let vertices = self.geometry.positions.len();
        let Some(color) = color else {
            if !self.geometry.colors.is_empty() {
                self.geometry.colors.push([255; 4]);
            }
            return Ok(());
        };
        if !color.iter().all(|x| (0.0..=1.0).contains(x)) {
            let [r, g, b] = color;
            let what = format_args!("v has the colour {r} {g} {b}, which is not within 0..1");
            self.oddities.note(line, Kind::Color, what)?;
        }
        self.geometry.colors.resize(vertices - 1, [255; 4]);
        let [r, g, b] = color.map(linear);
        self.geometry.colors.push([r, g, b, 255]);
        Ok(())
    }

    /// `vt u`, `vt u v`, `vt u v w`; the depth w is not used.
    pub(super) fn coordinates(&mut self, line: usize, rest: &str) -> Result<()> {
        let (values, words) = numbers::<2>(rest);
        let [u, v] = if words == 1 { [values[0], 0.0] } else { values };
        if u.is_finite() && v.is_finite() {
            self.stray(line, "vt", words, 3)?;
            self.geometry.coordinates.push([u, v]);
        } else {
            self.bad_numbers(line, Kind::Coordinates, "vt", rest, 1)?;
            self.geometry.coordinates.push([0.0; 2]);
        }
        Ok(())
    }

    pub(super) fn normal(&mut self, line: usize, rest: &str) -> Result<()> {
        let (values, words) = numbers::<3>(rest);
        if values.iter().all(|x| x.is_finite()) {
            self.stray(line, "vn", words, 3)?;
            self.geometry.normals.push(values);
        } else {
            self.bad_numbers(line, Kind::Normal, "vn", rest, 3)?;
            self.geometry.normals.push([0.0; 3]);
        }
        Ok(())
    }

    fn stray(&mut self, line: usize, keyword: &str, words: usize, most: usize) -> Result<()> {
        if words <= most {
            return Ok(());
        }
        let what = format_args!("{keyword} has {words} numbers; {most} are read");
        self.oddities.note(line, Kind::Stray, what)
    }

    /// Notes too few numbers, or the first that is none.
    fn bad_numbers(
        &mut self,
        line: usize,
        kind: Kind,
        keyword: &str,
        rest: &str,
        least: usize,
    ) -> Result<()> {
        match rest.split_whitespace().find(|word| number(word).is_none()) {
            Some(word) => {
                let word = shown(word);
                self.oddities.note(
                    line,
                    kind,
                    format_args!("{keyword} has {word}, which is not a finite number"),
                )
            }
            None => {
                let held = count(rest.split_whitespace().count(), "number");
                let wanted = if least == 1 { "1 is" } else { "3 are" };
                self.oddities.note(line, kind, format_args!("{keyword} has {held}; {wanted} expected"))
            }
        }
    }
}

/// The first words as numbers, not a number where there is none, and how many words there are.
fn numbers<const N: usize>(rest: &str) -> ([f32; N], usize) {
    let mut values = [f32::NAN; N];
    let mut words = 0;
    for word in rest.split_whitespace() {
        if let Some(value) = values.get_mut(words) {
            *value = number(word).unwrap_or(f32::NAN);
        }
        words += 1;
    }
    (values, words)
}

/// An sRGB component (IEC 61966-2-1) as linear 8-bit unorm; white where it is not a number.
fn linear(encoded: f32) -> u8 {
    let encoded = if encoded.is_nan() { 1.0 } else { f64::from(encoded).clamp(0.0, 1.0) };
    let light = if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) };
    (light * 255.0).round() as u8
}
