//! OBJ text as vertices, and faces in groups of one material.

mod faces;
mod vertices;

use std::collections::BTreeMap;
use std::ops::Range;

use super::lines::{self, Statement, unquoted, without_comment};
use super::oddities::{Kind, Oddities, shown};
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
