//! Nodes, attributes, topology, lights.

use glam::{Mat4, Quat, Vec3};
use serde_json::json;

use super::super::super::mesh::PLAIN_VERTEX;
use super::*;
use crate::lights::Spot;
use std::f32::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

fn quarter_turn() -> Quat {
    Quat::from_rotation_y(std::f32::consts::FRAC_PI_2)
}

#[test]
fn nested_transforms_multiply() {
    let mut asset = Asset::triangle();
    let matrix = Mat4::from_translation(Vec3::new(0.0, 5.0, 0.0)).to_cols_array();
    asset.json["nodes"] = json!([
        { "children": [1, 2], "translation": [1, 2, 3], "rotation": quarter_turn().to_array() },
        { "mesh": 0, "scale": [2, 2, 2], "children": [3] },
        { "matrix": matrix, "mesh": 0 },
        { "mesh": 0, "translation": [1, 0, 0] },
        { "mesh": 0, "name": "of no scene" },
    ]);
    let scene = asset.load().unwrap();
    let parent = Mat4::from_rotation_translation(quarter_turn(), Vec3::new(1.0, 2.0, 3.0));
    let scaled = parent * Mat4::from_scale(Vec3::splat(2.0));
    let expected = [
        scaled,
        scaled * Mat4::from_translation(Vec3::X),
        parent * Mat4::from_translation(Vec3::new(0.0, 5.0, 0.0)),
    ];
    assert_eq!(scene.primitives.len(), 1);
    assert_eq!(scene.instances.len(), 3);
    for (instance, expected) in scene.instances.iter().zip(expected) {
        assert!(instance.world_from_object.abs_diff_eq(expected.as_dmat4(), 1e-5), "{instance:?}");
    }
    assert_eq!(scene.triangle_count(), 3);
}

#[test]
fn without_a_default_scene_the_first_or_the_orphans_are_drawn() {
    let mut asset = Asset::triangle();
    asset.json["nodes"] = json!([{ "children": [1] }, { "mesh": 0 }, { "mesh": 0 }]);
    asset.json.as_object_mut().unwrap().remove("scene");
    assert_eq!(asset.load().unwrap().instances.len(), 1);
    asset.json.as_object_mut().unwrap().remove("scenes");
    assert_eq!(asset.load().unwrap().instances.len(), 2);
}

#[test]
fn mirrored_and_flattened_nodes() {
    let mut asset = Asset::triangle();
    asset.json["scenes"] = json!([{ "nodes": [0, 1, 2, 3, 4] }]);
    let scaled = |scale: [f64; 3]| json!({ "mesh": 0, "scale": scale });
    let scales = [[-1.0, 1.0, 1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 0.0], [0.0; 3], [1e-25, 1e-25, 1.0]];
    asset.json["nodes"] = json!(scales.map(scaled));
    let scene = asset.load().unwrap();
    let kept: Vec<_> = scene.instances.iter().map(|i| i.world_from_object.determinant()).collect();
    assert_eq!(kept, [-1.0, 0.0], "flat along one axis is still a surface");
    assert_eq!(scene.warnings, ["nodes scaled to nothing and left out: 3"]);
}

#[test]
fn quantized_attributes_become_floats() {
    let mut asset = Asset::new();
    asset.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let position: [i16; 9] = [0, 0, 0, 32767, 0, 0, 0, -32768, 0];
    let position = asset.accessor("VEC3", I16, true, bytemuck::cast_slice(&position));
    let normal = asset.accessor("VEC3", I8, true, bytemuck::cast_slice(&[0_i8, 0, 127].repeat(3)));
    let tangent =
        asset.accessor("VEC4", I16, true, bytemuck::cast_slice(&[0_i16, 32767, 0, -32767].repeat(3)));
    let uv = asset.accessor("VEC2", U16, false, bytemuck::cast_slice(&[0_u16, 1, 2, 3, 4, 5]));
    asset.primitive(json!({ "attributes": { "POSITION": position, "NORMAL": normal, "TANGENT": tangent } }));
    asset.attribute("TEXCOORD_0", uv);
    with_normal_map(&mut asset);
    let vertices = asset.vertices();
    let positions: Vec<_> = vertices.iter().map(|v| v.position).collect();
    assert_eq!(positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]);
    let uvs: Vec<_> = vertices.iter().map(|v| v.uv[0]).collect();
    assert_eq!(uvs, [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]]);
    for vertex in vertices {
        assert_eq!((vertex.normal, vertex.tangent), ([0.0, 0.0, 1.0], [0.0, 1.0, 0.0, -1.0]));
    }
}

