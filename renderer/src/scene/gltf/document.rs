//! The container: GLB chunks, JSON, extensions, buffers.

use std::fmt::Display;
use std::ops::Range;
use std::path::{Path, PathBuf};

use gltf::json;

use super::super::source::SourceFiles;
use super::uri::{self, Target};
use crate::{Error, Result, text};

/// Extensions that a file may require.
const SUPPORTED: [&str; 4] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// A parsed file with the bytes of its buffers. Indices within `root` are not yet trusted.
pub(super) struct Document {
    pub path: PathBuf,
    pub root: json::Root,
    buffers: Vec<Vec<u8>>,
}

impl Document {
    /// Reads the file, checks version and required extensions, and reads the buffers.
    pub fn open(path: &Path, files: &mut SourceFiles) -> Result<Self> {
        let fail = |message: String| Error::file(path, message);
        let mut bytes = files.read(path)?;
        let (json, binary) = if bytes.starts_with(b"glTF") {
            let chunks = glb_chunks(&bytes).map_err(fail)?;
            let binary = chunks.binary.map(|range| {
                bytes.truncate(range.end);
                bytes.split_off(range.start)
            });
            (&bytes[chunks.json], binary)
        } else {
            (&bytes[..], None)
        };
        let text = text::decode(json).map_err(fail)?;
        let root = json::Root::from_str(&text).map_err(|e| fail(format!("is not valid glTF: {e}")))?;
        check_version(&root).map_err(fail)?;
        note_ignored(&root, path);
        let mut document = Self { path: path.to_owned(), root, buffers: Vec::new() };
        document.buffers = document.read_buffers(binary, files)?;
        Ok(document)
    }

    /// An error about this file.
    pub fn error(&self, message: impl Display) -> Error {
        Error::file(&self.path, message)
    }

    /// What `index` points to in `all`; `field` is the name of that array.
    pub fn get<'a, T>(&self, all: &'a [T], field: &str, index: json::Index<T>) -> Result<&'a T, String> {
        let i = index.value();
        all.get(i).ok_or_else(|| format!("refers to {field}[{i}], which is not there ({} are)", all.len()))
    }

    /// The bytes of a buffer view, and the stride it gives.
    pub fn view(&self, index: json::Index<json::buffer::View>) -> Result<(&[u8], Option<usize>), String> {
        let view = self.get(&self.root.buffer_views, "bufferViews", index)?;
        let buffer = self.get(&self.buffers, "buffers", json::Index::new(view.buffer.value() as u32))?;
        let bytes =
            slice(buffer, view.byte_offset.unwrap_or_default().0, view.byte_length.0).ok_or_else(|| {
                let (view, buffer_index) = (index.value(), view.buffer.value());
                let length = buffer.len();
                format!("bufferViews[{view}] reaches beyond the {length} bytes of buffers[{buffer_index}]")
            })?;
        Ok((bytes, view.byte_stride.map(|stride| stride.0).filter(|&stride| stride > 0)))
    }

    fn read_buffers(&self, mut binary: Option<Vec<u8>>, files: &mut SourceFiles) -> Result<Vec<Vec<u8>>> {
        let mut buffers = Vec::with_capacity(self.root.buffers.len());
        for (i, buffer) in self.root.buffers.iter().enumerate() {
            let fail = |message: &dyn Display| self.error(format!("buffers[{i}] {message}"));
            let bytes = match &buffer.uri {
                None if i == 0 => binary.take().ok_or_else(|| fail(&"has neither a uri nor a GLB chunk"))?,
                None => return Err(fail(&"has no uri")),
                Some(uri) => match uri::resolve(uri).map_err(|e| fail(&e))? {
                    Target::Data(bytes) => bytes,
                    Target::File(file) => files.read(&uri::beside(&self.path, &file))?,
                },
            };
            if (bytes.len() as u64) < buffer.byte_length.0 {
                let (held, declared) = (bytes.len(), buffer.byte_length.0);
                return Err(fail(&format!("is truncated: {held} bytes of {declared}")));
            }
            buffers.push(bytes);
        }
        Ok(buffers)
    }
}

/// `length` bytes from `offset`, if they are there.
pub(super) fn slice(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(offset).ok()?;
    let end = usize::try_from(offset.checked_add(length)?).ok()?;
    bytes.get(start..end)
}

fn check_version(root: &json::Root) -> Result<(), String> {
    let version = &root.asset.version;
    if !version.starts_with("2.") {
        return Err(format!("is glTF {version}; 2.0 is read"));
    }
    let unknown: Vec<_> = root
        .extensions_required
        .iter()
        .map(String::as_str)
        .filter(|name| !SUPPORTED.contains(name))
        .collect();
    match unknown.as_slice() {
        [] => Ok(()),
        names => Err(format!("requires {}, which is not supported; export without", names.join(", "))),
    }
}

fn note_ignored(root: &json::Root, path: &Path) {
    let ignored = root.extensions_used.iter().map(String::as_str).filter(|name| !SUPPORTED.contains(name));
    let ignored: Vec<_> = ignored.collect();
    if !ignored.is_empty() {
        tracing::info!("{}: drawn without {}", path.display(), ignored.join(", "));
    }
}

struct Chunks {
    json: Range<usize>,
    binary: Option<Range<usize>>,
}

/// Finds the chunks of a GLB file (glTF 2.0, section 4.4).
fn glb_chunks(bytes: &[u8]) -> Result<Chunks, String> {
    let word = |at: usize| -> Result<u32, String> {
        let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok());
        word.map(u32::from_le_bytes)
            .ok_or_else(|| format!("is truncated: its GLB header ends at byte {}", bytes.len()))
    };
    let (version, length) = (word(4)?, word(8)? as usize);
    if version != 2 {
        return Err(format!("is GLB version {version}; 2 is read"));
    }
    if length > bytes.len() {
        return Err(format!("is truncated: {} bytes of {length}", bytes.len()));
    }
    let chunk = |at: usize, what: &str| -> Result<(u32, Range<usize>), String> {
        let size = word(at)? as usize;
        let range = at + 8..at + 8 + size;
        if range.end > length {
            return Err(format!("is corrupt: its {what} chunk reaches beyond the end"));
        }
        Ok((word(at + 4)?, range))
    };
    let (kind, json) = chunk(12, "JSON")?;
    if kind != u32::from_le_bytes(*b"JSON") {
        return Err("is corrupt: its first GLB chunk is not JSON".into());
    }
    let second = json.end.next_multiple_of(4);
    let binary = if second + 8 <= length { Some(chunk(second, "binary")?) } else { None };
    let binary = binary.filter(|(kind, _)| *kind == u32::from_le_bytes(*b"BIN\0")).map(|(_, range)| range);
    Ok(Chunks { json, binary })
}
