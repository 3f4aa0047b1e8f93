//! The JSON Schema of configuration files, generated from [`Layer`].

use super::values::MAX_RESOLUTION;
use super::{Assign, Choice, Config, Layer};
use crate::assign::{Bounds, Clusters, Compaction, Conservative};
use crate::lights::Attenuation;
use crate::methods::{KINDS, Kind, Size};
use crate::shading::{Shading, ShadingPipeline};
use clap::ValueEnum;
use schemars::{Schema, SchemaGenerator, json_schema};
use serde_json::Value;

/// The schema, with the built-in defaults in it, as `configs/manylight.schema.json` holds it.
pub fn json_schema() -> Value {
    let mut schema = schemars::schema_for!(Layer).to_value();
    // By way of text: a single-precision 0.1 is written 0.1.
    let defaults = serde_json::to_string(&Config::default()).unwrap_or_default();
    let defaults: Value = serde_json::from_str(&defaults).unwrap_or_default();
    if let Some(properties) = schema.get_mut("properties").and_then(Value::as_object_mut) {
        for (name, property) in properties {
            let Some(property) = property.as_object_mut() else { continue };
            match defaults.get(name).filter(|default| !default.is_null()) {
                Some(default) => property.insert("default".into(), default.clone()),
                None => property.remove("default"),
            };
        }
    }
    schema
}

pub(super) fn methods(_: &mut SchemaGenerator) -> Schema {
    let sizes = |kind: &Kind| kind.sizes.iter().map(|name| Size::expression(name)).collect::<String>();
    let pattern = |kind: &Kind| format!("{}{}{}", kind.name, sizes(kind), kind.suffix);
    let patterns: Vec<String> = KINDS.iter().map(pattern).collect();
    let tuned: Vec<String> = KINDS.iter().map(|kind| kind.tuned().to_string()).collect();
    json_schema!({
        "type": ["array", "null"],
        "minItems": 1,
        "uniqueItems": true,
        "items": {
            "type": "string",
            "pattern": format!("^({})$", patterns.join("|")),
            "examples": tuned
        }
    })
}

pub(super) fn resolution(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": ["array", "null"],
        "minItems": 2,
        "maxItems": 2,
        "items": { "type": "integer", "minimum": 1, "maximum": MAX_RESOLUTION }
    })
}

pub(super) fn resolutions(generator: &mut SchemaGenerator) -> Schema {
    let mut one = resolution(generator);
    one.insert("type".into(), "array".into());
    json_schema!({ "type": ["array", "null"], "items": one, "uniqueItems": true })
}

pub(super) fn msaa(_: &mut SchemaGenerator) -> Schema {
    json_schema!({ "enum": [1, 4, null] })
}

pub(super) fn runs(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "anyOf": [{ "type": "integer", "minimum": 0, "maximum": u32::MAX }, { "enum": ["auto", null] }]
    })
}

pub(super) fn frames(_: &mut SchemaGenerator) -> Schema {
    json_schema!({
        "type": ["string", "null"],
        "pattern": r"^([0-9]*\.\.[0-9]*(/[1-9][0-9]*)?|/[1-9][0-9]*|[0-9]+)$",
        "examples": ["..", "300..600/40", "/40", "580"]
    })
}

pub(super) fn exr(_: &mut SchemaGenerator) -> Schema {
    frames_of(json_schema!({ "enum": ["all", "none", "discontinuity", null] }))
}

pub(super) fn trace(_: &mut SchemaGenerator) -> Schema {
    frames_of(json_schema!({ "enum": ["all", "none", null] }))
}

/// A list of frame numbers, or a word for some.
fn frames_of(words: Schema) -> Schema {
    json_schema!({ "anyOf": [{ "type": "array", "items": { "type": "integer", "minimum": 0 } }, words] })
}

