//! Where shader text comes from, and the files one shader reaches through its includes.

use crate::{Error, Result};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// (path below `shaders-glsl/`, text), sorted by path.
type Embedded = &'static [(&'static str, &'static str)];

include!(concat!(env!("OUT_DIR"), "/embedded_shaders.rs"));

/// The sources in the binary, or a directory instead of them; and generated includes over both.
pub(super) struct Sources {
    directory: Option<PathBuf>,
    generated: BTreeMap<String, String>,
}

impl Sources {
    /// # Errors
    /// [`Error::File`] when `directory` is no directory.
    pub fn new(directory: Option<&Path>, generated: Vec<(String, String)>) -> Result<Self> {
        match directory {
            Some(path) if !path.is_dir() => Err(Error::file(path, "no such directory of shaders")),
            _ => Ok(Self {
                directory: directory.map(Path::to_owned),
                generated: generated.into_iter().collect(),
            }),
        }
    }

    /// Hex SHA-256 over the names and texts of all sources.
    ///
    /// # Errors
    /// [`Error::File`] when the directory cannot be read.
    pub fn sha256(&self) -> Result<String> {
        let mut files: BTreeMap<String, Vec<u8>> = match &self.directory {
            Some(directory) => {
                let mut files = BTreeMap::new();
                read_below(directory, "", &mut files)?;
                files
            }
            None => {
                EMBEDDED.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec())).collect()
            }
        };
        files.extend(self.generated.iter().map(|(name, text)| (name.clone(), text.clone().into_bytes())));
        let mut hash = Sha256::new();
        for (name, text) in &files {
            for part in [name.as_bytes(), text] {
                hash.update((part.len() as u64).to_le_bytes());
                hash.update(part);
            }
        }
        Ok(hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
    }

    /// The text of `name`, a normal path below the root; `None` when there is no such source.
    pub fn read(&self, name: &str) -> Result<Option<String>> {
        if let Some(text) = self.generated.get(name) {
            return Ok(Some(text.clone()));
        }
        let Some(directory) = &self.directory else {
            let found = EMBEDDED.binary_search_by_key(&name, |entry| entry.0);
            return Ok(found.ok().map(|index| EMBEDDED[index].1.to_owned()));
        };
        let path = directory.join(name);
        if !path.is_file() {
            return Ok(None);
        }
        let text = std::fs::read_to_string(&path).map_err(|error| Error::file(&path, error))?;
        if text.contains('\0') {
            return Err(Error::file(&path, "a zero byte in a shader"));
        }
        Ok(Some(text))
    }

    /// An error about line `line` of `name`, with the path that the user can open: what was read from a directory is
    /// the user's to mend, what is embedded is a fault of the program.
    pub fn error(&self, name: &str, line: u32, message: &str) -> Error {
        match &self.directory {
            Some(directory) if !self.generated.contains_key(name) => {
                Error::Input(format!("{}:{line}: {message}", directory.join(name).display()))
            }
            Some(_) => Error::Input(format!("{name}:{line}: {message}")),
            None => Error::Internal(format!("shader {name}:{line}: {message}")),
        }
    }

    /// The file that `#include "header"` in `includer` means: below the root, else beside the includer.
    fn resolve(&self, header: &str, includer: &str) -> Result<Option<(String, String)>> {
        let folder = includer.rsplit_once('/').map_or("", |(folder, _)| folder);
        for candidate in [normal(header), normal(&format!("{folder}/{header}"))].into_iter().flatten() {
            if let Some(text) = self.read(&candidate)? {
                return Ok(Some((candidate, text)));
            }
        }
        Ok(None)
    }

    /// All files that `root` can reach through includes, whether or not a condition later leaves some out. `$NAME` in a
    /// header stands for the value of that define.
    ///
    /// # Errors
    /// When `root` does not exist or a file cannot be read; a missing include is left for the compiler to report.
    pub fn closure(&self, root: &str, defines: &BTreeMap<&str, &str>) -> Result<Closure> {
        let text = self.read(root)?.ok_or_else(|| self.missing(root))?;
        let mut files = BTreeMap::new();
        let mut pending = vec![(root.to_owned(), text)];
        while let Some((name, text)) = pending.pop() {
            let mut includes = Vec::new();
            for (line, header) in include_lines(&text) {
                let Some((target, target_text)) = self.resolve(&named(header, defines), &name)? else {
                    continue;
                };
                includes.push(Include { line, header: header.to_owned(), target: target.clone() });
                if target != name && !files.contains_key(&target) {
                    pending.push((target, target_text));
                }
            }
            files.insert(name, SourceFile { text, includes });
        }
        Ok(Closure { root: root.to_owned(), files })
    }

    fn missing(&self, root: &str) -> Error {
        match &self.directory {
            Some(directory) => Error::file(directory.join(root), "no such shader"),
            None => Error::Internal(format!("shader {root} is not embedded in the program")),
        }
    }
}