#[test]
fn every_integer_position_type_is_read() {
    let cases: [(u32, bool, Vec<u8>, f32); 6] = [
        (I8, false, vec![0x80; 9], -128.0),
        (U8, false, vec![200; 9], 200.0),
        (U8, true, vec![51; 9], 0.2),
        (I8, true, vec![0x80; 9], -1.0),
        (U16, true, vec![0xff; 18], 1.0),
        (I16, false, vec![0xff; 18], -1.0),
    ];
    for (component, normalized, bytes, expected) in cases {
        let mut asset = Asset::new();
        let position = asset.accessor("VEC3", component, normalized, &bytes);
        asset.primitive(json!({ "attributes": { "POSITION": position } }));
        assert_eq!(asset.vertices()[1].position, [expected; 3], "{component} {normalized}");
    }
}

fn with_normal_map(asset: &mut Asset) {
    let png = crate::scene::image::tests::png([1, 1], [128, 128, 255, 255]);
    let view = asset.view(&png);
    asset.json["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }]);
    asset.json["textures"] = json!([{ "source": 0 }]);
    asset.material(json!({ "normalTexture": { "index": 0 } }));
}

#[test]
fn missing_normals_are_flat_and_missing_tangents_generated() {
    let mut asset = Asset::triangle();
    let uv = asset.floats("VEC2", &[0.0, 0.0, 0.0, 1.0, -1.0, 0.0]);
    let ignored = asset.floats("VEC4", &[0.0, 0.0, 1.0, 1.0].repeat(3));
    asset.attribute("TEXCOORD_0", uv);
    asset.attribute("TANGENT", ignored);
    with_normal_map(&mut asset);
    for vertex in asset.vertices() {
        assert_eq!(vertex.normal, [0.0, 0.0, 1.0]);
        // u falls along y; v, down the image, grows along x.
        assert_eq!(vertex.tangent, [0.0, -1.0, 0.0, -1.0]);
    }
}

#[test]
fn vertex_colors_of_every_type() {
    let words: Vec<u16> = [65535, 0, 32768, 65535].repeat(3);
    let cases: [(&str, u32, Vec<u8>, [u8; 4]); 5] = [
        ("VEC4", U8, [1, 2, 3, 4].repeat(3), [1, 2, 3, 4]),
        ("VEC3", U8, [1, 2, 3].repeat(3), [1, 2, 3, 255]),
        ("VEC4", U16, bytemuck::cast_slice(&words).to_vec(), [255, 0, 128, 255]),
        ("VEC4", F32, bytemuck::cast_slice(&[0.0_f32, 1.0, 0.5, 2.0].repeat(3)).to_vec(), [0, 255, 128, 255]),
        ("VEC3", F32, bytemuck::cast_slice(&[-1.0_f32, 1.0, 0.2].repeat(3)).to_vec(), [0, 255, 51, 255]),
    ];
    for (kind, component, bytes, expected) in cases {
        let mut asset = Asset::triangle();
        let color = asset.accessor(kind, component, component != F32, &bytes);
        asset.attribute("COLOR_0", color);
        assert!(asset.vertices().iter().all(|v| v.color == expected), "{kind} {component}");
    }
    assert_eq!(Asset::triangle().vertices()[0].color, PLAIN_VERTEX.color);
}

#[test]
fn sparse_accessors_replace_elements() {
    let mut asset = Asset::triangle();
    let indices = asset.view(&[2]);
    let values = asset.view(bytemuck::cast_slice(&[7.0_f32, 8.0, 9.0]));
    let sparse = json!({
        "count": 1,
        "indices": { "bufferView": indices, "componentType": U8 },
        "values": { "bufferView": values }
    });
    asset.json["accessors"][0]["sparse"] = sparse;
    let positions = |asset: &Asset| asset.vertices().iter().map(|v| v.position).collect::<Vec<_>>();
    assert_eq!(positions(&asset), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [7.0, 8.0, 9.0]]);
    asset.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert_eq!(positions(&asset), [[0.0; 3], [0.0; 3], [7.0, 8.0, 9.0]]);
}

