//! The product of axes, names on them, and rules that exclude.

use super::*;
use crate::assign::{Compaction, Conservative, ListStore};
use crate::config::{Assign, Exclude};
use crate::config::{Choice, Lighting};
use crate::methods::OctreeWay;
use crate::shading::{Shading, ShadingPipeline};
use std::collections::BTreeSet;

/// Several values on every axis.
fn everything() -> Config {
    let read = |name: &str| name.parse().unwrap();
    Config {
        scenes: ["street=bistro", "temple=suntem"].map(|text| text.parse().unwrap()).to_vec(),
        resolutions: vec![[8, 4], [16, 16]],
        lights: vec![Lighting::with_count(1), Lighting::with_count(20)],
        methods: ["indi-persp-64", "encl-ortho-4", "all-lights", "hashed-1-3", "raster-2-2-2-e"]
            .map(read)
            .to_vec(),
        assign: vec![Assign::Brute, Assign::Scatter],
        test: ["auto", "hs", "exact"].map(|name| name.parse().unwrap()).to_vec(),
        clusters: vec![Clusters::Visible.into(), Clusters::All.into()],
        bounds: vec![Bounds::Measured.into(), Choice::Auto],
        normal_cones: ["0", "2"].map(|name| name.parse().unwrap()).to_vec(),
        slices: vec![Choice::Auto, SliceLaw::Geometric.into(), SliceLaw::Linear.into()],
        shading: vec![Shading::Prepass, Shading::Overdraw],
        pipeline: vec![ShadingPipeline::Forward, ShadingPipeline::Deferred],
        lists: vec![ListStore::Offsets, ListStore::Fixed(8)],
        compaction: vec![Compaction::Ranks, Compaction::Atomic],
        conservative: vec![Conservative::Software, Conservative::Compute],
        mesh_detail: ["12", "auto-0.25"].map(|name| name.parse().unwrap()).to_vec(),
        octree: vec![OctreeWay::Rebuild, OctreeWay::Seed(7)],
        ..Config::default()
    }
}

fn runs() -> Vec<Config> {
    everything().by_scene().iter().flat_map(Config::cases).collect()
}

#[test]
fn the_product_has_every_combination_that_differs_once() {
    // Of three tests, Persp has its own under two names and Ortho has not, and so it is of slices, which Ortho has none of;
    // the third method knows no ways of assignment, the fourth but two of making octrees, and the fifth neither ways of assignment nor
    // tests but two of rasterising, with two meshes. All are shaded in two ways by two pipelines.
    assert_eq!(
        runs().len(),
        2 * 2 * 2 * 2 * 2 * ((2 * 2 * 2 * 2 * 2 + 2 * 3 * 2 * 2) * 2 * 2 * 2 + 1 + 2 + 2 * 2 * 3 * 2 * 2 * 2)
    );
    for run in runs() {
        assert_eq!((run.by_scene(), run.cases()), (vec![run.clone()], vec![run]));
    }
}

#[test]
fn runs_of_a_scene_have_names_and_labels_of_their_own() {
    for scene in everything().by_scene() {
        let runs = scene.cases();
        let names: BTreeSet<String> = runs.iter().map(|run| run_name(run, &scene)).collect();
        let labels: BTreeSet<String> =
            runs.iter().map(|run| format!("{:?}", Labels::new(run, &scene))).collect();
        assert_eq!((names.len(), labels.len()), (runs.len(), runs.len()));
    }
}

#[test]
fn every_axis_has_a_value_where_it_applies() {
    for axis in &AXES {
        for run in runs() {
            let value = axis.value(&run);
            assert_eq!(value.is_empty(), !(axis.applies)(&run.methods[0]), "{axis:?}: {value}");
        }
    }
    let value = |name: &str| Axis::named(name).unwrap().value(&runs()[0]);
    let known = ["scene", "recording", "resolution", "lights", "method", "test"].map(value);
    assert_eq!(known, ["street", "bistro", "8x4", "1", "indi-persp-64", "hs"]);
}

#[test]
fn a_rule_of_every_axis_leaves_out_the_runs_it_names_alone() {
    let of = |axis: &Axis, run: &Config| match (axis.applies)(&run.methods[0]) {
        true => (axis.called)(run),
        false => vec![],
    };
    for axis in &AXES {
        let values: BTreeSet<String> = runs().iter().flat_map(|run| of(axis, run)).collect();
        assert!(values.len() > 1, "{axis:?}");
        for value in values {
            let rule: Exclude = format!("{}={value}", axis.name).parse().unwrap();
            for run in runs() {
                assert_eq!(rule.matches(&run), of(axis, &run).contains(&value), "{rule} {}", run.scene);
            }
        }
    }
}
