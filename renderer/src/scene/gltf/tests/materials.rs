//! Materials, textures, images.

use serde_json::json;

use super::super::super::image::dds::tests::solid;
use super::super::super::image::tests::png;
use super::super::super::{AlphaMode, Material, Sampler, TextureSlot, Wrap};
use super::*;

/// A triangle with coordinate sets 0, 1 and 3 and `count` one-texel images, each a texture.
fn textured(count: u8) -> Asset {
    let mut asset = Asset::triangle();
    for set in [0_u8, 1, 3] {
        let uv = asset.floats("VEC2", &[f32::from(set); 6]);
        asset.attribute(&format!("TEXCOORD_{set}"), uv);
    }
    asset.json["images"] = json!([]);
    asset.json["textures"] = json!([]);
    for i in 0..count {
        let view = asset.view(&png([1, 1], [i, i, i, 255]));
        push(&mut asset.json["images"], json!({ "bufferView": view, "mimeType": "image/png" }));
        push(&mut asset.json["textures"], json!({ "source": i }));
    }
    asset
}

fn only_material(asset: &Asset) -> Material {
    let scene = asset.load().unwrap();
    assert_eq!(scene.materials.len(), 1);
    scene.materials[0].clone()
}

#[test]
fn all_factors_and_five_textures() {
    let mut asset = textured(5);
    asset.material(json!({
        "name": "all",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6,
            "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 1 }
        },
        "normalTexture": { "index": 2, "scale": 0.7 },
        "occlusionTexture": { "index": 3, "strength": 0.8 },
        "emissiveTexture": { "index": 4 },
        "emissiveFactor": [0.5, 1.0, 0.0],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 6.0 } },
        "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true
    }));
    let scene = asset.load().unwrap();
    let material = &scene.materials[0];
    let plain = Material { textures: [None; 5], ..material.clone() };
    let expected = Material {
        name: "all".into(),
        base_color: [0.1, 0.2, 0.3, 0.4],
        metallic: 0.5,
        roughness: 0.6,
        emissive: [3.0, 6.0, 0.0],
        normal_scale: 0.7,
        occlusion_strength: 0.8,
        alpha_mode: AlphaMode::Mask,
        alpha_cutoff: 0.25,
        double_sided: true,
        unlit: false,
        textures: [None; 5],
    };
    assert_eq!(plain, expected);
    let image = |slot: TextureSlot| &scene.images[material.textures[slot as usize].unwrap().image as usize];
    let slots = [
        (TextureSlot::BaseColor, 0, true),
        (TextureSlot::MetallicRoughness, 1, false),
        (TextureSlot::Normal, 2, false),
        (TextureSlot::Occlusion, 3, false),
        (TextureSlot::Emissive, 4, true),
    ];
    for (slot, texel, srgb) in slots {
        assert_eq!((image(slot).mips[0][0], image(slot).srgb), (texel, srgb), "{slot:?}");
    }
}

#[test]
fn unlit_materials_and_those_of_specular_and_glossiness() {
    let mut asset = textured(2);
    asset.json["extensionsRequired"] = json!(["KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness"]);
    asset.material(json!({ "extensions": { "KHR_materials_unlit": {} } }));
    assert!(only_material(&asset).unlit);

    let gloss = json!({
        "diffuseFactor": [0.1, 0.2, 0.3, 0.4], "diffuseTexture": { "index": 1, "texCoord": 3 },
        "specularFactor": [1, 0, 0], "glossinessFactor": 0.75, "specularGlossinessTexture": { "index": 9 }
    });
    asset.material(json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": gloss } }));
    let scene = asset.load().unwrap();
    let material = &scene.materials[0];
    assert_eq!(
        (material.base_color, material.metallic, material.roughness),
        ([0.1, 0.2, 0.3, 0.4], 0.0, 0.25)
    );
    assert_eq!((scene.images[0].mips[0][0], scene.vertices[0].uv[0]), (1, [3.0; 2]));
    let warning =
        "materials of specular and glossiness, drawn with their diffuse colour and gloss factor alone: 1";
    assert_eq!(scene.warnings, [warning]);

    asset.json["materials"][0]["pbrMetallicRoughness"] = json!({ "roughnessFactor": 0.5 });
    let scene = asset.load().unwrap();
    let material = &scene.materials[0];
    assert_eq!((material.base_color, material.metallic, material.roughness), ([1.0; 4], 1.0, 0.5));
    assert_eq!(
        scene.warnings,
        ["materials of specular and glossiness, drawn by their metallic-roughness values: 1"]
    );
}

#[test]
fn primitives_without_material_get_the_default_one() {
    let material = only_material(&Asset::triangle());
    assert_eq!(material, Material::plain("default"));
    assert_eq!((material.metallic, material.roughness), (1.0, 1.0));
}

#[test]
fn alpha_modes() {
    let modes = [("OPAQUE", AlphaMode::Opaque), ("MASK", AlphaMode::Mask), ("BLEND", AlphaMode::Blend)];
    for (name, mode) in modes {
        let mut asset = Asset::triangle();
        asset.material(json!({ "alphaMode": name }));
        let material = only_material(&asset);
        assert_eq!((material.alpha_mode, material.alpha_cutoff), (mode, 0.5));
    }
}

#[test]
fn one_image_as_color_and_as_data_becomes_two() {
    let mut asset = textured(1);
    asset.material(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 0 } },
        "occlusionTexture": { "index": 0 }
    }));
    let scene = asset.load().unwrap();
    let spaces: Vec<_> = scene.images.iter().map(|image| image.srgb).collect();
    assert_eq!(spaces, [true, false]);
    let images = scene.materials[0].textures.map(|texture| texture.map(|t| t.image));
    assert_eq!(images, [Some(0), Some(1), None, Some(1), None]);
}

