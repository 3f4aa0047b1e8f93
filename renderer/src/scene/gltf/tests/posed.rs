//! Meshes as they stand at rest: instanced, morphed, skinned.

use glam::{Mat4, Quat, Vec3};
use serde_json::json;

use super::*;

fn positions(asset: &Asset) -> Vec<[f32; 3]> {
    asset.vertices().iter().map(|v| v.position).collect()
}

/// World positions of the first instance's vertices.
fn world_positions(scene: &Scene) -> Vec<Vec3> {
    let world = scene.instances[0].world_from_object;
    scene
        .vertices
        .iter()
        .map(|v| world.transform_point3(Vec3::from(v.position).as_dvec3()).as_vec3())
        .collect()
}

#[test]
fn instances_stand_relative_to_their_node() {
    let mut asset = Asset::triangle();
    let translation = asset.floats("VEC3", &[1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0]);
    // Three quarter turns about y, normalised integers: (0, sin, 0, cos) of half the angle.
    let rotation =
        asset.accessor("VEC4", I16, false, bytemuck::cast_slice(&[0_i16, 23170, 0, 23170].repeat(3)));
    let scale = asset.floats("VEC3", &[2.0, 2.0, 2.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    let attributes =
        json!({ "TRANSLATION": translation, "ROTATION": rotation, "SCALE": scale, "_ID": translation });
    asset.json["nodes"][0] = json!({
        "mesh": 0, "translation": [10, 0, 0],
        "extensions": { "EXT_mesh_gpu_instancing": { "attributes": attributes } }
    });
    let scene = asset.load().unwrap();
    let turn = Quat::from_rotation_y(std::f32::consts::FRAC_PI_2);
    let expected = [
        (Vec3::splat(2.0), Vec3::new(11.0, 0.0, 0.0)),
        (Vec3::new(1.0, 1.0, 0.0), Vec3::new(10.0, 2.0, 0.0)),
    ];
    assert_eq!(scene.instances.len(), expected.len());
    for (instance, (scale, translation)) in scene.instances.iter().zip(expected) {
        let expected = Mat4::from_scale_rotation_translation(scale, turn, translation);
        assert!(instance.world_from_object.as_mat4().abs_diff_eq(expected, 1e-5), "{instance:?}");
    }
    assert_eq!((scene.triangle_count(), scene.primitives.len()), (2, 1));
    assert_eq!(scene.warnings, ["nodes scaled to nothing and left out: 1"]);
}

#[test]
fn instances_that_cannot_be_are_refused() {
    let with = |attributes: Value| {
        let mut asset = Asset::triangle();
        let one = asset.floats("VEC3", &[0.0; 3]);
        assert_eq!(one, 1);
        push(&mut asset.json["accessors"], json!({ "componentType": F32, "count": 4194305, "type": "VEC3" }));
        push(&mut asset.json["accessors"], json!({ "componentType": F32, "count": 1 << 20, "type": "VEC3" }));
        asset.json["nodes"][0]["extensions"] =
            json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
        asset
    };
    let instances = "nodes[0] has instances (EXT_mesh_gpu_instancing)";
    let error = |attributes| with(attributes).error();
    assert_eq!(error(json!({})), format!("{instances}: no attributes"));
    let uneven = error(json!({ "TRANSLATION": 0, "SCALE": 1 }));
    assert_eq!(uneven, format!("{instances}: TRANSLATION has 3 elements, another attribute 1"));
    let turned = error(json!({ "ROTATION": 0 }));
    assert_eq!(turned, format!("{instances}: accessors[0] has 3 components an element instead of 4"));
    assert!(error(json!({ "TRANSLATION": 2 })).contains("too many elements without a buffer view"));

    // Five nodes of a million instances each, out of a few hundred bytes.
    let mut many = with(json!({ "TRANSLATION": 3 }));
    let node = many.json["nodes"][0].clone();
    many.json["nodes"] = json!(vec![node; 5]);
    many.json["scenes"][0]["nodes"] = json!([0, 1, 2, 3, 4]);
    assert_eq!(many.error(), "nodes[4] brings the meshes placed in the scene to more than 4194304");
}

/// A triangle with normals and tangents and two morph targets, the second sparse.
pub fn morphed() -> Asset {
    let mut asset = Asset::triangle();
    let normals = asset.accessor("VEC3", I8, true, bytemuck::cast_slice(&[0_i8, 0, 127].repeat(3)));
    asset.attribute("NORMAL", normals);
    let up = asset.accessor("VEC3", I8, true, bytemuck::cast_slice(&[0_i8, 127, 0].repeat(3)));
    let away = asset.floats("VEC3", &[0.0, 0.0, 2.0].repeat(3));
    let (places, values) = (asset.view(&[1]), asset.view(bytemuck::cast_slice(&[8.0_f32, 0.0, 0.0])));
    let sparse = push(
        &mut asset.json["accessors"],
        json!({ "componentType": F32, "count": 3, "type": "VEC3", "sparse": {
            "count": 1,
            "indices": { "bufferView": places, "componentType": U8 },
            "values": { "bufferView": values }
        } }),
    );
    asset.json["meshes"][0]["primitives"][0]["targets"] =
        json!([{ "POSITION": away, "NORMAL": up }, { "POSITION": sparse }]);
    asset
}

#[test]
fn morph_targets_are_added_by_their_default_weights() {
    let mut asset = morphed();
    assert_eq!(positions(&asset)[1], [1.0, 0.0, 0.0], "without weights they weigh nothing");
    asset.json["meshes"][0]["weights"] = json!([0.5, 0.25]);
    assert_eq!(positions(&asset), [[0.0, 0.0, 1.0], [3.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
    let normal = Vec3::new(0.0, 0.5, 1.0).normalize();
    assert!(asset.vertices().iter().all(|v| Vec3::from(v.normal).abs_diff_eq(normal, 1e-6)));

    // A node's weights replace the mesh's: two shapes of one mesh, the first of them twice.
    asset.json["scenes"][0]["nodes"] = json!([0, 1, 2]);
    asset.json["nodes"] =
        json!([{ "mesh": 0 }, { "mesh": 0, "weights": [1, 0] }, { "mesh": 0, "translation": [5, 0, 0] }]);
    let scene = asset.load().unwrap();
    assert_eq!((scene.primitives.len(), scene.instances.len()), (2, 3));
    let primitives: Vec<_> = scene.instances.iter().map(|i| i.primitive).collect();
    assert_eq!(primitives, [0, 1, 0]);
    assert_eq!(scene.vertices[4].position, [1.0, 0.0, 2.0]);
}

#[test]
fn flat_normals_follow_the_morphed_positions() {
    let mut asset = morphed();
    asset.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("NORMAL");
    let lift = asset.floats("VEC3", &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    asset.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": lift }]);
    asset.json["meshes"][0]["weights"] = json!([1]);
    let expected = Vec3::new(-1.0, 0.0, 1.0).normalize();
    assert!(asset.vertices().iter().all(|v| Vec3::from(v.normal).abs_diff_eq(expected, 1e-6)));
}

#[test]
fn targets_that_weigh_nothing_are_not_looked_at() {
    let mut asset = morphed();
    asset.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = json!(99);
    asset.json["meshes"][0]["weights"] = json!([1, 0]);
    assert_eq!(positions(&asset)[0], [0.0, 0.0, 2.0]);
    asset.json["meshes"][0]["weights"] = json!([1, 1]);
    assert_eq!(
        asset.error(),
        "meshes[0].primitives[0] (): targets[1]: refers to accessors[99], which is not there (5 are)"
    );
}

/// A triangle on two joints, nodes 1 and 2: the first corner follows both alike, the others one each.
pub fn skinned() -> Asset {
    let mut asset = Asset::triangle();
    let normals = asset.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    asset.attribute("NORMAL", normals);
    let joints = asset.accessor("VEC4", U8, false, &[0, 1, 0, 0, 0, 9, 0, 0, 1, 0, 0, 0]);
    let weights = asset.accessor("VEC4", U8, true, &[100, 100, 0, 0, 255, 0, 0, 0, 3, 0, 0, 0]);
    asset.attribute("JOINTS_0", joints);
    asset.attribute("WEIGHTS_0", weights);
    let binds = [Mat4::from_scale(Vec3::splat(0.01)), Mat4::from_scale(Vec3::splat(0.01))];
    let columns: Vec<f32> = binds.iter().flat_map(|bind| bind.to_cols_array()).collect();
    let view = asset.view(bytemuck::cast_slice(&columns));
    let binds = push(
        &mut asset.json["accessors"],
        json!({ "bufferView": view, "componentType": F32, "count": 2, "type": "MAT4" }),
    );
    asset.json["skins"] = json!([{ "joints": [1, 2], "inverseBindMatrices": binds }]);
    asset.json["scenes"][0]["nodes"] = json!([0, 1]);
    asset.json["nodes"] = json!([
        { "mesh": 0, "skin": 0, "scale": [7, 7, 7], "translation": [5, 5, 5] },
        { "scale": [100, 100, 100], "translation": [0, 0, 2], "children": [2] },
        { "translation": [0, 0.04, 0] },
    ]);
    asset
}

#[test]
fn skinned_vertices_follow_their_joints_and_not_their_node() {
    let scene = skinned().load().unwrap();
    assert_eq!(
        scene.instances[0].world_from_object.as_mat4(),
        Mat4::from_translation(Vec3::new(0.0, 0.0, 2.0))
    );
    let expected = [Vec3::new(0.0, 2.0, 2.0), Vec3::new(1.0, 0.0, 2.0), Vec3::new(0.0, 5.0, 2.0)];
    for (found, expected) in world_positions(&scene).into_iter().zip(expected) {
        assert!(found.abs_diff_eq(expected, 1e-5), "{found} for {expected}");
    }
    assert!(scene.warnings.is_empty());
}

#[test]
fn skins_without_inverse_binds_or_weights_stand_in_their_joints() {
    let mut asset = skinned();
    asset.json["skins"][0].as_object_mut().unwrap().remove("inverseBindMatrices");
    asset.json["nodes"][1] = json!({ "rotation": Quat::from_rotation_x(std::f32::consts::PI).to_array() });
    asset.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("WEIGHTS_0");
    let scene = asset.load().unwrap();
    let expected = [Vec3::ZERO, Vec3::X, Vec3::NEG_Y];
    for (found, expected) in world_positions(&scene).into_iter().zip(expected) {
        assert!(found.abs_diff_eq(expected, 1e-6), "{found} for {expected}");
    }
    assert!(scene.vertices.iter().all(|v| Vec3::from(v.normal).abs_diff_eq(Vec3::NEG_Z, 1e-6)));
}

#[test]
fn one_mesh_on_two_skins_stands_twice_and_mirrors_keep_their_front() {
    let mut asset = skinned();
    asset.json["skins"] = json!([{ "joints": [1, 1] }, { "joints": [2, 2] }]);
    asset.json["scenes"][0]["nodes"] = json!([0, 1, 2, 3]);
    asset.json["nodes"] = json!([
        { "mesh": 0, "skin": 0 }, { "translation": [3, 0, 0] },
        { "scale": [-1, 1, 1] }, { "mesh": 0, "skin": 1 }
    ]);
    let scene = asset.load().unwrap();
    assert_eq!((scene.primitives.len(), scene.instances.len()), (2, 2));
    assert_eq!(
        (scene.indices.as_slice(), scene.vertices[4].position),
        ([0, 1, 2, 0, 2, 1].as_slice(), [-1.0, 0.0, 0.0])
    );
    assert!(scene.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]), "fronts still face +z");
    assert_eq!(scene.instances[0].world_from_object.w_axis.x, 3.0);
}

#[test]
fn joints_outside_the_scene_stand_where_their_parents_put_them() {
    let mut asset = skinned();
    asset.json["scenes"][0]["nodes"] = json!([0]);
    let outside = world_positions(&asset.load().unwrap());
    assert_eq!(outside, world_positions(&skinned().load().unwrap()));
    asset.json["nodes"][2]["children"] = json!([1]);
    assert_eq!(asset.error(), "skins[0] has the joint nodes[1], which is its own ancestor");
}

#[test]
fn skins_that_cannot_be_are_refused() {
    let cases: [(&str, Value, &str); 5] = [
        ("/skins/0/joints", json!([1]), "meshes[0].primitives[0] (): vertex 0 follows joint 1 of 1"),
        ("/skins/0/joints", json!([]), "skins[0] has no joints"),
        ("/skins/0/joints", json!([1, 2, 2]), "skins[0] has 3 joints and 2 inverse bind matrices"),
        ("/skins/0/joints", json!([1, 77]), "skins[0] refers to nodes[77], which is not there (3 are)"),
        ("/nodes/0/skin", json!(4), "skins[4] refers to skins[4], which is not there (1 are)"),
    ];
    for (pointer, value, expected) in cases {
        let mut asset = skinned();
        *asset.json.pointer_mut(pointer).unwrap() = value;
        assert_eq!(asset.error(), expected);
    }
}