/// A name, or a list of different names.
fn one_or_several(name: &Schema) -> Schema {
    json_schema!({
        "anyOf": [
            name,
            { "type": "array", "items": name, "minItems": 1, "uniqueItems": true },
            { "type": "null" }
        ]
    })
}

pub(super) fn clusters(_: &mut SchemaGenerator) -> Schema {
    choices_of(Clusters::value_variants())
}

pub(super) fn bounds(_: &mut SchemaGenerator) -> Schema {
    choices_of(Bounds::value_variants())
}

pub(super) fn normal_cones(_: &mut SchemaGenerator) -> Schema {
    one_or_several(&json_schema!({ "enum": ["0", "1", "2", "3"] }))
}

pub(super) fn slices(_: &mut SchemaGenerator) -> Schema {
    one_or_several(&json_schema!({
        "type": "string",
        "pattern": r"^(auto|geometric|cubes|second-plane-[0-9.]+|linear|uniform-ndc|uniform-view)$",
        "examples": ["auto", "geometric", "cubes", "second-plane-5", "linear", "uniform-ndc", "uniform-view"]
    }))
}

pub(super) fn lists(_: &mut SchemaGenerator) -> Schema {
    one_or_several(&json_schema!({
        "type": "string",
        "pattern": "^(offsets|(fixed|capped)-[1-9][0-9]*|linked-(32|64)(-unsorted)?)$",
        "examples": ["offsets", "fixed-128", "capped-100", "linked-64"]
    }))
}

pub(super) fn compaction(_: &mut SchemaGenerator) -> Schema {
    names_of(Compaction::value_variants())
}

pub(super) fn conservative(_: &mut SchemaGenerator) -> Schema {
    names_of(Conservative::value_variants())
}

pub(super) fn mesh_detail(_: &mut SchemaGenerator) -> Schema {
    one_or_several(&json_schema!({
        "type": "string",
        "pattern": r"^(12|42|162|642|auto-[0-9]+(\.[0-9]+)?)$",
        "examples": ["12", "42", "162", "642", "auto-0.25"]
    }))
}

pub(super) fn octree(_: &mut SchemaGenerator) -> Schema {
    one_or_several(&json_schema!({
        "type": "string",
        "pattern": "^(rebuild|seed-[0-9]+|shared|geometry|dynamic-[0-9]+(\\.[0-9]+)?)$",
        "examples": ["rebuild", "seed-7", "shared", "geometry", "dynamic-1.5"]
    }))
}

fn choices_of<T: Copy + std::fmt::Display>(values: &[T]) -> Schema {
    let named = values.iter().map(|&value| Choice::Named(value));
    names_of(&[Choice::Auto].into_iter().chain(named).collect::<Vec<_>>())
}

pub(super) fn assign(_: &mut SchemaGenerator) -> Schema {
    names_of(Assign::value_variants())
}

pub(super) fn shading(_: &mut SchemaGenerator) -> Schema {
    names_of(Shading::value_variants())
}

pub(super) fn pipeline(_: &mut SchemaGenerator) -> Schema {
    names_of(ShadingPipeline::value_variants())
}

fn names_of<T: ToString>(values: &[T]) -> Schema {
    let names: Vec<String> = values.iter().map(ToString::to_string).collect();
    one_or_several(&json_schema!({ "enum": names }))
}

pub(super) fn test(_: &mut SchemaGenerator) -> Schema {
    one_or_several(&json_schema!({
        "type": "string",
        "pattern": r"^(auto|(box|exact|mm|hs|(hs\+)?sat-[enpv]{1,4})(\+cone(-sat)?)?)$",
        "examples": ["auto", "hs", "hs+sat-n", "hs+sat-epv", "exact", "mm", "box", "exact+cone", "hs+cone-sat"]
    }))
}

pub(super) fn attenuation(_: &mut SchemaGenerator) -> Schema {
    let names: Vec<Value> =
        Attenuation::ALL.iter().map(|name| name.to_string().into()).chain([Value::Null]).collect();
    json_schema!({ "enum": names })
}
