//! Files that must be refused in one line, and never with a panic.

use proptest::prelude::*;
use serde_json::{Value, json};

use super::super::super::image::tests::png;
use super::*;

/// Positions, indices, normals, coordinates, colours, a sparse accessor, images, lights and two nodes.
fn everything() -> Asset {
    let mut asset = Asset::triangle();
    let floats: [(&str, &str, &[f32]); 4] = [
        ("NORMAL", "VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]),
        ("TEXCOORD_0", "VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]),
        ("COLOR_0", "VEC3", &TRIANGLE),
        ("TANGENT", "VEC4", &[1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0]),
    ];
    for (name, kind, values) in floats {
        let accessor = asset.floats(kind, values);
        asset.attribute(name, accessor);
    }
    let indices = asset.accessor("SCALAR", U32, false, bytemuck::cast_slice(&[0_u32, 1, 2]));
    asset.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    let (places, values) = (asset.view(&[1, 0]), asset.view(bytemuck::cast_slice(&[2.0_f32, 0.0, 0.0])));
    asset.json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": places, "componentType": U16 },
        "values": { "bufferView": values }
    });
    let view = asset.view(&png([3, 2], [9, 9, 9, 9]));
    asset.json["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }]);
    asset.json["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    asset.json["samplers"] = json!([{}]);
    asset.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point" }] } });
    asset.json["nodes"] =
        json!([{ "mesh": 0, "children": [1] }, { "extensions": { "KHR_lights_punctual": { "light": 0 } } }]);
    asset.material(json!({ "normalTexture": { "index": 0 }, "emissiveTexture": { "index": 0 }, "emissiveFactor": [9, 9, 9] }));
    asset
}

#[test]
fn everything_loads() {
    let scene = everything().load().unwrap();
    assert_eq!((scene.lights.len(), scene.images.len(), scene.vertices[1].position[0]), (1, 2, 2.0));
}

#[test]
fn errors_name_the_object() {
    let cases: &[(&str, Value, &str)] = &[
        ("/asset/version", json!("1.0"), "is glTF 1.0; 2.0 is read"),
        (
            "/extensionsRequired",
            json!(["KHR_mesh_quantization", "KHR_draco_mesh_compression", "VENDOR_glow"]),
            "requires KHR_draco_mesh_compression, VENDOR_glow, which is not supported",
        ),
        ("/scene", json!(7), "refers to scenes[7], which is not there (1 are)"),
        ("/scenes/0/nodes", json!([9]), "the scene refers to nodes[9]"),
        ("/scenes/0/nodes", json!([]), "has no triangle to draw"),
        ("/nodes/0/mesh", json!(3), "nodes[0] refers to meshes[3]"),
        ("/nodes/1/children", json!([0]), "nodes[0] has two parents, or is its own ancestor"),
        ("/nodes/0/scale", json!([1e39, 1, 1]), "nodes[0] has a transform that is not finite"),
        ("/nodes/0/scale", json!([3e38, 1, 1]), "reaches beyond what 32-bit floating point holds"),
        ("/nodes/0/matrix", json!([1.0_f32; 16].as_slice()), "nodes[0] has a matrix that is not affine"),
        ("/nodes/0/rotation", json!([0, 0, 0, 0]), "nodes[0] has a rotation that is not a quaternion"),
        (
            "/nodes/1/extensions/KHR_lights_punctual/light",
            json!(5),
            "nodes[1] refers to extensions.KHR_lights_punctual.lights[5]",
        ),
        ("/meshes/0/primitives/0/material", json!(1), "meshes[0].primitives[0] refers to materials[1]"),
        ("/meshes/0/primitives/0/attributes", json!({}), "has no triangle to draw"),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(99),
            "meshes[0].primitives[0] refers to accessors[99]",
        ),
        ("/meshes/0/primitives/0/indices", json!(0), "indices: accessors[0] has 3 components"),
        (
            "/meshes/0/primitives/0/attributes/NORMAL",
            json!(2),
            "accessors[2] has 2 components an element instead of 3",
        ),
        ("/accessors/1/count", json!(2), "accessors[1] has 2 elements; POSITION has 3"),
        (
            "/accessors/0/count",
            json!(4),
            "POSITION: accessors[0] reaches beyond the 36 bytes of its buffer view",
        ),
        ("/accessors/0/count", json!(u64::MAX), "POSITION: accessors[0] reaches beyond"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "POSITION: accessors[0] reaches beyond"),
        ("/accessors/0/componentType", json!(5130), "POSITION: accessors[0] has an unknown component type"),
        ("/accessors/0/type", json!("VEC5"), "POSITION: accessors[0] has an unknown type"),
        ("/accessors/0/bufferView", json!(88), "accessors[0] refers to bufferViews[88]"),
        ("/accessors/0/sparse/count", json!(2), "accessors[0] (sparse) reaches beyond"),
        ("/accessors/5/count", json!(2), "has 2 indices, which do not make whole triangles"),
        (
            "/bufferViews/0/byteLength",
            json!(1_u64 << 40),
            "accessors[0] lies in bufferViews[0], which reaches beyond the",
        ),
        ("/bufferViews/0/buffer", json!(4), "refers to buffers[4]"),
        ("/materials/0/alphaMode", json!("GLOW"), "materials[0] has an unknown alphaMode"),
        ("/materials/0/emissiveTexture/index", json!(6), "materials[0] refers to textures[6]"),
        (
            "/materials/0/extensions",
            json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 3e38 } }),
            "material 0 (material 0) has a number that is not finite",
        ),
        ("/textures/0/source", json!(6), "materials[0] refers to images[6]"),
        ("/textures/0/sampler", json!(6), "materials[0] refers to samplers[6]"),
        ("/images/0", json!({}), "images[0] has neither a uri nor a bufferView"),
        (
            "/images/0",
            json!({ "bufferView": 0 }),
            "image images[0]: is none of PNG, JPEG, WebP, TGA, BMP, DDS and KTX2",
        ),
        ("/nodes", json!("no"), "is not valid glTF: nodes is not an array"),
        ("/nodes/0", json!("no"), "the scene refers to nodes[0], which is not valid: invalid type: string"),
        (
            "/accessors/0",
            json!({ "bufferView": 0 }),
            "accessors[0], which is not valid: missing field `count`",
        ),
    ];
    for (pointer, value, expected) in cases {
        let mut asset = everything();
        set(&mut asset.json, pointer, value.clone());
        let error = asset.error();
        assert!(error.contains(expected), "{pointer}: {error}");
    }
}

