//! Lines that are read otherwise than they stand, or not at all: told once a kind, or refused.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};

use crate::{Error, Result};

/// What is odd about a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// Bytes are not UTF-8.
    Encoding,
    /// A keyword that the format does not have.
    UnknownKeyword,
    /// A statement of the format that nothing here draws.
    NotDrawn,
    /// More values than the statement has.
    Stray,
    /// `v` without a position.
    Position,
    /// `v` with a weight that divides by nothing.
    Weight,
    /// A vertex colour that is no colour.
    Color,
    /// A vertex without colour among coloured ones.
    NoColor,
    /// A `vt` has no coordinates.
    Coordinates,
    /// `vn` without a normal.
    Normal,
    /// A face of one or two corners.
    FewCorners,
    /// A face that names a corner twice in a row.
    RepeatedCorner,
    /// A face with a corner that is nowhere.
    BadCorner,
    /// A corner that refers to coordinates or a normal that are not there.
    NoAttribute,
    /// A polygon of no area.
    NoArea,
    /// A polygon that is not cut as it should be.
    Fan,
    /// A name that is empty.
    EmptyName,
    /// A material that no library defines.
    NoMaterial,
    /// A library that is not there.
    NoLibrary,
    /// A property before the first material.
    NoOwner,
    /// A number or colour that cannot be read.
    Value,
    /// A texture line without a file.
    EmptyMap,
    /// A texture option that is not known, or that nothing here draws.
    TextureOption,
    /// An image that lies elsewhere than it says.
    Moved,
    /// A material defined again.
    Twice,
    /// `Tr` that would make a material invisible, or that `d` contradicts.
    Transparency,
    /// A material that is wholly transparent.
    Invisible,
}

impl Kind {
    /// What becomes of such a line.
    fn remedy(self) -> &'static str {
        match self {
            Self::Encoding => "read as Latin-1",
            Self::UnknownKeyword | Self::Stray | Self::NoOwner | Self::Value => "ignored",
            Self::NotDrawn | Self::FewCorners | Self::BadCorner | Self::NoArea => "left out",
            Self::Position => "faces there are left out",
            Self::Weight => "a weight of 1 stands in",
            Self::Color => "clamped to 0..1",
            Self::NoColor => "white stands in",
            Self::Coordinates => "0 stands in",
            Self::Normal => "the faces' own normal stands in",
            Self::RepeatedCorner => "taken once",
            Self::NoAttribute => "drawn without",
            Self::Fan => "drawn as a fan, maybe wrong",
            Self::EmptyName | Self::NoMaterial | Self::NoLibrary => "the default material stands in",
            Self::EmptyMap | Self::TextureOption => "drawn without",
            Self::Moved => "the one beside the MTL is taken",
            Self::Twice => "the later one is taken",
            Self::Transparency => "opaque",
            Self::Invisible => "drawn as it says",
        }
    }
}

/// More kinds than this, told apart by what they name too, are told together.
const MAX_KINDS: usize = 24;

/// The oddities of one file.
#[derive(Debug)]
pub(super) struct Oddities {
    file: PathBuf,
    strict: bool,
    found: BTreeMap<(Kind, String), Found>,
}

#[derive(Debug)]
struct Found {
    first: usize,
    last: usize,
    what: String,
    /// How many lines.
    count: usize,
}

impl Oddities {
    /// Oddities of `file`, none so far; `strict` refuses the first.
    pub fn new(file: &Path, strict: bool) -> Self {
        Self { file: file.to_owned(), strict, found: BTreeMap::new() }
    }

    /// Oddities of another file, refused where these are.
    pub fn of_same_rigour(&self, file: &Path) -> Self {
        Self::new(file, self.strict)
    }

    /// Notes that there is something odd at a line.
    ///
    /// # Errors
    /// The oddity itself, where they are refused.
    pub fn note(&mut self, line: usize, kind: Kind, what: impl Display) -> Result<()> {
        self.note_named(line, kind, "", what)
    }

