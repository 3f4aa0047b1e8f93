//! Small scenes and recordings that tests write for themselves.

use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// Four corners, counter-clockwise seen from the front, metres.
pub type Quad = [[f32; 3]; 4];

/// Writes a glTF of white, rough, two-sided quads that stand at `away` (metres), with point lights (place beside `away`,
/// candela).
///
/// # Panics
/// Where it cannot be written.
pub fn write_quads(path: &Path, quads: &[Quad], away: [f64; 3], lights: &[([f64; 3], f64)]) {
    let corners: Vec<f32> = quads.iter().flatten().flatten().copied().collect();
    let indices: Vec<u32> =
        (0..quads.len() as u32).flat_map(|q| [0, 1, 2, 0, 2, 3].map(|i| 4 * q + i)).collect();
    let bytes: Vec<u8> = corners
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .chain(indices.iter().flat_map(|index| index.to_le_bytes()))
        .collect();
    let buffer = path.with_extension("bin");
    std::fs::write(&buffer, &bytes).unwrap();
    let bound = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
        (0..3).map(|axis| corners.iter().skip(axis).step_by(3).copied().reduce(pick).unwrap()).collect()
    };
    let light_node = |(number, (place, _)): (usize, &([f64; 3], f64))| json!({ "translation": place, "extensions": { "KHR_lights_punctual": { "light": number } } });
    let mut nodes =
        vec![json!({ "translation": away, "children": (1..lights.len() + 2).collect::<Vec<_>>() })];
    nodes.push(json!({ "mesh": 0 }));
    nodes.extend(lights.iter().enumerate().map(light_node));
    let mut gltf = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": nodes,
        "materials": [{ "doubleSided": true, "pbrMetallicRoughness": { "metallicFactor": 0.0 } }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": corners.len() / 3, "type": "VEC3",
              "min": bound(f32::min), "max": bound(f32::max) },
            { "bufferView": 1, "componentType": 5125, "count": indices.len(), "type": "SCALAR" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 4 * corners.len() },
            { "buffer": 0, "byteOffset": 4 * corners.len(), "byteLength": 4 * indices.len() }
        ],
        "buffers": [{ "byteLength": bytes.len(), "uri": buffer.file_name().unwrap().to_str() }]
    });
    if !lights.is_empty() {
        let of = |&(_, candela): &([f64; 3], f64)| json!({ "type": "point", "intensity": candela });
        gltf["extensionsUsed"] = json!(["KHR_lights_punctual"]);
        gltf["extensions"] =
            json!({ "KHR_lights_punctual": { "lights": lights.iter().map(of).collect::<Vec<_>>() } });
    }
    std::fs::write(path, gltf.to_string()).unwrap();
}

/// The recording of one frame from `head` (position, quaternion, field of view), with rain in a box, seen by `eyes` (rows
/// as recordings have them) or, without any, by one view.
pub fn recording(
    [near, far]: [f64; 2],
    head: [f64; 8],
    rain_box: [[f64; 3]; 2],
    eyes: &[[f64; 11]],
) -> Value {
    let mut recording = json!({
        "format": "manylight.recording/1", "source": { "text": "a test" }, "dt_s": 0.0625, "near": near, "far": far,
        "rain": {
            "seed": 1, "box_min": rain_box[0], "box_max": rain_box[1], "velocity_min": [-1, -4, -1],
            "velocity_max": [1, -2, 1], "tint": [0.5, 1], "gravity_step": [0, 0, 0], "damping": 1, "respawn_slab": 0.5
        },
        "frames": [head]
    });
    if !eyes.is_empty() {
        let eye = |(number, row): (usize, &[f64; 11])| json!({ "name": format!("e{number}"), "rows": [row] });
        recording["hmd"] =
            json!({ "name": "eyes", "eyes": eyes.iter().enumerate().map(eye).collect::<Vec<_>>() });
    }
    recording
}

/// Writes a glTF whose nodes, which `nodes` says in JSON, are instances of mesh 0: a white, rough, two-sided cube from -1 to 1
/// metre. `roots` are those that no other node has as a child.
///
/// # Panics
/// Where it cannot be written.
pub fn write_cubes(path: &Path, nodes: &[Value], roots: &[usize]) {
    let corner = |corner: u32| [0, 1, 2].map(|axis| if corner >> axis & 1 == 1 { 1.0f32 } else { -1.0 });
    let corners = (0..8).flat_map(corner).flat_map(f32::to_le_bytes);
    let faces: [[u16; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [a, b, c, a, c, d]);
    let bytes: Vec<u8> = corners.chain(triangles.flat_map(u16::to_le_bytes)).collect();
    let buffer = path.with_extension("bin");
    std::fs::write(&buffer, &bytes).unwrap();
    let gltf = json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": roots }],
        "nodes": nodes,
        "materials": [{ "doubleSided": true, "pbrMetallicRoughness": { "metallicFactor": 0.0 } }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1] },
            { "bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 96 },
            { "buffer": 0, "byteOffset": 96, "byteLength": 72 }
        ],
        "buffers": [{ "byteLength": bytes.len(), "uri": buffer.file_name().unwrap().to_str() }]
    });
    std::fs::write(path, gltf.to_string()).unwrap();
}

/// Writes a lights file of lights without any order in a box, whose intensity grows in `levels` steps from one to the next, up
/// to `most`.
///
/// # Panics
/// Where it cannot be written.
pub fn write_lights(path: &Path, count: u32, [low, high]: [[f64; 3]; 2], (levels, most): (u32, f64)) {
    let part = |k: u32, step: u32| f64::from(k.wrapping_mul(step) >> 16 & 1023) / 1024.0;
    let mut text = String::from("x,y,z,r,g,b,i,i0,r0\n");
    for k in 1..=count {
        let steps = [2_654_435_761, 2_246_822_519, 3_266_489_917];
        let [x, y, z] = [0, 1, 2].map(|axis| low[axis] + (high[axis] - low[axis]) * part(k, steps[axis]));
        let intensity = most * f64::from(k % levels + 1) / f64::from(levels);
        writeln!(text, "{x},{y},{z},1,0.9,0.8,{intensity},0.5,0.01").unwrap();
    }
    std::fs::write(path, text).unwrap();
}
