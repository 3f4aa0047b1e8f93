//! Faces and their corners.

use super::super::oddities::{Kind, count, shown};
use super::{Corner, Face, KINDS, NONE, Parser};
use crate::Result;

impl Parser<'_> {
    pub(super) fn face(&mut self, line: usize, rest: &str) -> Result<()> {
        let first = self.geometry.corners.len();
        let mut repeated = false;
        for word in rest.split_whitespace() {
            let Some(corner) = self.corner(line, word)? else {
                self.geometry.corners.truncate(first);
                return Ok(());
            };
            let before = self.geometry.corners[first..].last();
            let again = before.is_some_and(|before| before.position == corner.position);
            repeated |= again;
            if !again {
                self.geometry.corners.push(corner);
            }
        }
        self.close_face(line, first, repeated)
    }

    /// Makes the corners from `first` on a face, if they are enough.
    fn close_face(&mut self, line: usize, first: usize, mut repeated: bool) -> Result<()> {
        let corners = &mut self.geometry.corners;
        let ends_meet = |corners: &[Corner]| {
            corners.len() > first + 1 && corners[corners.len() - 1].position == corners[first].position
        };
        while ends_meet(corners) {
            corners.pop();
            repeated = true;
        }
        let different = corners.len() - first;
        if different < 3 {
            corners.truncate(first);
            let held = count(different, if repeated { "different corner" } else { "corner" });
            return self.oddities.note(line, Kind::FewCorners, format_args!("a face of {held}"));
        }
        if repeated {
            self.oddities.note(line, Kind::RepeatedCorner, "a face with the same corner twice in a row")?;
        }
        self.geometry.faces.push(Face { corners: first..self.geometry.corners.len(), line });
        self.group.end = self.geometry.faces.len();
        Ok(())
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`; `None`, and a note, where it has no position.
    fn corner(&mut self, line: usize, word: &str) -> Result<Option<Corner>> {
        let mut parts = word.split('/');
        let position = self.index(0, parts.next().unwrap_or_default());
        let position = match position.and_then(|position| position.ok_or("has no position".into())) {
            Ok(position) => position,
            Err(problem) => {
                let what = format_args!("face corner {} {problem}", shown(word));
                self.oddities.note(line, Kind::BadCorner, what)?;
                return Ok(None);
            }
        };
        let mut attributes = [NONE; 2];
        for (attribute, kind) in attributes.iter_mut().zip(1..) {
            match self.index(kind, parts.next().unwrap_or_default()) {
                Ok(index) => *attribute = index.unwrap_or(NONE),
                Err(problem) => {
                    let what = format_args!("face corner {} {problem}", shown(word));
                    self.oddities.note_named(line, Kind::NoAttribute, KINDS[kind], what)?;
                }
            }
        }
        if parts.next().is_some() {
            let what = format_args!("face corner {} has more than three indices", shown(word));
            self.oddities.note(line, Kind::Stray, what)?;
        }
        let [coordinates, normal] = attributes;
        Ok(Some(Corner { position, coordinates, normal }))
    }

    /// From 1, or counted back from here where negative; `None` for nothing.
    fn index(&self, kind: usize, digits: &str) -> Result<Option<u32>, String> {
        if digits.is_empty() {
            return Ok(None);
        }
        let (name, total) = (KINDS[kind], self.totals[kind]);
        let Ok(number) = digits.parse::<i64>() else {
            return Err(format!("has the index {}, which is no whole number within reach", shown(digits)));
        };
        let here = match kind {
            0 => self.geometry.positions.len(),
            1 => self.geometry.coordinates.len(),
            _ => self.geometry.normals.len(),
        };
        let place = if number > 0 { number.checked_sub(1) } else { number.checked_add(here as i64) };
        let place = place.filter(|&place| number != 0 && (0..total as i64).contains(&place));
        let place = place.and_then(|place| u32::try_from(place).ok()).filter(|&place| place != NONE);
        place.map(Some).ok_or_else(|| format!("refers to {name} {number}; the file has {total}"))
    }
}