    /// Notes as [`Self::note`] does, for a kind that is told apart by a name.
    ///
    /// # Errors
    /// As [`Self::note`].
    pub fn note_named(&mut self, line: usize, kind: Kind, name: &str, what: impl Display) -> Result<()> {
        if self.strict {
            let remedy = kind.remedy();
            return Err(Error::file(&self.file, format!("line {line}: {what} (without --strict: {remedy})")));
        }
        let name = if self.found.len() < MAX_KINDS { name } else { "" };
        // A look-up first: a million odd lines need no million strings.
        match self.found.get_mut(&(kind, name.to_owned())) {
            Some(found) => {
                found.count += usize::from(found.last != line);
                found.last = line;
            }
            None => {
                let found = Found { first: line, last: line, what: what.to_string(), count: 1 };
                self.found.insert((kind, name.to_owned()), found);
            }
        }
        Ok(())
    }

    /// Warnings, one a kind, by first line; those of another file than `scene` with its path.
    pub fn warnings(&self, scene: &Path) -> Vec<String> {
        let named = |message| match self.file == scene {
            true => message,
            false => format!("{}: {message}", self.file.display()),
        };
        self.messages().into_iter().map(named).collect()
    }

    /// `line L: what: what becomes of it (N such lines)`.
    pub fn messages(&self) -> Vec<String> {
        let mut found: Vec<_> = self.found.iter().map(|((kind, _), found)| (found, kind)).collect();
        found.sort_by_key(|(found, _)| found.first);
        let message = |(found, kind): (&Found, &Kind)| {
            let Found { first, what, count, .. } = found;
            let more = if *count > 1 { format!(" ({count} such lines)") } else { String::new() };
            format!("line {first}: {what}: {}{more}", kind.remedy())
        };
        found.into_iter().map(message).collect()
    }
}

/// A word of a file as it can stand in a message: on one line, in backticks, not too long.
pub(super) fn shown(word: &str) -> String {
    const LONGEST: usize = 60;
    let mut text: String = word.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if word.chars().nth(LONGEST).is_some() {
        text.push_str("...");
    }
    format!("`{}`", text.replace("\\\"", "\"").replace("\\'", "'").replace("\\\\", "\\"))
}

/// `1 number`, `2 numbers`.
pub(super) fn count(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_is_told_once_by_its_first_line() {
        let mut oddities = Oddities::new(Path::new("a.obj"), false);
        oddities.note(3, Kind::Stray, "v has 5 numbers").unwrap();
        for line in [7, 9] {
            oddities.note_named(line, Kind::UnknownKeyword, "lod", "unknown keyword `lod`").unwrap();
        }
        oddities.note_named(1, Kind::UnknownKeyword, "x", "unknown keyword `x`").unwrap();
        let expected = [
            "line 1: unknown keyword `x`: ignored",
            "line 3: v has 5 numbers: ignored",
            "line 7: unknown keyword `lod`: ignored (2 such lines)",
        ];
        assert_eq!(oddities.messages(), expected);
    }

    #[test]
    fn kinds_are_bounded() {
        let mut oddities = Oddities::new(Path::new("a.obj"), false);
        for line in 1..=100 {
            oddities.note_named(line, Kind::UnknownKeyword, &line.to_string(), "unknown keyword").unwrap();
        }
        let messages = oddities.messages();
        assert_eq!(messages.len(), MAX_KINDS + 1);
        assert!(messages.last().unwrap().ends_with("(76 such lines)"));
    }

    #[test]
    fn strict_refuses_the_first() {
        let error = Oddities::new(Path::new("a.obj"), true).note(7, Kind::FewCorners, "a face of 2 corners");
        let error = error.unwrap_err();
        assert_eq!(error.to_string(), "a.obj: line 7: a face of 2 corners (without --strict: left out)");
        assert_eq!(error.exit_code(), 2);
    }

    #[test]
    fn words_stay_on_a_line() {
        assert_eq!(shown("a\n\u{1b}[31m"), "`a\\n\\u{1b}[31m`");
        assert_eq!(shown(r#"C:\a "b""#), r#"`C:\a "b"`"#);
        assert_eq!(shown(&"x".repeat(70)).len(), 65);
    }
}
