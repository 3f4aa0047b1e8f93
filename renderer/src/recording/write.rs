//! Writing recordings: one field a line, one row of a table a line.

use super::{Recording, RecordingFile};
use crate::output::write_whole;
use crate::{Error, Result};
use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};
use std::io::{self, Write};
use std::path::Path;

/// Containers at this depth and above break their lines: the file's fields and their elements.
const BROKEN_DEPTH: usize = 2;

impl Recording {
    /// Writes the recording to `path`, whole or not at all: see [`write_whole`].
    ///
    /// # Errors
    /// [`Error::File`] where it cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let text = to_json(self.file())?;
        write_whole(path.as_ref(), |file| file.write_all(text.as_bytes()))
    }
}

/// The text of the file, with a line break at its end.
pub(super) fn to_json(file: &RecordingFile) -> Result<String> {
    let mut bytes = Vec::new();
    let mut serializer = Serializer::with_formatter(&mut bytes, Rows::default());
    let text = file.serialize(&mut serializer).map_err(|error| error.to_string()).and_then(|()| {
        bytes.push(b'\n');
        String::from_utf8(bytes).map_err(|error| error.to_string())
    });
    text.map_err(|error| Error::Internal(format!("the recording cannot be written as JSON: {error}")))
}

/// Breaks lines between the fields of the outermost object and between the elements of arrays right below it.
#[derive(Default)]
struct Rows {
    depth: usize,
    /// Whether the second level is an array.
    table: bool,
}

impl Rows {
    fn breaks(&self) -> bool {
        self.depth < BROKEN_DEPTH || (self.depth == BROKEN_DEPTH && self.table)
    }

    fn separate<W: ?Sized + Write>(&self, writer: &mut W, first: bool) -> io::Result<()> {
        match (first, self.breaks()) {
            (true, true) => writer.write_all(b"\n"),
            (false, true) => writer.write_all(b",\n"),
            (true, false) => Ok(()),
            (false, false) => writer.write_all(b", "),
        }
    }

    fn close<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        if self.breaks() {
            writer.write_all(b"\n")?;
        }
        self.depth -= 1;
        writer.write_all(bracket)
    }

    fn open<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        self.depth += 1;
        if self.depth == BROKEN_DEPTH {
            self.table = bracket == b"[";
        }
        writer.write_all(bracket)
    }
}

impl Formatter for Rows {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"[")
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.separate(writer, first)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b"{")
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.separate(writer, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
