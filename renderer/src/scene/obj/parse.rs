//! OBJ text as vertices, and faces in groups of one material.

use std::collections::BTreeMap;
use std::ops::Range;

use super::lines::{self, Statement, number, unquoted, without_comment};
use super::oddities::{Kind, Oddities, count, shown};
use crate::Result;

/// No coordinates, no normal.
pub(super) const NONE: u32 = u32::MAX;

/// The statements of free-form geometry and what else is drawn by no triangle.
const NOT_DRAWN: &[&str] = &[
    "#MRGB",
    "bevel",
    "bmat",
    "bsp",
    "bzp",
    "c_interp",
    "cdc",
    "cdp",
    "con",
    "cstype",
    "ctech",
    "curv",
    "curv2",
    "d_interp",
    "deg",
    "end",
    "hole",
    "l",
    "lod",
    "maplib",
    "mg",
    "p",
    "parm",
    "res",
    "scrv",
    "shadow_obj",
    "sp",
    "stech",
    "step",
    "surf",
    "trace_obj",
    "trim",
    "usemap",
    "vp",
];

/// A corner of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Corner {
    /// Index into [`Geometry::positions`].
    pub position: u32,
    /// Index into [`Geometry::coordinates`], or [`NONE`].
    pub coordinates: u32,
    /// Index into [`Geometry::normals`], or [`NONE`].
    pub normal: u32,
}

/// A polygon.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Face {
    /// Range of [`Geometry::corners`], three at least.
    pub corners: Range<usize>,
    /// Line of the face, from 1.
    pub line: usize,
}

/// Faces that are drawn together.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Group {
    /// Index into [`Geometry::materials`]; `None` where no `usemtl` stands before.
    pub material: Option<usize>,
    /// Range of [`Geometry::faces`].
    pub faces: Range<usize>,
}

/// What an OBJ file holds.
#[derive(Debug, Default)]
pub(super) struct Geometry {
    /// Positions of vertices, metres; not finite where the file has no position.
    pub positions: Vec<[f32; 3]>,
    /// Colours by position, linear; empty where no vertex has a colour.
    pub colors: Vec<[u8; 4]>,
    /// v up the image.
    pub coordinates: Vec<[f32; 2]>,
    /// Normals of any length; of none where the file has no normal.
    pub normals: Vec<[f32; 3]>,
    pub corners: Vec<Corner>,
    pub faces: Vec<Face>,
    /// Groups of faces in order, none without a face.
    pub groups: Vec<Group>,
    /// Names after `usemtl` with the line of the first.
    pub materials: Vec<(String, usize)>,
    /// What stands after each `mtllib`, with its line.
    pub libraries: Vec<(String, usize)>,
}

/// Reads OBJ text whose lines end with LF.
///
/// # Errors
/// The first oddity, where they are refused.
pub(super) fn parse(text: &str, oddities: &mut Oddities) -> Result<Geometry> {
    let mut parser = Parser {
        geometry: Geometry::default(),
        totals: totals(text),
        material: None,
        material_of_name: BTreeMap::new(),
        colored: None,
        group: 0..0,
        oddities,
    };
    for statement in lines::statements(text) {
        parser.statement(&statement)?;
    }
    parser.end_group();
    Ok(parser.geometry)
}

/// How many `v`, `vt` and `vn` there are: faces may refer to later ones.
fn totals(text: &str) -> [usize; 3] {
    let mut totals = [0; 3];
    for statement in lines::statements(text) {
        if let Some(kind) = KINDS.iter().position(|kind| *kind == statement.split().0) {
            totals[kind] += 1;
        }
    }
    totals
}

/// What the three indices of a corner count.
const KINDS: [&str; 3] = ["v", "vt", "vn"];

struct Parser<'a> {
    geometry: Geometry,
    totals: [usize; 3],
    /// Into [`Geometry::materials`].
    material: Option<usize>,
    material_of_name: BTreeMap<String, usize>,
    /// Whether the first vertex has a colour.
    colored: Option<bool>,
    /// Faces of the group so far.
    group: Range<usize>,
    oddities: &'a mut Oddities,
}

impl Parser<'_> {
    fn statement(&mut self, statement: &Statement) -> Result<()> {
        let line = statement.line;
        let (keyword, rest) = statement.split();
        match keyword {
            "v" => self.vertex(line, without_comment(rest)),
            "vt" => self.coordinates(line, without_comment(rest)),
            "vn" => self.normal(line, without_comment(rest)),
            // "fo" is what the first versions of the format called a face.
            "f" | "fo" => self.face(line, without_comment(rest)),
            "s" => Ok(()),
            // A group may have no name, several, or that of another group.
            "g" | "o" => {
                self.end_group();
                Ok(())
            }
            "usemtl" => self.use_material(line, rest),
            "mtllib" if rest.is_empty() => self.oddities.note(line, Kind::EmptyName, "mtllib without a name"),
            "mtllib" => {
                self.geometry.libraries.push((rest.to_owned(), line));
                Ok(())
            }
            _ if NOT_DRAWN.contains(&keyword) => {
                let what = format_args!("`{keyword}` is not drawn");
                self.oddities.note_named(line, Kind::NotDrawn, keyword, what)
            }
            _ => {
                let keyword = shown(keyword);
                let what = format_args!("unknown keyword {keyword}");
                self.oddities.note_named(line, Kind::UnknownKeyword, &keyword, what)
            }
        }
    }

    /// `v x y z`, `v x y z w`, `v x y z r g b`.
    fn vertex(&mut self, line: usize, rest: &str) -> Result<()> {
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
    fn coordinates(&mut self, line: usize, rest: &str) -> Result<()> {
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

    fn normal(&mut self, line: usize, rest: &str) -> Result<()> {
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

    fn face(&mut self, line: usize, rest: &str) -> Result<()> {
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

    fn use_material(&mut self, line: usize, rest: &str) -> Result<()> {
        let name = unquoted(rest);
        let next = self.geometry.materials.len();
        let material = match self.material_of_name.get(name) {
            Some(&known) => known,
            None => {
                self.material_of_name.insert(name.to_owned(), next);
                self.geometry.materials.push((name.to_owned(), line));
                next
            }
        };
        if self.material != Some(material) {
            self.end_group();
        }
        self.material = Some(material);
        Ok(())
    }

    fn end_group(&mut self) {
        if !self.group.is_empty() {
            self.geometry.groups.push(Group { material: self.material, faces: self.group.clone() });
        }
        self.group = self.group.end..self.group.end;
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
