//! Compressed geometry: meshopt decoded, Draco left out.

use meshopt::encoding as codec;
use serde_json::json;

use super::*;

/// Positions of five corners, fifths of a metre apart, as KHR_mesh_quantization has them: 16 bits and 16 of padding.
fn corners() -> Vec<[u16; 4]> {
    (0..5).map(|i| [13107 * i, 13107 * (i % 2), 0, 0]).collect()
}

/// Makes a buffer view compressed: its bytes lie at `encoded`, and what it would have been is not in the file.
fn compress(asset: &mut Asset, encoded: &[u8], (stride, count): (usize, usize), how: Value) -> usize {
    let view = asset.view(encoded);
    let place = asset.json["bufferViews"][view].clone();
    let mut compressed = json!({
        "buffer": 0, "byteOffset": place["byteOffset"], "byteLength": place["byteLength"],
        "byteStride": stride, "count": count
    });
    for (field, value) in how.as_object().unwrap() {
        compressed[field] = value.clone();
    }
    asset.json["bufferViews"][view] = json!({
        "buffer": 1, "byteLength": stride * count,
        "extensions": { "EXT_meshopt_compression": compressed }
    });
    view
}

/// A strip of triangles with everything compressed.
pub fn compressed() -> Asset {
    let mut asset = Asset::new();
    asset.json["extensionsRequired"] = json!(["EXT_meshopt_compression", "KHR_mesh_quantization"]);
    let positions = codec::encode_vertex_buffer(&corners()).unwrap();
    let normals = codec::encode_filter_oct::<i8>(&[[0.0, 0.6, 0.8, 0.0]; 5], 8);
    let normals = codec::encode_vertex_buffer(&normals).unwrap();
    let uvs = codec::encode_filter_exp::<2>(&[[0.5, 0.25]; 5], 15, codec::EncodeExpMode::Separate);
    let uvs = codec::encode_vertex_buffer(&uvs).unwrap();
    let indices = codec::encode_index_buffer(&[0, 1, 2, 2, 1, 3, 2, 3, 4], 5).unwrap();
    let views = [
        compress(&mut asset, &positions, (8, 5), json!({ "mode": "ATTRIBUTES" })),
        compress(&mut asset, &normals, (4, 5), json!({ "mode": "ATTRIBUTES", "filter": "OCTAHEDRAL" })),
        compress(&mut asset, &uvs, (8, 5), json!({ "mode": "ATTRIBUTES", "filter": "EXPONENTIAL" })),
        compress(&mut asset, &indices, (2, 9), json!({ "mode": "TRIANGLES", "filter": "NONE" })),
    ];
    for (view, stride) in [(views[0], 8), (views[1], 4)] {
        asset.json["bufferViews"][view]["byteStride"] = json!(stride);
    }
    let kinds =
        [("VEC3", U16, 5, true), ("VEC3", I8, 5, true), ("VEC2", F32, 5, false), ("SCALAR", U16, 9, false)];
    for (view, (kind, component, count, normalized)) in views.into_iter().zip(kinds) {
        push(
            &mut asset.json["accessors"],
            json!({ "bufferView": view, "componentType": component, "count": count, "type": kind, "normalized": normalized }),
        );
    }
    asset.primitive(json!({ "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 }, "indices": 3 }));
    let image = asset.view(&crate::scene::image::tests::png([1, 1], [9; 4]));
    asset.json["images"] = json!([{ "bufferView": image, "mimeType": "image/png" }]);
    asset.json["textures"] = json!([{ "source": 0 }]);
    asset.material(json!({ "emissiveTexture": { "index": 0 } }));
    asset
}

#[test]
fn meshopt_attributes_filters_and_indices_are_decoded() {
    let scene = compressed().load().unwrap();
    assert_eq!(scene.indices, [0, 1, 2, 2, 1, 3, 2, 3, 4]);
    for (i, vertex) in (0_u16..).zip(&scene.vertices) {
        let expected = [f32::from(i) * 0.2, f32::from(i % 2) * 0.2, 0.0];
        let close = |found: [f32; 3], expected: [f32; 3], within: f32| {
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= within)
        };
        assert!(close(vertex.position, expected, 1e-6), "{vertex:?}");
        assert!(close(vertex.normal, [0.0, 0.6, 0.8], 0.02), "{vertex:?}");
        assert_eq!(vertex.uv[0], [0.5, 0.25]);
    }
    assert!(scene.warnings.is_empty());
}

#[test]
fn the_extension_under_its_other_name_and_index_sequences() {
    let mut asset = compressed();
    let text = asset.json.to_string().replace("EXT_meshopt_compression", "KHR_meshopt_compression");
    asset.json = serde_json::from_str(&text).unwrap();
    let strip = codec::encode_index_sequence(&[0, 1, 2, 3, 4], 5).unwrap();
    let view = compress(&mut asset, &strip, (4, 5), json!({ "mode": "INDICES" }));
    asset.json["accessors"][3] =
        json!({ "bufferView": view, "componentType": U32, "count": 5, "type": "SCALAR" });
    asset.json["meshes"][0]["primitives"][0]["mode"] = json!(5);
    assert_eq!(asset.load().unwrap().indices, [0, 1, 2, 1, 3, 2, 2, 3, 4]);
}

#[test]
fn broken_meshopt_data_is_refused() {
    type Change = fn(&mut Value);
    let error = |change: Change| {
        let mut asset = compressed();
        change(&mut asset.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]);
        asset.error()
    };
    let place = "meshes[0].primitives[0] (): POSITION: accessors[0] lies in bufferViews[0], which ";
    let cases: [(Change, &str); 6] = [
        (|json| json["byteLength"] = json!(9), "holds broken meshopt data"),
        (
            |json| json["mode"] = json!("TRIANGLES"),
            "cannot have 5 elements of 8 bytes in mode Triangles with filter None",
        ),
        (|json| json["byteStride"] = json!(6), "cannot have 5 elements of 6 bytes in mode Attributes"),
        (|json| json["filter"] = json!("SECRET"), "is compressed, but how is not valid: unknown variant"),
        (|json| json["count"] = json!(1_u64 << 60), "has more elements than its bytes can hold"),
        (|json| json["count"] = json!(1 << 28), "has more elements than its bytes can hold"),
    ];
    for (change, expected) in cases {
        let error = error(change);
        assert!(error.starts_with(&format!("{place}{expected}")), "{error}");
    }
}

#[test]
fn draco_is_left_out_with_a_warning_unless_it_has_a_fallback() {
    let mut asset = Asset::triangle();
    asset.json["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    let draco = json!({ "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0 } } });
    asset.json["meshes"][0]["primitives"][0]["extensions"] = draco.clone();
    let scene = asset.load().unwrap();
    assert_eq!((scene.triangle_count(), scene.warnings.len()), (1, 0), "its accessor has data");
    asset.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    let nothing =
        "has no triangle to draw; primitives compressed with Draco (KHR_draco_mesh_compression) left out: 1";
    assert_eq!(asset.error(), nothing);
    asset.json["accessors"][0]["bufferView"] = json!(0);

    let hollow =
        push(&mut asset.json["accessors"], json!({ "componentType": F32, "count": 300, "type": "VEC3" }));
    asset.primitive(json!({ "attributes": { "POSITION": hollow }, "extensions": draco }));
    asset.primitive(json!({ "attributes": { "POSITION": 0, "NORMAL": hollow }, "extensions": draco }));
    asset.primitive(json!({ "attributes": { "POSITION": hollow } }));
    asset.primitive(json!({ "attributes": {} }));
    let scene = asset.load().unwrap();
    assert_eq!(scene.triangle_count(), 1);
    let warnings = [
        "primitives compressed with Draco (KHR_draco_mesh_compression) left out: 2",
        "primitives whose positions have no data (no bufferView) left out: 1",
        "primitives without positions left out: 1",
    ];
    assert_eq!(scene.warnings, warnings);
}
