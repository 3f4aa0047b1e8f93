//! Reading JSON so that every complaint names file, line, column and field.

use crate::{Error, Result, text};
use serde::de::{DeserializeOwned, DeserializeSeed, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::path::Path;

/// One part of the path from a JSON value into what it holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PathPart {
    /// A field of an object.
    Key(&'static str),
    /// An element of an array.
    Index(usize),
}

impl From<&'static str> for PathPart {
    fn from(key: &'static str) -> Self {
        Self::Key(key)
    }
}

impl From<usize> for PathPart {
    fn from(index: usize) -> Self {
        Self::Index(index)
    }
}

/// What is wrong with a value that is well-formed, and with which part of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Problem {
    /// From the whole value to the part.
    path: Vec<PathPart>,
    message: String,
}

impl Problem {
    /// A problem of the value itself.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self { path: Vec::new(), message: message.into() }
    }

    /// This problem, seen from the value that holds this one as `part`.
    pub(crate) fn under(mut self, part: impl Into<PathPart>) -> Self {
        self.path.insert(0, part.into());
        self
    }

    /// The message with line and column of the part in `text`, the JSON that was read.
    fn located(&self, text: &str) -> String {
        let mut deserializer = serde_json::Deserializer::from_str(text);
        match Locate(&self.path).deserialize(&mut deserializer) {
            // The parser stands before the part: the next column is its first.
            Err(error) if error.line() > 0 => {
                format!("line {}, column {}: {self}", error.line(), error.column() + 1)
            }
            _ => self.to_string(),
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (depth, part) in self.path.iter().enumerate() {
            match part {
                PathPart::Key(key) if depth == 0 => write!(f, "{key}")?,
                PathPart::Key(key) => write!(f, ".{key}")?,
                PathPart::Index(index) => write!(f, "[{index}]")?,
            }
        }
        if !self.path.is_empty() {
            f.write_str(": ")?;
        }
        f.write_str(&self.message)
    }
}

/// A value whose parts must fit together in ways that its types do not say.
pub(crate) trait Check {
    /// Finds the first part that is out of range or contradicts another.
    fn check(&self) -> Result<(), Problem>;
}

/// Reads a checked value from the JSON text of the file `path`.
///
/// # Errors
/// [`Error::File`] with line, column and field where the bytes are no text, the text is no JSON, does not have the
/// fields of `T`, or fails its [`Check`].
pub(crate) fn parse<T: DeserializeOwned + Check>(path: &Path, bytes: &[u8]) -> Result<T> {
    let text = text::decode(bytes).map_err(|message| Error::file(path, message))?;
    let mut deserializer = serde_json::Deserializer::from_str(&text);
    let value: T = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let field = Some(error.path().to_string()).filter(|field| field != ".");
        Error::file(path, describe(error.inner(), field.as_deref()))
    })?;
    deserializer.end().map_err(|error| Error::file(path, describe(&error, None)))?;
    value.check().map_err(|problem| Error::file(path, problem.located(&text)))?;
    Ok(value)
}

/// `line L, column C: field: what` on one line, from an error that says where at its end.
fn describe(error: &serde_json::Error, field: Option<&str>) -> String {
    let (line, column) = (error.line(), error.column());
    let full = error.to_string();
    let what = full.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&full);
    let message = match field {
        Some(field) => format!("line {line}, column {column}: {field}: {what}"),
        None => format!("line {line}, column {column}: {what}"),
    };
    // Keys and strings of the file may hold line breaks.
    message.replace(char::is_control, " ")
}

/// Walks a JSON text along a path and fails where it arrives: the parser adds line and column to the failure.
struct Locate<'p>(&'p [PathPart]);

impl<'de> DeserializeSeed<'de> for Locate<'_> {
    type Value = ();

    fn deserialize<D: serde::Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        if self.0.is_empty() {
            return Err(D::Error::custom("here"));
        }
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Locate<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object or an array on the way to the part")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            match self.0.first() {
                Some(PathPart::Key(wanted)) if key == *wanted => map.next_value_seed(Locate(&self.0[1..]))?,
                _ => drop(map.next_value::<IgnoredAny>()?),
            }
        }
        // A field that was left out and took its default: the object is the place.
        Err(A::Error::custom("here"))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        let Some(PathPart::Index(wanted)) = self.0.first() else {
            return Err(A::Error::custom("here"));
        };
        for _ in 0..*wanted {
            seq.next_element::<IgnoredAny>()?;
        }
        seq.next_element_seed(Locate(&self.0[1..]))?;
        Err(A::Error::custom("here"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Probe {
        rows: Vec<[f64; 2]>,
    }

    impl Check for Probe {
        fn check(&self) -> Result<(), Problem> {
            match self.rows.iter().position(|row| row[1] < 0.0) {
                Some(row) => Err(Problem::new("below zero").under(1).under(row).under("rows")),
                None => Ok(()),
            }
        }
    }

    fn message(text: &str) -> String {
        parse::<Probe>(Path::new("p.json"), text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn a_failed_check_names_line_column_and_field() {
        let text = "{\n  \"rows\": [\n    [1, 2],\n    [3,   -4]\n  ]\n}";
        assert_eq!(message(text), "p.json: line 4, column 11: rows[1][1]: below zero");
    }

    #[test]
    fn a_wrong_type_names_line_column_and_field() {
        assert_eq!(
            message("{\"rows\": [[1, 2],\n[3, \"x\"]]}"),
            "p.json: line 2, column 7: rows[1][1]: invalid type: string \"x\", expected f64"
        );
    }

    #[test]
    fn broken_text_and_unknown_fields_name_the_line() {
        assert!(message("{\"rows\": [[1, 2]").starts_with("p.json: line 1, column 16:"));
        assert!(message("{\"rows\": []}\n?").starts_with("p.json: line 2, column 1:"));
        let unknown = message("{\"rows\": [],\n\"row\": 1}");
        assert!(unknown.starts_with("p.json: line 2, column 5: row: unknown field `row`"), "{unknown}");
        assert!(message("{\"rows\": [[1e999, 0]]}").contains("number out of range"));
        assert_eq!(message("{\"r\\n\": 1}").lines().count(), 1);
    }
}
