//! Reading a layer from JSON, with errors that say where: line, column, field, nearest valid name.

use super::Layer;
use crate::{Error, Result, nearest, text};
use serde_json::Value;
use serde_json::value::RawValue;
use serde_path_to_error::{Path as FieldPath, Segment};
use std::collections::BTreeMap;
use std::path::Path;

/// Reads a layer of configuration from the JSON file at `path`.
pub(super) fn read(path: &Path) -> Result<Layer> {
    let bytes = std::fs::read(path)
        .map_err(|error| Error::file(path, format!("the configuration cannot be read: {error}")))?;
    let text = text::decode(&bytes).map_err(|message| Error::file(path, message))?;
    // Names in it may hold line breaks.
    parse(&text).map_err(|message| Error::file(path, message.replace(char::is_control, " ")))
}

/// Reads a layer of configuration from JSON; an error is `line L, column C: field: what is wrong`.
pub(super) fn parse(text: &str) -> Result<Layer, String> {
    let value: Value = serde_json::from_str(text).map_err(|error| positioned(&error, &message(&error)))?;
    if !value.is_object() {
        return Err("line 1, column 1: a configuration is one JSON object, { \"field\": value, ... }".into());
    }
    let mut json = serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let message = message(error.inner());
        let names_field = message.starts_with("unknown field") || error.path().iter().len() == 0;
        let described = if names_field { message } else { format!("{}: {message}", error.path()) };
        match locate(text, error.path(), names_field) {
            Some(offset) => at_offset(text, offset, &described),
            None => positioned(error.inner(), &described),
        }
    })
}

/// `message` with the position the parser stopped at.
fn positioned(error: &serde_json::Error, message: &str) -> String {
    format!("line {}, column {}: {message}", error.line(), error.column())
}

/// `message` with the line and column, both from 1, of a byte of `text`.
fn at_offset(text: &str, offset: usize, message: &str) -> String {
    let before = &text[..offset];
    let line = before.matches('\n').count() + 1;
    let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
    format!("line {line}, column {column}: {message}")
}

/// The parser's message without its position, in plainer words, with the nearest valid name.
fn message(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let text = text.rsplit_once(" at line ").map_or(text.as_str(), |(message, _)| message);
    if text.starts_with("unknown field") || text.starts_with("unknown variant") {
        // Every name in the message stands in backticks: first the wrong one, then the valid ones.
        let names: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
        if let [wrong, valid @ ..] = names.as_slice() {
            let kind = if text.starts_with("unknown field") { "field" } else { "value" };
            return format!("unknown {kind} `{wrong}`{}", nearest::hint(wrong, valid));
        }
    }
    if text == "expected value" {
        return "no JSON value starts here (JSON has neither NaN nor infinity)".into();
    }
    text.replace("expected u32", "expected a whole number from 0 to 4294967295")
        .replace("expected f32", "expected a number")
}

/// The byte offset of the value at `path`, or of its key; `None` where the path is empty or cannot be followed.
fn locate(text: &str, path: &FieldPath, key_itself: bool) -> Option<usize> {
    let mut value = text;
    let mut last_key = None;
    for segment in path.iter() {
        value = match segment {
            Segment::Seq { index } => {
                let items: Vec<&RawValue> = serde_json::from_str(value).ok()?;
                items.get(*index)?.get()
            }
            Segment::Map { key } => {
                let fields: BTreeMap<&str, &RawValue> = serde_json::from_str(value).ok()?;
                let (key, field) = fields.get_key_value(key.as_str())?;
                last_key = Some(*key);
                field.get()
            }
            Segment::Enum { .. } | Segment::Unknown => break,
        };
    }
    // Both are slices of `text`; the key's opening quote stands one before it.
    let offset = |part: &str| part.as_ptr() as usize - text.as_ptr() as usize;
    if key_itself { last_key.map(|key| offset(key) - 1) } else { Some(offset(value)) }
}