/// Sets the value at a JSON pointer, whose last part may be new.
fn set(json: &mut Value, pointer: &str, value: Value) {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match json.pointer_mut(parent).unwrap() {
        Value::Array(array) => array[key.parse::<usize>().unwrap()] = value,
        object => object[key] = value,
    }
}

#[test]
fn indices_and_positions_are_checked() {
    let mut asset = everything();
    let at =
        |asset: &Asset, view: usize| asset.json["bufferViews"][view]["byteOffset"].as_u64().unwrap() as usize;
    let index = at(&asset, 5);
    asset.bin[index] = 3;
    assert!(asset.error().contains("indices: use vertex 3 of 3"), "{}", asset.error());

    for bad in [f32::NAN, f32::INFINITY] {
        let mut asset = Asset::triangle();
        asset.bin[16..20].copy_from_slice(&bad.to_le_bytes());
        assert_eq!(asset.error(), "meshes[0].primitives[0] (): POSITION of vertex 1 is not finite");
    }

    let mut asset = everything();
    let place = at(&asset, 6);
    asset.bin[place] = 3;
    assert!(asset.error().contains("accessors[0] (sparse) replaces element 3 of 3"), "{}", asset.error());
}

#[test]
fn containers_are_checked() {
    let asset = Asset::triangle();
    let folder = Folder::new();
    let refused = |name: &str, bytes: &[u8]| message(load(&folder.write(name, bytes)).unwrap_err(), name);

    let glb = asset.glb();
    assert_eq!(refused("a.glb", &glb[..10]), "is truncated: its GLB header ends at byte 10");
    let cut = refused("a.glb", &glb[..glb.len() - 4]);
    assert_eq!(cut, format!("is truncated: {} bytes of {}", glb.len() - 4, glb.len()));
    let mut other = glb.clone();
    other[4] = 1;
    assert_eq!(refused("a.glb", &other), "is GLB version 1; 2 is read: export as glTF 2.0");
    other = glb.clone();
    other[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(refused("a.glb", &other), format!("is truncated: {} bytes of 4294967315", glb.len()));
    for bad in [b"{".as_slice(), b"", b"\x1f\x8b\x08"] {
        assert!(refused("a.gltf", bad).starts_with("is neither GLB nor valid JSON: "));
    }
    assert_eq!(refused("a.gltf", b"[]"), "is not glTF: its JSON is not an object");

    let mut json = asset.json.clone();
    json["buffers"] = json!([{ "byteLength": asset.bin.len(), "uri": "data.bin" }]);
    folder.write("data.bin", &asset.bin[..20]);
    let needed = "meshes[0].primitives[0] (): POSITION: accessors[0] lies in bufferViews[0], which needs buffers[0], which ";
    let truncated = format!("{needed}is truncated: 20 bytes of 36");
    assert_eq!(refused("a.gltf", json.to_string().as_bytes()), truncated);
    json["buffers"][0]["uri"] = json!("gone.bin");
    folder.write("a.gltf", json.to_string());
    let gone = load(&folder.path().join("a.gltf")).unwrap_err();
    assert!(message(gone, "gone.bin").starts_with("cannot be read: "));
    json["buffers"][0].as_object_mut().unwrap().remove("uri");
    let nowhere = format!("{needed}has neither a uri nor a GLB chunk");
    assert_eq!(refused("a.gltf", json.to_string().as_bytes()), nowhere);

    let missing = load(&folder.path().join("missing.glb")).unwrap_err();
    assert!(message(missing, "missing.glb").starts_with("cannot be read: "));
    assert_eq!(refused("scene.fbx", b""), "is not a scene: give a .gltf, .glb or .obj file");
}

/// Files of every kind of geometry.
const ASSETS: [fn() -> Asset; 5] =
    [everything, posed::morphed, posed::skinned, instanced, compressed::compressed];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Bytes flipped anywhere, then cut anywhere: loading ends in a valid scene or one line.
    #[test]
    fn damaged_files_never_panic(
        which in 0..5_usize,
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
        fix_length in any::<bool>(),
    ) {
        let mut glb = ASSETS[which]().glb();
        for (place, value) in &flips {
            let place = place.index(glb.len());
            glb[place] = *value;
        }
        if let Some(cut) = cut {
            glb.truncate(cut.index(glb.len()));
        }
        if fix_length && glb.len() >= 12 {
            let length = glb.len() as u32;
            glb[8..12].copy_from_slice(&length.to_le_bytes());
        }
        let folder = Folder::new();
        match load(&folder.write("scene.glb", &glb)) {
            Ok(scene) => prop_assert!(scene.validate().is_ok()),
            Err(error) => prop_assert!(!error.to_string().contains('\n')),
        }
    }

    /// The same for the JSON alone, whose numbers are what is trusted least.
    #[test]
    fn wild_numbers_never_panic(
        which in 0..5_usize,
        field in 0..1000_usize,
        number in prop_oneof![Just(0), Just(1), Just(u64::MAX), Just(u64::from(u32::MAX)), 0..100_u64],
    ) {
        let mut asset = ASSETS[which]();
        let mut numbers = Vec::new();
        collect_numbers(&asset.json, String::new(), &mut numbers);
        set(&mut asset.json, &numbers[field % numbers.len()], json!(number));
        if let Ok(scene) = asset.load() {
            prop_assert!(scene.validate().is_ok());
        }
    }
}

/// A node with two instances.
fn instanced() -> Asset {
    let mut asset = Asset::triangle();
    let places = asset.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 2.0, 3.0]);
    asset.json["nodes"][0]["extensions"] =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": places, "SCALE": places } } });
    asset
}

fn collect_numbers(json: &Value, pointer: String, numbers: &mut Vec<String>) {
    match json {
        Value::Number(_) => numbers.push(pointer),
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(i, v)| collect_numbers(v, format!("{pointer}/{i}"), numbers));
        }
        Value::Object(fields) => {
            fields.iter().for_each(|(k, v)| collect_numbers(v, format!("{pointer}/{k}"), numbers));
        }
        _ => {}
    }
}
