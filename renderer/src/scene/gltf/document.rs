//! The document: its JSON, read object by object as they are reached, and the bytes of its buffers.
//!
//! What nothing that is drawn refers to is never looked at, so that it cannot refuse the file.

use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use gltf::json;
use json::extensions::scene::khr_lights_punctual::Light;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::super::source::SourceFiles;
use super::container;
use super::extensions;
use super::meshopt::{self, Compressed};
use super::uri::{self, Target};
use crate::{Error, Result, text};

/// A parsed file with the bytes of its buffers.
pub(super) struct Document {
    pub path: PathBuf,
    root: Map<String, Value>,
    /// By buffer; one that cannot be read says why to whoever needs it.
    buffers: Vec<Result<Vec<u8>, String>>,
    /// By buffer view: the bytes of those that are compressed, once they are asked for.
    decoded: Vec<OnceLock<Result<Vec<u8>, String>>>,
}

/// An object that others refer to by its place in an array.
pub(super) trait Object: DeserializeOwned {
    /// Path of that array from the root.
    const ARRAY: &'static [&'static str];
}

macro_rules! objects {
    ($($object:ty: $array:expr;)+) => { $(impl Object for $object { const ARRAY: &'static [&'static str] = &$array; })+ };
}

objects! {
    json::Accessor: ["accessors"];
    json::buffer::View: ["bufferViews"];
    json::Image: ["images"];
    json::Material: ["materials"];
    json::Mesh: ["meshes"];
    json::Node: ["nodes"];
    json::Skin: ["skins"];
    json::Texture: ["textures"];
    json::texture::Sampler: ["samplers"];
    Light: ["extensions", "KHR_lights_punctual", "lights"];
}

impl Document {
    /// Reads the file, checks version and required extensions, and reads the buffers.
    pub fn open(path: &Path, files: &mut SourceFiles) -> Result<Self> {
        let fail = |message: String| Error::file(path, message);
        let bytes = files.read(path)?;
        let (json, binary) = if container::is_glb(&bytes) {
            let chunks = container::chunks(&bytes).map_err(fail)?;
            (&bytes[chunks.json], chunks.binary.map(|range| &bytes[range]))
        } else {
            (&bytes[..], None)
        };
        let root = parse(json).map_err(fail)?;
        check_version(&root).map_err(fail)?;
        check_arrays(&root).map_err(fail)?;
        extensions::check_required(&root).map_err(fail)?;
        let mut document = Self { path: path.to_owned(), root, buffers: Vec::new(), decoded: Vec::new() };
        document.buffers = document.read_buffers(binary, files);
        document.decoded.resize_with(document.array(&["bufferViews"]).len(), OnceLock::new);
        Ok(document)
    }

    /// An error about this file.
    pub fn error(&self, message: impl Display) -> Error {
        Error::file(&self.path, message)
    }

    /// A field of the document itself.
    pub fn field(&self, name: &str) -> Option<&Value> {
        self.root.get(name)
    }

    /// How many objects of a kind there are.
    pub fn count<T: Object>(&self) -> usize {
        self.array(T::ARRAY).len()
    }

    /// What `index` refers to, as the file has it.
    pub fn value<T: Object>(&self, index: json::Index<T>) -> Result<&Value, String> {
        let (all, i) = (self.array(T::ARRAY), index.value());
        let name = T::ARRAY.join(".");
        all.get(i).ok_or_else(|| format!("refers to {name}[{i}], which is not there ({} are)", all.len()))
    }

    /// What `index` refers to.
    pub fn get<T: Object>(&self, index: json::Index<T>) -> Result<T, String> {
        T::deserialize(self.value(index)?).map_err(|e| {
            format!("refers to {}[{}], which is not valid: {e}", T::ARRAY.join("."), index.value())
        })
    }

    /// The bytes of a buffer view, decoded where it is compressed, and the stride it gives.
    pub fn view(&self, index: json::Index<json::buffer::View>) -> Result<(&[u8], Option<usize>), String> {
        let view = self.get(index)?;
        let name = |message: String| format!("lies in bufferViews[{}], which {message}", index.value());
        let stride = view.byte_stride.map(|stride| stride.0).filter(|&stride| stride > 0);
        let others = view.extensions.as_ref().map(|e| &e.others);
        let compressed =
            others.and_then(|others| meshopt::EXTENSIONS.iter().find_map(|name| others.get(*name)));
        let bytes = match compressed {
            Some(json) => self.decoded[index.value()].get_or_init(|| self.decode(json)).as_deref(),
            None => {
                let (offset, length) = (view.byte_offset.unwrap_or_default().0, view.byte_length.0);
                Ok(self.bytes(view.buffer.value(), offset, length).map_err(name)?)
            }
        };
        Ok((bytes.map_err(|message| name(message.clone()))?, stride))
    }