#[test]
fn interleaved_vertices_and_shared_accessors() {
    let mut asset = Asset::new();
    // Position and normal interleaved; six vertices of which each primitive takes three.
    let vertices: Vec<f32> = (0..6).flat_map(|i| [i as f32, (i % 2) as f32, 0.0, 0.0, 0.0, 1.0]).collect();
    let view = asset.view(bytemuck::cast_slice(&vertices));
    asset.json["bufferViews"][view]["byteStride"] = json!(24);
    for offset in [0, 12] {
        let accessor = json!({ "bufferView": view, "byteOffset": offset, "componentType": F32, "count": 6, "type": "VEC3" });
        push(&mut asset.json["accessors"], accessor);
    }
    let low = asset.accessor("SCALAR", U8, false, &[0, 1, 2]);
    let high = asset.accessor("SCALAR", U16, false, bytemuck::cast_slice(&[5_u16, 4, 3]));
    for indices in [low, high] {
        asset.primitive(json!({ "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": indices }));
    }
    let scene = asset.load().unwrap();
    assert_eq!(scene.vertices.len(), 6, "no vertex twice");
    assert_eq!(scene.indices, [0, 1, 2, 2, 1, 0]);
    assert_eq!(scene.primitives[1].vertex_offset, 3);
    assert_eq!(scene.primitives[1].bounds.min, Vec3::new(3.0, 0.0, 0.0));
    assert!(scene.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]));
}

#[test]
fn strips_and_fans_become_lists_and_points_are_skipped() {
    let mut asset = Asset::new();
    let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
    let position = asset.floats("VEC3", &corners);
    for mode in [0, 1, 5, 6] {
        asset.primitive(json!({ "attributes": { "POSITION": position }, "mode": mode }));
    }
    let scene = asset.load().unwrap();
    let counts: Vec<_> = scene.primitives.iter().map(|p| p.index_count).collect();
    assert_eq!(counts, [6, 6]);
    assert!(scene.vertices[..6].iter().all(|v| v.normal == [0.0, 0.0, 1.0]), "the strip faces +z");
}

#[test]
fn point_and_spot_lights_are_placed_and_directional_ones_left_out() {
    let mut asset = Asset::triangle();
    asset.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    asset.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "directional" },
        { "type": "point", "color": [1.0, 0.5, 0.0], "intensity": 40.0, "range": 8.0 },
        { "type": "spot", "spot": {} },
        { "type": "point" },
        { "type": "spot", "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } },
    ] } });
    let lit = |light: u32| json!({ "KHR_lights_punctual": { "light": light } });
    asset.json["nodes"] = json!([
        { "mesh": 0, "translation": [1, 0, 0], "children": [1, 2, 3, 4, 5] },
        { "extensions": lit(0) },
        { "extensions": lit(1), "translation": [0, 2, 0], "scale": [9, 9, 9] },
        { "extensions": lit(2) },
        { "extensions": lit(3) },
        { "extensions": lit(4), "rotation": [0.0, FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2], "scale": [1, 1, 3] },
    ]);
    let lights = asset.load().unwrap().lights;
    let (lights, spots): (Vec<_>, Vec<_>) = lights.into_iter().partition(|light| light.spot.is_none());
    assert_eq!(lights.len(), 2);
    assert_eq!(lights[0].position, Vec3::new(1.0, 2.0, 0.0));
    assert_eq!((lights[0].color, lights[0].intensity, lights[0].range), ([1.0, 0.5, 0.0], 40.0, Some(8.0)));
    assert_eq!((lights[1].color, lights[1].intensity, lights[1].range), ([1.0; 3], 1.0, None));
    let cones: Vec<_> = spots.iter().filter_map(|light| light.spot).collect();
    assert_eq!(cones[0], Spot { direction: [0.0, 0.0, -1.0], inner: 0.0, outer: FRAC_PI_4 });
    assert_eq!((cones[1].inner, cones[1].outer, cones.len()), (0.25, 0.5, 2));
    assert!(Vec3::from(cones[1].direction).abs_diff_eq(-Vec3::X, 1e-6), "{cones:?}");
}

#[test]
fn files_and_data_uris_hold_the_same_scene() {
    let asset = Asset::triangle();
    let folder = Folder::new();
    let mut json = asset.json.clone();
    json["buffers"] = json!([{ "byteLength": asset.bin.len(), "uri": "a%20b/data.bin" }]);
    folder.write("a b/data.bin", &asset.bin);
    let file = load(&folder.write("scene.gltf", json.to_string())).unwrap();
    use base64::Engine;
    let data = base64::engine::general_purpose::STANDARD.encode(&asset.bin);
    json["buffers"][0]["uri"] = json!(format!("data:application/octet-stream;base64,{data}"));
    let inline = load(&folder.write("inline.gltf", json.to_string())).unwrap();
    assert_eq!(file.vertices, inline.vertices);
    assert_eq!(file.name, "scene");
    assert_ne!(file.sha256, inline.sha256);

    // The hash covers the buffer too, and nothing but content.
    let again = load(&folder.path().join("scene.gltf")).unwrap();
    assert_eq!(again, file);
    let mut changed = asset.bin.clone();
    changed[16] ^= 1;
    folder.write("a b/data.bin", &changed);
    assert_ne!(load(&folder.path().join("scene.gltf")).unwrap().sha256, file.sha256);
}
