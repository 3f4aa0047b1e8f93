//! Surfaces of files, drawn: alpha at the cut-off, flat nodes, unlit materials.

use manylight::assign::Marking;
use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::shading::{Shading, ShadingPipeline};
use manylight_tests::{Run, methods, run};
use serde_json::{Value, json};
use std::path::Path;

/// Writes a scene: a square 2 m wide in the node's z = 0 plane, facing +Z, whose vertices have the alpha `alpha`.
fn write_square(path: &Path, node: Value, material: Value, alpha: u8) {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0f32, 1.0]];
    let mut bytes: Vec<u8> =
        corners.iter().flat_map(|&[x, y]| [x, y, 0.0]).flat_map(f32::to_le_bytes).collect();
    bytes.extend([0u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes));
    bytes.extend([255, 255, 255, alpha].repeat(4));
    std::fs::write(path.with_extension("bin"), bytes).unwrap();
    let gltf = json!({
        "asset": { "version": "2.0" },
        "nodes": [node],
        "materials": [material],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "COLOR_0": 2 }, "indices": 1, "material": 0 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" },
            { "bufferView": 2, "componentType": 5121, "count": 4, "type": "VEC4", "normalized": true }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 },
            { "buffer": 0, "byteOffset": 60, "byteLength": 16 }
        ],
        "buffers": [{ "byteLength": 76, "uri": path.with_extension("bin").file_name().unwrap().to_str() }]
    });
    std::fs::write(path, gltf.to_string()).unwrap();
}

/// The square seen aslant under two lights, by all lights and by clusters, each after a prepass and with overdraw, forward and, where
/// samples lie where they are marked, deferred.
fn draw(node: Value, material: Value, alpha: u8, samples: (u32, Marking)) -> Vec<Run> {
    let directory = tempfile::tempdir().unwrap();
    let file = |name: &str| directory.path().join(name).to_str().unwrap().to_owned();
    write_square(Path::new(&file("square.gltf")), node, material, alpha);
    let waypoint = |time: u32| json!({ "position": [1, 0.7, 3.5], "target": [0, 0, 0], "time_s": time });
    let waypoints = json!({
        "format": "manylight.waypoints/1", "dt_s": 0.5, "near": 0.1, "far": 100, "fov": 0.95,
        "waypoints": [waypoint(0), waypoint(1)]
    });
    std::fs::write(file("waypoints.json"), waypoints.to_string()).unwrap();
    manylight::recording::bake(file("waypoints.json")).unwrap().save(file("still.json")).unwrap();
    let lights = "x,y,z,r,g,b,i,i0,r0\n1,1,1,1,1,1,8,0.1,0.1\n-1,0,2,1,1,1,8,0.1,0.1\n";
    std::fs::write(file("lights.csv"), lights).unwrap();
    run(Config {
        scene: file("square.gltf"),
        recording: file("still.json"),
        methods: methods(&["all-lights", "indi-persp-64"]),
        shading: vec![Shading::Prepass, Shading::Overdraw],
        pipeline: match samples.1 {
            Marking::Depth => vec![ShadingPipeline::Forward, ShadingPipeline::Deferred],
            Marking::Geometry => vec![ShadingPipeline::Forward],
        },
        lights: vec![],
        lights_file: Some(file("lights.csv").into()),
        resolution: [160, 120],
        msaa: samples.0,
        marking: samples.1,
        frames: FrameRange { first: 0, end: Some(1), step: 1 },
        runs: 0.into(),
        exr: ExrFrames::All,
        ..Config::default()
    })
}

fn fragments(runs: &[Run]) -> Vec<u64> {
    runs.iter().map(|run| run.counts[0].counters.fragments_shaded).collect()
}

#[test]
fn alpha_equal_to_the_cutoff_is_opaque() {
    let node = || json!({ "mesh": 0 });
    let masked = |cutoff: f32| json!({ "alphaMode": "MASK", "alphaCutoff": cutoff });
    for samples in [(1, Marking::Depth), (4, Marking::Depth), (4, Marking::Geometry)] {
        let whole = fragments(&draw(node(), json!({}), 255, samples));
        assert!(whole[0] > 6000 && whole == vec![whole[0]; whole.len()], "{whole:?}");
        // The next number above the alpha is the first that discards.
        for alpha in [255, 128, 77] {
            let equal = f32::from(alpha) / 255.0;
            assert_eq!(fragments(&draw(node(), masked(equal), alpha, samples)), whole, "{alpha} {samples:?}");
            let cut_out = fragments(&draw(node(), masked(equal.next_up()), alpha, samples));
            assert_eq!(cut_out, vec![0; whole.len()], "{alpha}");
        }
    }
}

#[test]
fn a_node_without_depth_is_as_one_with() {
    let scaled =
        |scale: [u32; 3]| draw(json!({ "mesh": 0, "scale": scale }), json!({}), 255, (1, Marking::Depth));
    let (flat, full) = (scaled([1, 1, 0]), scaled([1, 1, 1]));
    assert!(fragments(&flat)[0] > 0 && fragments(&flat) == fragments(&full));
    for (flat, full) in flat.iter().zip(&full) {
        assert!(flat.images[0].1[0].color == full.images[0].1[0].color, "another picture");
    }
}

#[test]
fn unlit_surfaces_radiate_their_base_colour_and_no_light_is_evaluated() {
    let material = |extensions: Value| {
        json!({
            "pbrMetallicRoughness": { "baseColorFactor": [0.25, 0.5, 1, 1] },
            "emissiveFactor": [1, 1, 1], "extensions": extensions
        })
    };
    let drawn = |extensions| draw(json!({ "mesh": 0 }), material(extensions), 255, (1, Marking::Depth));
    let (unlit, lit) = (drawn(json!({ "KHR_materials_unlit": {} })), drawn(json!({})));
    assert_eq!(fragments(&unlit), fragments(&lit));
    for (unlit, lit) in unlit.iter().zip(&lit) {
        let (counts, pixels) = (&unlit.counts[0], &unlit.images[0].1[0]);
        assert_eq!((counts.counters.lighting_computations, counts.counters.needed_computations), (0, 0));
        let visible = |run: &Run| run.counts[0].clusterings.iter().map(|c| c.visible_clusters).sum::<u64>();
        assert_eq!(visible(unlit), visible(lit), "they mark clusters as any surface does");
        let colors = pixels.color.iter().zip(&pixels.depth).filter(|(_, depth)| depth.is_finite());
        for (color, _) in colors {
            let [r, g, b, _] = color.map(|x| x.to_f32());
            assert!([r - 0.25, g - 0.5, b - 1.0].iter().all(|d| d.abs() < 1e-3), "{color:?}");
        }
    }
}