/// A header with the values of the defines that it names.
fn named(header: &str, defines: &BTreeMap<&str, &str>) -> String {
    let put_in = |text: String, (name, value): (&&str, &&str)| text.replace(&format!("${name}"), value);
    // The longest name first, for one may begin another.
    defines.iter().rev().fold(header.to_owned(), put_in)
}

/// Reads every file below a directory, by its path with slashes.
fn read_below(directory: &Path, prefix: &str, files: &mut BTreeMap<String, Vec<u8>>) -> Result<()> {
    let failed = |error| Error::file(directory, error);
    for entry in std::fs::read_dir(directory).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let (path, name) = (entry.path(), format!("{prefix}{}", entry.file_name().to_string_lossy()));
        if path.is_dir() {
            read_below(&path, &format!("{name}/"), files)?;
        } else {
            let text = std::fs::read(&path).map_err(|error| Error::file(&path, error))?;
            files.insert(name, text);
        }
    }
    Ok(())
}

/// One shader with all files it can include, by normal path: what the compiler sees, and nothing else.
pub(super) struct Closure {
    pub root: String,
    pub files: BTreeMap<String, SourceFile>,
}

pub(super) struct SourceFile {
    pub text: String,
    pub includes: Vec<Include>,
}

/// An `#include` line whose target exists.
pub(super) struct Include {
    /// Line of the directive, from 1.
    pub line: u32,
    /// Name of the header as written.
    pub header: String,
    /// Normal path of the file that is included.
    pub target: String,
}

impl Closure {
    /// The include of `header` in `includer`.
    pub fn include(&self, header: &str, includer: &str) -> Option<&Include> {
        self.files.get(includer)?.includes.iter().find(|include| include.header == header)
    }
}

impl SourceFile {
    /// Whether a line `#pragma once` asks that the file be included once only.
    pub fn once(&self) -> bool {
        self.text.lines().any(is_pragma_once)
    }

    /// The text with `#pragma once`, which GLSL does not know, blanked.
    pub fn without_pragma_once(&self) -> String {
        blank_lines(&self.text, is_pragma_once)
    }
}

/// `text` with the lines that `unwanted` picks emptied, so that the others keep their numbers.
pub(super) fn blank_lines(text: &str, unwanted: impl Fn(&str) -> bool) -> String {
    let keep = |line| if unwanted(line) { "" } else { line };
    text.lines().flat_map(|line| [keep(line), "\n"]).collect()
}

/// The words after `#name` in `line`, if it is that directive.
pub(super) fn directive<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let rest = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix(name)?;
    (!rest.starts_with(|c: char| c.is_alphanumeric() || c == '_')).then(|| rest.trim())
}

fn is_pragma_once(line: &str) -> bool {
    directive(line, "pragma").is_some_and(|words| words.split_whitespace().next() == Some("once"))
}

/// (line number from 1, header) of every include directive.
fn include_lines(text: &str) -> impl Iterator<Item = (u32, &str)> {
    let header = |line| {
        let quoted = directive(line, "include")?;
        let (open, rest) = (quoted.chars().next()?, quoted.get(1..)?);
        let close = if open == '<' { '>' } else { '"' };
        (open == '"' || open == '<').then(|| rest.split(close).next()).flatten()
    };
    (1..).zip(text.lines()).filter_map(move |(number, line)| Some((number, header(line)?)))
}

/// `path` without `.`, `..` and doubled slashes; `None` when it leaves the root.
fn normal(path: &str) -> Option<String> {
    let mut parts = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_normal_and_stay_below_the_root() {
        assert_eq!(normal("a//b/./../c.glsl").as_deref(), Some("a/c.glsl"));
        assert_eq!(normal("../secret"), None);
        assert_eq!(normal("/lib/scan.glsl").as_deref(), Some("lib/scan.glsl"));
    }

    #[test]
    fn a_header_may_name_a_define() {
        let defines = BTreeMap::from([("LOOK", "x"), ("LOOKUP", "clustered")]);
        assert_eq!(named("lookup/$LOOKUP.glsl", &defines), "lookup/clustered.glsl");
        assert_eq!(named("lib/scan.glsl", &defines), "lib/scan.glsl");
    }

    #[test]
    fn includes_are_found_however_they_are_spaced() {
        let text = "#include \"a.glsl\"\n  #  include <b/c.glsl> // why\n#includes \"no\"\nint x; // #include \"no\"\n";
        assert_eq!(include_lines(text).collect::<Vec<_>>(), [(1, "a.glsl"), (2, "b/c.glsl")]);
    }

    #[test]
    fn the_embedded_table_is_sorted_for_the_search() {
        assert!(EMBEDDED.is_sorted());
    }
}
