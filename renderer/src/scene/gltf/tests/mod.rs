//! Files made on the spot.

mod broken;
mod compressed;
mod geometry;
mod lenient;
mod materials;
mod posed;

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use tempfile::TempDir;

use super::super::{Scene, Vertex, load};

pub const F32: u32 = 5126;
pub const U32: u32 = 5125;
pub const U16: u32 = 5123;
pub const I16: u32 = 5122;
pub const U8: u32 = 5121;
pub const I8: u32 = 5120;

/// A triangle in the z = 0 plane, facing +z.
pub const TRIANGLE: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

/// A document under construction: JSON and one buffer.
pub struct Asset {
    pub json: Value,
    pub bin: Vec<u8>,
}

impl Asset {
    /// One node with one mesh without primitives.
    pub fn new() -> Self {
        let json = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [] }],
            "accessors": [],
            "bufferViews": [],
            "buffers": []
        });
        Self { json, bin: Vec::new() }
    }

    /// One triangle with positions only.
    pub fn triangle() -> Self {
        let mut asset = Self::new();
        let position = asset.floats("VEC3", &TRIANGLE);
        asset.primitive(json!({ "attributes": { "POSITION": position } }));
        asset
    }

    /// Appends bytes, aligned; returns the buffer view.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len() });
        self.bin.extend(bytes);
        push(&mut self.json["bufferViews"], view)
    }

    /// An accessor of tightly packed components over new bytes.
    pub fn accessor(&mut self, kind: &str, component: u32, normalized: bool, bytes: &[u8]) -> usize {
        let lanes = match kind {
            "SCALAR" => 1,
            kind => kind[3..].parse().unwrap(),
        };
        let size = match component {
            U8 | I8 => 1,
            U16 | I16 => 2,
            _ => 4,
        };
        let view = self.view(bytes);
        let count = bytes.len() / (lanes * size);
        let accessor = json!({
            "bufferView": view, "componentType": component, "normalized": normalized, "count": count, "type": kind
        });
        push(&mut self.json["accessors"], accessor)
    }

    pub fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        self.accessor(kind, F32, false, bytemuck::cast_slice(values))
    }

    pub fn primitive(&mut self, primitive: Value) {
        push(&mut self.json["meshes"][0]["primitives"], primitive);
    }

    /// Adds an attribute to the first primitive.
    pub fn attribute(&mut self, name: &str, accessor: usize) {
        self.json["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
    }

    /// Gives the first primitive a material.
    pub fn material(&mut self, material: Value) {
        self.json["materials"] = json!([material]);
        self.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    }

    pub fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bin.len() }]);
        let chunk = |kind: &[u8; 4], bytes: Vec<u8>, filler: u8| {
            let mut bytes = bytes;
            bytes.resize(bytes.len().next_multiple_of(4), filler);
            [&(bytes.len() as u32).to_le_bytes(), kind.as_slice(), &bytes].concat()
        };
        let json = chunk(b"JSON", serde_json::to_vec(&json).unwrap(), b' ');
        let bin = chunk(b"BIN\0", self.bin.clone(), 0);
        let length = 12 + json.len() + bin.len();
        [b"glTF".as_slice(), &2_u32.to_le_bytes(), &(length as u32).to_le_bytes(), &json, &bin].concat()
    }

    pub fn load(&self) -> crate::Result<Scene> {
        let folder = Folder::new();
        load(&folder.write("scene.glb", self.glb()))
    }

    pub fn vertices(&self) -> Vec<Vertex> {
        self.load().unwrap().vertices
    }

    /// The message of the error that loading must end in: one line, naming the file.
    pub fn error(&self) -> String {
        message(self.load().unwrap_err(), "scene.glb")
    }
}

/// The text after the path of an error about `file`.
pub fn message(error: crate::Error, file: &str) -> String {
    assert_eq!(error.exit_code(), 2, "{error}");
    let text = error.to_string();
    assert!(!text.contains('\n'), "{text}");
    text.split_once(&format!("{file}: ")).expect(&text).1.to_owned()
}

fn push(array: &mut Value, element: Value) -> usize {
    let array = array.as_array_mut().unwrap();
    array.push(element);
    array.len() - 1
}

/// A temporary folder of files.
pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, bytes).unwrap();
        path
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }
}