#[test]
fn two_coordinate_sets_fill_two_uv_sets() {
    let mut asset = textured(1);
    asset.material(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "texCoord": 3 } },
        "emissiveTexture": { "index": 0, "texCoord": 1 }
    }));
    let scene = asset.load().unwrap();
    let uv_set = |slot: TextureSlot| scene.materials[0].textures[slot as usize].unwrap().uv_set;
    assert_eq!((uv_set(TextureSlot::BaseColor), uv_set(TextureSlot::Emissive)), (1, 0));
    assert_eq!(scene.vertices[0].uv, [[1.0; 2], [3.0; 2]]);

    asset.json["materials"][0]["normalTexture"] = json!({ "index": 0, "texCoord": 0 });
    let error = asset.error();
    assert_eq!(
        error,
        "materials[0] reads TEXCOORD_0, TEXCOORD_1, TEXCOORD_3; at most two sets of texture coordinates work"
    );
}

#[test]
fn missing_coordinates_are_zero() {
    let mut asset = textured(1);
    asset.material(json!({ "emissiveTexture": { "index": 0, "texCoord": 2 } }));
    assert_eq!(asset.vertices()[0].uv, [[0.0; 2]; 2]);
}

#[test]
fn texture_transforms_scale_turn_and_move() {
    let transform = json!({ "KHR_texture_transform": {
        "offset": [0.25, 0.5], "rotation": std::f32::consts::FRAC_PI_2, "scale": [2.0, 3.0], "texCoord": 1
    } });
    let mut asset = textured(1);
    asset.json["extensionsRequired"] = json!(["KHR_texture_transform"]);
    asset.material(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "extensions": transform } },
        "normalTexture": { "index": 0, "extensions": transform },
        "occlusionTexture": { "index": 0, "extensions": transform }
    }));
    let scene = asset.load().unwrap();
    for slot in [TextureSlot::BaseColor, TextureSlot::Normal, TextureSlot::Occlusion] {
        let texture = scene.materials[0].textures[slot as usize].unwrap();
        let expected = [[0.0, 3.0, 0.25], [-2.0, 0.0, 0.5]];
        for (row, expected) in texture.uv_transform.iter().zip(expected) {
            assert!(row.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{slot:?} {texture:?}");
        }
    }
    assert_eq!(scene.vertices[0].uv[0], [1.0; 2], "the extension's texCoord wins");
}

#[test]
fn samplers_wrap_and_filter() {
    let mut asset = textured(1);
    asset.json["samplers"] = json!([{ "wrapS": 33071, "wrapT": 33648, "magFilter": 9728 }]);
    asset.json["textures"][0]["sampler"] = json!(0);
    asset.material(json!({ "emissiveTexture": { "index": 0 } }));
    let sampler = only_material(&asset).textures[TextureSlot::Emissive as usize].unwrap().sampler;
    assert_eq!(sampler, Sampler { wrap: [Wrap::Clamp, Wrap::Mirror], nearest: true });
}