    /// Size in bytes of all buffers.
    pub fn buffer_bytes(&self) -> u64 {
        self.buffers.iter().flatten().map(|bytes| bytes.len() as u64).sum()
    }

    fn decode(&self, json: &Value) -> Result<Vec<u8>, String> {
        let compressed: Compressed = serde::Deserialize::deserialize(json)
            .map_err(|e| format!("is compressed, but how is not valid: {e}"))?;
        let bytes = self.bytes(compressed.buffer as usize, compressed.byte_offset, compressed.byte_length)?;
        compressed.decode(bytes)
    }

    fn bytes(&self, buffer: usize, offset: u64, length: u64) -> Result<&[u8], String> {
        let held = self.buffers.len();
        let bytes = self.buffers.get(buffer);
        let bytes =
            bytes.ok_or_else(|| format!("refers to buffers[{buffer}], which is not there ({held} are)"))?;
        let bytes = bytes.as_ref().map_err(|message| format!("needs buffers[{buffer}], which {message}"))?;
        slice(bytes, offset, length)
            .ok_or_else(|| format!("reaches beyond the {} bytes of buffers[{buffer}]", bytes.len()))
    }

    /// The array at a path; empty where it is not there.
    fn array(&self, path: &[&str]) -> &[Value] {
        let (first, rest) = path.split_first().expect("a path has parts");
        let found = rest.iter().try_fold(self.root.get(*first), |at, part| at.map(|value| value.get(part)));
        found.flatten().and_then(Value::as_array).map_or(&[], Vec::as_slice)
    }

    fn read_buffers(&self, binary: Option<&[u8]>, files: &mut SourceFiles) -> Vec<Result<Vec<u8>, String>> {
        let buffers = self.array(&["buffers"]).iter().enumerate();
        buffers.map(|(i, buffer)| self.read_buffer(buffer, binary.filter(|_| i == 0), files)).collect()
    }

    fn read_buffer(
        &self,
        json: &Value,
        binary: Option<&[u8]>,
        files: &mut SourceFiles,
    ) -> Result<Vec<u8>, String> {
        let bytes = match json.get("uri").and_then(Value::as_str) {
            None => binary.ok_or("has neither a uri nor a GLB chunk")?.to_vec(),
            Some(uri) => match uri::resolve(uri)? {
                Target::Data(bytes) => bytes,
                Target::File(file) => {
                    let read = files.read(&uri::beside(&self.path, &file));
                    read.map_err(|error| format!("is not there: {error}"))?
                }
            },
        };
        match json.get("byteLength").and_then(Value::as_u64) {
            Some(length) if length > bytes.len() as u64 => {
                Err(format!("is truncated: {} bytes of {length}", bytes.len()))
            }
            _ => Ok(bytes),
        }
    }
}

/// `length` bytes from `offset`, if they are there.
pub(super) fn slice(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(offset).ok()?;
    let end = usize::try_from(offset.checked_add(length)?).ok()?;
    bytes.get(start..end)
}

fn parse(json: &[u8]) -> Result<Map<String, Value>, String> {
    // Some writers pad the JSON of a GLB file with zeros, which decoding leaves out.
    let text = text::decode(json).map_err(|e| format!("is neither GLB nor valid JSON: {e}"))?;
    match serde_json::from_str(&text).map_err(|e| format!("is neither GLB nor valid JSON: {e}"))? {
        Value::Object(root) => Ok(root),
        _ => Err("is not glTF: its JSON is not an object".into()),
    }
}

/// Every array that objects lie in is one.
fn check_arrays(root: &Map<String, Value>) -> Result<(), String> {
    let arrays = [
        "accessors",
        "buffers",
        "bufferViews",
        "images",
        "materials",
        "meshes",
        "nodes",
        "samplers",
        "scenes",
        "skins",
        "textures",
    ];
    match arrays
        .iter()
        .find(|array| root.get(**array).is_some_and(|value| !value.is_array() && !value.is_null()))
    {
        Some(array) => Err(format!("is not valid glTF: {array} is not an array")),
        None => Ok(()),
    }
}

/// The version that the file says it is of, and the one that it needs (glTF 2.0, section 3.2).
fn check_version(root: &Map<String, Value>) -> Result<(), String> {
    let asset = root.get("asset");
    let field = |name: &str| asset.and_then(|asset| asset.get(name));
    let version = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    let Some(found) = field("version").map(version) else {
        // In glTF 1.0 the version was optional, and everything a map.
        let old = root.get("meshes").is_some_and(Value::is_object);
        let known = if old { "is glTF 1.0" } else { "has no asset.version, so it is not glTF 2.0" };
        return Err(format!("{known}; 2.0 is read"));
    };
    if found != "2" && !found.starts_with("2.") {
        return Err(format!("is glTF {found}; 2.0 is read"));
    }
    match field("minVersion").map(version) {
        Some(least) if least != "2" && least != "2.0" => Err(format!("needs glTF {least}; 2.0 is read")),
        _ => Ok(()),
    }
}
