//! What is not drawn refuses nothing, and what is left out is said.

use serde_json::json;

use super::*;

#[test]
fn parts_that_are_not_drawn_may_be_broken_or_missing() {
    let cases: &[(&str, Value)] = &[
        (
            "animations",
            json!([{ "channels": [{ "sampler": 0, "target": { "path": "pointer" } }], "samplers": [] }]),
        ),
        ("animations", json!("no")),
        ("cameras", json!([{ "type": "perspective" }])),
        ("scenes", json!([{ "nodes": [0] }, {}])),
        ("nodes", json!([{ "mesh": 0 }, { "mesh": 77, "skin": 9, "rotation": "no" }])),
        ("skins", json!([{}])),
        ("meshes", json!([{ "primitives": [{ "attributes": { "POSITION": 0 } }] }, { "weights": "no" }])),
        ("materials", json!([{ "normalTexture": { "index": 5 }, "alphaMode": "GLOW" }])),
        ("images", json!([{ "uri": "gone.png" }])),
        ("textures", json!([{ "source": 3, "sampler": 4 }])),
        ("extras", json!({ "any": ["thing"] })),
    ];
    for (field, value) in cases {
        let mut asset = Asset::triangle();
        asset.json[field] = value.clone();
        let scene = asset.load().unwrap_or_else(|error| panic!("{field}: {error}"));
        assert_eq!((scene.triangle_count(), scene.materials.len()), (1, 1), "{field}");
    }
    let mut asset = Asset::triangle();
    push(&mut asset.json["accessors"], json!({ "type": "VEC9" }));
    push(&mut asset.json["bufferViews"], json!({ "buffer": 9 }));
    assert_eq!(asset.load().unwrap().triangle_count(), 1);
}

#[test]
fn buffers_that_nothing_needs_may_be_missing() {
    let asset = Asset::triangle();
    let folder = Folder::new();
    let mut json = asset.json.clone();
    json["buffers"] = json!([
        { "byteLength": asset.bin.len(), "uri": "..\\data.bin" },
        { "byteLength": 100, "uri": "gone.bin" },
        { "byteLength": 100, "uri": "https://example.com/a.bin" },
        { "byteLength": 1_u64 << 60 },
        {},
    ]);
    // Longer than byteLength says.
    folder.write("data.bin", [&asset.bin[..], b"more"].concat());
    let path = folder.write("sub/scene.gltf", json.to_string());
    assert_eq!(load(&path).unwrap().triangle_count(), 1);
    json["bufferViews"][0]["buffer"] = json!(2);
    let error = load(&folder.write("sub/scene.gltf", json.to_string())).unwrap_err().to_string();
    let expected =
        "which needs buffers[2], which lies at https://example.com/a.bin; only files and data URIs are read";
    assert!(error.contains(expected), "{error}");
}

#[test]
fn unused_materials_are_not_in_the_scene() {
    let mut asset = Asset::triangle();
    asset.material(json!({}));
    asset.json["materials"] =
        json!([{ "name": "unused", "alphaMode": "MASK" }, { "name": "second" }, { "name": "first" }]);
    asset.json["meshes"][0]["primitives"][0]["material"] = json!(2);
    asset.primitive(json!({ "attributes": { "POSITION": 0 }, "material": 1 }));
    asset.primitive(json!({ "attributes": { "POSITION": 0 } }));
    let scene = asset.load().unwrap();
    let used: Vec<_> =
        scene.primitives.iter().map(|p| scene.materials[p.material as usize].name.as_str()).collect();
    assert_eq!(used, ["first", "second", "default"]);
    assert_eq!(scene.materials.len(), 3);
}

#[test]
fn versions_are_said_before_anything_else_is_read() {
    let error = |json: Value| {
        let folder = Folder::new();
        message(load(&folder.write("a.gltf", json.to_string())).unwrap_err(), "a.gltf")
    };
    let old = json!({ "asset": { "version": "1.0" }, "meshes": {}, "nodes": { "a": {} } });
    assert_eq!(error(old), "is glTF 1.0; 2.0 is read");
    assert_eq!(error(json!({ "meshes": { "a": {} } })), "is glTF 1.0; 2.0 is read");
    assert_eq!(error(json!({})), "has no asset.version, so it is not glTF 2.0; 2.0 is read");
    assert_eq!(error(json!({ "asset": { "version": "3.0" } })), "is glTF 3.0; 2.0 is read");
    assert_eq!(
        error(json!({ "asset": { "version": "2.1", "minVersion": "2.1" } })),
        "needs glTF 2.1; 2.0 is read"
    );
    for version in [json!("2.0"), json!("2.1"), json!("2"), json!(2.0)] {
        let mut asset = Asset::triangle();
        asset.json["asset"]["version"] = version;
        assert!(asset.load().is_ok());
    }
}

#[test]
fn unaligned_chunks_are_read() {
    let glb = Asset::triangle().glb();
    let json_length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let json = glb[20..20 + json_length].trim_ascii_end();
    // Neither padded nor of the length that the header says.
    let mut unaligned = glb[..12].to_vec();
    unaligned.extend((json.len() as u32 + 1).to_le_bytes());
    unaligned.extend([b"JSON".as_slice(), json, b" ", &glb[20 + json_length..]].concat());
    if (json.len() + 1).is_multiple_of(4) {
        unaligned[12] += 1;
        unaligned.insert(20 + json.len(), b' ');
    }
    let folder = Folder::new();
    assert_eq!(load(&folder.write("scene.glb", unaligned)).unwrap().vertices, Asset::triangle().vertices());
}

#[test]
fn what_changes_the_picture_is_warned_of() {
    let mut asset = Asset::triangle();
    asset.json["extensionsUsed"] = json!(["KHR_materials_clearcoat", "KHR_materials_variants", "KHR_xmp"]);
    asset.material(json!({ "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1 } } }));
    asset.primitive(json!({ "attributes": { "POSITION": 0 }, "mode": 1 }));
    let warnings = asset.load().unwrap().warnings;
    let expected = [
        "drawn without KHR_materials_variants, which the file uses",
        "primitives of points or lines left out: 1",
        "materials drawn without KHR_materials_clearcoat: 1",
    ];
    assert_eq!(warnings, expected);
}

#[test]
fn hidden_nodes_are_not_drawn() {
    let mut asset = Asset::triangle();
    let hidden = json!({ "KHR_node_visibility": { "visible": false } });
    asset.json["nodes"] = json!([{ "children": [1, 2] }, { "extensions": hidden, "children": [3] }, { "mesh": 0 }, { "mesh": 0 }]);
    assert_eq!(asset.load().unwrap().instances.len(), 1);
}

#[test]
fn deep_trees_are_walked_and_small_files_stay_small() {
    let mut asset = Asset::triangle();
    let count = 20_000;
    let chain = (0..count).map(|i| json!({ "translation": [0.5, 0, 0], "children": [i + 1] }));
    asset.json["nodes"] = chain.chain([json!({ "mesh": 0 })]).collect();
    assert_eq!(asset.load().unwrap().instances[0].world_from_object.w_axis.x, 10_000.0);

    // Thousands of primitives of one large accessor.
    let mut asset = Asset::new();
    let position = asset.floats("VEC3", &[0.0; 3 * 30_000]);
    asset.json["meshes"][0]["primitives"] =
        json!(vec![json!({ "attributes": { "POSITION": position } }); 3_000]);
    assert!(asset.error().ends_with("brings the scene to more vertices than its buffers account for"));
}
