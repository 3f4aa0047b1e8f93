//! Extensions: which a file may require, and which change a picture that is drawn without them.

use serde_json::{Map, Value};

use super::left_out::LeftOut;

/// What a file may require.
const SUPPORTED: [&str; 13] = [
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "MSFT_texture_dds",
];

/// Compressed primitives, of which only uncompressed copies are read.
pub(super) const DRACO: &str = "KHR_draco_mesh_compression";

/// What changes nothing of a still picture: metadata, motion and sound.
const WITHOUT_PICTURE: [&str; 7] = [
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "KHR_animation_pointer",
    "KHR_audio_emitter",
    "KHR_interactivity",
    "KHR_xmp",
    "KHR_xmp_json_ld",
];

/// Extensions of materials with the factors that turn them on, and the value at which each does nothing.
const OF_MATERIALS: [(&str, &[(&str, f64)]); 10] = [
    ("KHR_materials_anisotropy", &[("anisotropyStrength", 0.0)]),
    ("KHR_materials_clearcoat", &[("clearcoatFactor", 0.0)]),
    ("KHR_materials_diffuse_transmission", &[("diffuseTransmissionFactor", 0.0)]),
    ("KHR_materials_dispersion", &[("dispersion", 0.0)]),
    ("KHR_materials_ior", &[("ior", 1.5)]),
    ("KHR_materials_iridescence", &[("iridescenceFactor", 0.0)]),
    ("KHR_materials_sheen", &[("sheenColorFactor", 0.0)]),
    ("KHR_materials_specular", &[("specularFactor", 1.0), ("specularColorFactor", 1.0)]),
    ("KHR_materials_transmission", &[("transmissionFactor", 0.0)]),
    ("KHR_materials_volume", &[("thicknessFactor", 0.0)]),
];

/// Refuses what the file says cannot be drawn without.
pub(super) fn check_required(root: &Map<String, Value>) -> Result<(), String> {
    let names = listed(root.get("extensionsRequired"));
    let unknown: Vec<_> = names.filter(|name| !SUPPORTED.contains(name)).collect();
    match unknown.as_slice() {
        [] => Ok(()),
        names => Err(format!("requires {}, which is not supported; export without", names.join(", "))),
    }
}

/// Notes what a file uses that nothing here knows: it may change the picture.
pub(super) fn note_unknown(used: Option<&Value>, left_out: &mut LeftOut) {
    let of_materials = OF_MATERIALS.iter().map(|(name, _)| *name);
    let known: Vec<_> =
        SUPPORTED.into_iter().chain(WITHOUT_PICTURE).chain(of_materials).chain([DRACO]).collect();
    for name in listed(used).filter(|name| !known.contains(name)) {
        left_out.note(format!("drawn without {name}, which the file uses"));
    }
}

/// Notes what changes how a material looks, and is not drawn.
pub(super) fn note_material(material: &Value, left_out: &mut LeftOut) {
    for (name, factors) in OF_MATERIALS {
        let extension = material.get("extensions").and_then(|extensions| extensions.get(name));
        if extension.is_some_and(|extension| changes_picture(extension, factors)) {
            left_out.add(&format!("materials drawn without {name}"), 1);
        }
    }
}

/// Whether one of the factors is other than the value at which it does nothing, or a texture comes on top of
/// factors that do nothing only where they are 1.
fn changes_picture(extension: &Value, factors: &[(&str, f64)]) -> bool {
    let differs = |value: &Value, neutral: f64| match value {
        Value::Array(values) => values.iter().any(|value| value.as_f64() != Some(neutral)),
        value => value.as_f64() != Some(neutral),
    };
    factors.iter().any(|&(name, neutral)| extension.get(name).is_some_and(|value| differs(value, neutral)))
        || factors.iter().any(|(name, neutral)| {
            let texture = name.replace("Factor", "Texture");
            *neutral == 1.0 && extension.get(texture).is_some()
        })
}

fn listed(names: Option<&Value>) -> impl Iterator<Item = &str> {
    names.and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn warnings(note: impl Fn(&mut LeftOut)) -> Vec<String> {
        let mut left_out = LeftOut::default();
        note(&mut left_out);
        left_out.into_warnings()
    }

    #[test]
    fn extensions_of_materials_count_where_they_do_something() {
        let silent = json!({ "extensions": {
            "KHR_materials_ior": { "ior": 1.5 },
            "KHR_materials_specular": {},
            "KHR_materials_sheen": { "sheenColorFactor": [0, 0, 0] },
            "KHR_materials_clearcoat": { "clearcoatFactor": 0, "clearcoatRoughnessFactor": 0.5 },
            "KHR_materials_transmission": { "transmissionTexture": { "index": 0 } },
        } });
        let loud = json!({ "extensions": {
            "KHR_materials_specular": { "specularTexture": { "index": 0 } },
            "KHR_materials_ior": { "ior": 1.2 },
            "KHR_materials_sheen": { "sheenColorFactor": [0, 0.5, 0] },
        } });
        let found = warnings(|left_out| {
            note_material(&silent, left_out);
            note_material(&loud, left_out);
            note_material(&loud, left_out);
        });
        let names = ["KHR_materials_ior", "KHR_materials_sheen", "KHR_materials_specular"];
        assert_eq!(found, names.map(|name| format!("materials drawn without {name}: 2")));
    }

    #[test]
    fn unknown_extensions_are_noted_by_name() {
        let used = json!(["KHR_mesh_quantization", "VENDOR_glow", "KHR_xmp_json_ld", "KHR_materials_sheen"]);
        let found = warnings(|left_out| note_unknown(Some(&used), left_out));
        assert_eq!(found, ["drawn without VENDOR_glow, which the file uses"]);
    }
}