#[test]
fn images_from_files_and_data_uris() {
    let folder = Folder::new();
    folder.write("tex/ä b.png", png([4, 2], [1, 2, 3, 4]));
    use base64::Engine;
    let data = base64::engine::general_purpose::STANDARD.encode(png([2, 2], [5, 6, 7, 8]));
    let mut asset = textured(2);
    asset.json["images"] = json!([{ "uri": "tex/%C3%A4%20b.png" }, { "uri": format!("data:image/png;base64,{data}"), "name": "inline" }]);
    asset.material(json!({
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } }, "emissiveTexture": { "index": 1 }
    }));
    let scene = load(&folder.write("scene.glb", asset.glb())).unwrap();
    let images: Vec<_> =
        scene.images.iter().map(|i| (i.name.as_str(), i.width, i.height, i.mips.len())).collect();
    assert_eq!(images, [("ä b.png", 4, 2, 3), ("inline", 2, 2, 2)]);
    assert_eq!(scene.images[1].mips[1], [5, 6, 7, 8]);

    folder.write("tex/ä b.png", b"not a png");
    let error = load(&folder.path().join("scene.glb")).unwrap_err();
    assert_eq!(
        message(error, "ä b.png"),
        "image ä b.png: is none of PNG, JPEG, WebP, TGA, BMP, DDS and KTX2"
    );
    fs::remove_file(folder.path().join("tex/ä b.png")).unwrap();
    let text = message(load(&folder.path().join("scene.glb")).unwrap_err(), "ä b.png");
    assert!(text.starts_with("cannot be read: ") && text.contains("images[0] of "), "{text}");
}

/// A triangle whose base colour is `texture`: image 0 is a DDS, 1 a PNG, 2 broken, 3 a file that is missing.
fn with_choice(texture: Value) -> Asset {
    let mut asset = textured(2);
    let (dds, broken) = (asset.view(&solid([201, 41, 31, 255])), asset.view(b"DDS and no more"));
    asset.json["images"][0] = json!({ "bufferView": dds, "mimeType": "image/png" });
    push(&mut asset.json["images"], json!({ "bufferView": broken, "name": "broken" }));
    push(&mut asset.json["images"], json!({ "uri": "missing.dds" }));
    asset.json["textures"] = json!([texture]);
    asset.material(json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
    asset
}

#[test]
fn images_in_other_formats_are_preferred_and_plain_ones_stand_in() {
    let by = |name: &str, image: u32| json!({ name: { "source": image } });
    let cases = [
        (json!({ "extensions": by("MSFT_texture_dds", 0) }), 201),
        (json!({ "source": 1, "extensions": by("MSFT_texture_dds", 0) }), 201),
        (json!({ "source": 1, "extensions": by("EXT_texture_webp", 0) }), 201),
        (json!({ "source": 1, "extensions": by("KHR_texture_basisu", 0) }), 201),
        // Broken, missing, not there: the PNG stands in.
        (json!({ "source": 1, "extensions": by("MSFT_texture_dds", 2) }), 1),
        (json!({ "source": 1, "extensions": by("MSFT_texture_dds", 3) }), 1),
        (json!({ "source": 1, "extensions": by("MSFT_texture_dds", 9) }), 1),
        (json!({ "source": 1, "extensions": by("EXT_texture_avif", 0) }), 1),
    ];
    for (texture, red) in cases {
        let mut asset = with_choice(texture.clone());
        asset.json["extensionsRequired"] =
            json!(["MSFT_texture_dds", "KHR_texture_basisu", "EXT_texture_webp"]);
        let scene = asset.load().unwrap();
        assert_eq!((scene.images.len(), scene.images[0].mips[0][0]), (1, red), "{texture}");
    }
}

#[test]
fn where_no_image_can_be_read_the_preferred_one_is_blamed() {
    let asset = with_choice(json!({ "source": 3, "extensions": { "MSFT_texture_dds": { "source": 2 } } }));
    let error = asset.error();
    assert!(error.starts_with("image broken: has a broken DDS header"), "{error}");
}

#[test]
fn textures_without_an_image_that_is_read_are_left_out() {
    for texture in [json!({}), json!({ "extensions": { "EXT_texture_avif": { "source": 0 } } })] {
        let scene = with_choice(texture).load().unwrap();
        assert_eq!((scene.images.len(), scene.materials[0].textures), (0, [None; 5]));
    }
}
