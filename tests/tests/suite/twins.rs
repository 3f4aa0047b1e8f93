//! Whole frames of the device against the CPU twins of what its shaders do, and the far plane, where marking and
//! shading might disagree.

use glam::DVec3;
use manylight::assign::{Clusters, Marking};
use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::cpu::{self, DepthImage, Marks, Visible};
use manylight::engine::{FramePlan, plan_frames};
use manylight::geometry::Frustum;
use manylight::geometry::views::View;
use manylight::inputs::Inputs;
use manylight::lights::{Attenuation, GeneratorKind, Light, LightMotion, Lighting, Spot};
use manylight::material::MaterialModel;
use manylight::measure::{ClusterRecord, ViewPixels};
use manylight::methods::grid::twin;
use manylight::shading::{Shading, ShadingPipeline};
use manylight_tests::{Run, run, unpacked};
use std::path::Path;

/// Writes a scene: a square 200 m wide at world z = -`distance`, facing +Z, white and rough.
fn write_square(path: &Path, distance: f32) {
    let corners = [[-100.0, -100.0], [100.0, -100.0], [100.0, 100.0], [-100.0f32, 100.0]];
    let mut bytes: Vec<u8> =
        corners.iter().flat_map(|&[x, y]| [x, y, -distance]).flat_map(f32::to_le_bytes).collect();
    bytes.extend([0u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes));
    std::fs::write(path.with_extension("bin"), bytes).unwrap();
    let gltf = serde_json::json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "materials": [{ "pbrMetallicRoughness": { "metallicFactor": 0.0 } }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
              "min": [-100.0, -100.0, -distance], "max": [100.0, 100.0, -distance] },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 }
        ],
        "buffers": [{ "byteLength": 60, "uri": path.with_extension("bin").file_name().unwrap().to_str() }]
    });
    std::fs::write(path, gltf.to_string()).unwrap();
}

/// A square at `distance` before a camera in the world's origin that looks along -Z and sees `near` to `far`, with one
/// light halfway; one frame. The files live as long as the directory.
fn square(directory: &Path, distance: f32, [near, far]: [f64; 2], light: &Light) -> Config {
    let file = |name: &str| directory.join(name).to_str().unwrap().to_owned();
    write_square(Path::new(&file("square.gltf")), distance);
    let waypoints = serde_json::json!({
        "format": "manylight.waypoints/1", "dt_s": 0.5, "near": near, "far": far, "fov": 1.2,
        "waypoints": [
            { "position": [0, 0, 0], "target": [0, 0, -1], "time_s": 0 },
            { "position": [0, 0, 1], "target": [0, 0, -1], "time_s": 1 }
        ]
    });
    std::fs::write(file("waypoints.json"), waypoints.to_string()).unwrap();
    let recording = manylight::recording::bake(file("waypoints.json")).unwrap();
    recording.save(file("still.json")).unwrap();
    let Light { position: [x, y, z], intensity, cutoff, r0, .. } = light;
    let cone = light.spot.map_or(",,,,".into(), |Spot { direction: [x, y, z], inner, outer }| {
        format!("{x},{y},{z},{},{}", inner.to_degrees(), outer.to_degrees())
    });
    let header = "x,y,z,r,g,b,i,i0,r0,dx,dy,dz,inner,outer";
    let row = format!("{header}\n{x},{y},{z},1,1,1,{intensity},{cutoff},{r0},{cone}\n");
    std::fs::write(file("lights.csv"), row).unwrap();
    Config {
        scene: file("square.gltf"),
        recording: file("still.json"),
        lights: vec![],
        lights_file: Some(file("lights.csv").into()),
        resolution: [32, 18],
        frames: FrameRange { first: 0, end: Some(1), step: 1 },
        runs: 0.into(),
        exr: ExrFrames::All,
        ..Config::default()
    }
}

fn plan(config: &Config) -> FramePlan {
    let inputs = Inputs::load(config).unwrap();
    plan_frames(config, &inputs.recording).unwrap().remove(0)
}

/// Reversed depth as the device stored it, but for the last bits.
fn depths(pixels: &ViewPixels, view: &View) -> Vec<f32> {
    let [near, far] = [-view.frustum.z1, -view.frustum.z0];
    let depth = |&distance: &f32| match distance.is_finite() {
        true => (near * (far - f64::from(distance)) / (f64::from(distance) * (far - near))) as f32,
        false => 0.0,
    };
    pixels.depth.iter().map(depth).collect()
}

/// Clusters whose fragments on the device differ from the twin's by more than those too close to call.
fn wrong_clusters(marks: &Marks, clusters: &[ClusterRecord]) -> Vec<u32> {
    let mut device = vec![0; marks.fragments.len()];
    clusters.iter().for_each(|cluster| device[cluster.index as usize] = cluster.fragments);
    (0..device.len())
        .filter(|&c| marks.fragments[c].abs_diff(device[c]) > marks.borderline[c])
        .map(|c| c as u32)
        .collect()
}

/// Marks frame 300 of a recording by `method` on the device and by the twin, clustering by clustering.
fn compare_marks(recording: &str, method: &str, marking: Marking) {
    let directory = tempfile::tempdir().unwrap();
    for name in ["street.gltf", "scene_gltf.bin"] {
        std::fs::write(directory.path().join(name), unpacked(&format!("reference/{name}"))).unwrap();
    }
    let config = Config {
        scene: directory.path().join("street.gltf").to_str().unwrap().to_owned(),
        recording: recording.to_owned(),
        methods: vec![method.parse().unwrap()],
        resolution: [160, 90],
        marking,
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        runs: 0.into(),
        exr: ExrFrames::All,
        ..Config::default()
    };
    let plan = plan(&config);
    let run = run(config).remove(0);
    let images = &run.images[0].1;
    let views_of_grid = plan.views.len() / plan.grids.len();
    for (c, grid) in plan.grids.iter().enumerate() {
        let mut marks = Marks::none(grid);
        let views = images.iter().zip(&plan.views).skip(c * views_of_grid).take(views_of_grid);
        for (pixels, view) in views {
            let depths = depths(pixels, view);
            let image =
                DepthImage { resolution: [160, 90], sample_positions: &[[0.5, 0.5]], depths: &depths };
            cpu::mark(image, view, grid, 1e-3, &mut marks);
        }
        let clusters = &run.counts[0].clusterings[c].clusters;
        assert!(clusters.len() > 10, "{method} marks next to nothing");
        assert_eq!(wrong_clusters(&marks, clusters), [0; 0], "{method}, clustering {c}");
        let (unsure, all): (u32, u32) = (marks.borderline.iter().sum(), marks.fragments.iter().sum());
        assert!(unsure * 10 < all, "{method}: {unsure} of {all} fragments are too close to call");
    }
}

#[test]
fn marks_equal_their_twin() {
    compare_marks("bistro", "indi-persp-16", Marking::Depth);
    compare_marks("bistro-vive", "encl-ortho-4", Marking::Depth);
    compare_marks("bistro-vive", "indi-displ-16-32", Marking::Geometry);
}

/// The lists of a whole frame by `method`, for visible or for all clusters, on the device and by the family's twin.
fn compare_lists(method: &str, clusters: Clusters) {
    compare_lists_of(config_of_lists(method, clusters));
}

fn config_of_lists(method: &str, clusters: Clusters) -> Config {
    Config {
        methods: vec![method.parse().unwrap()],
        clusters: vec![clusters.into()],
        resolution: [160, 90],
        lights: vec![Lighting::with_count(2000)],
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        runs: 0.into(),
        ..Config::default()
    }
}

fn compare_lists_of(config: Config) {
    let method = config.methods[0];
    let clusters = config.clusters[0].of(&method);
    let inputs = Inputs::load(&config).unwrap();
    let lights = inputs.light_source(&config.lights_of_run()).unwrap().at_frame(300).list.to_vec();
    let (plan, test) = (plan(&config), config.test[0].of(&config.methods[0]));
    let run = run(config).remove(0);
    for (c, grid) in plan.grids.iter().enumerate() {
        let mut fragments = vec![0; grid.cluster_count() as usize];
        for cluster in &run.counts[0].clusterings[c].clusters {
            fragments[cluster.index as usize] = cluster.fragments;
        }
        let listed = twin::listed_clusters(grid, clusters, &fragments);
        let device: Vec<u32> = run.counts[0].clusterings[c].clusters.iter().map(|c| c.index).collect();
        assert_eq!(device, listed, "{method} {clusters}");
        let lists = twin::light_lists(Visible { grid, clusters: &listed }, &lights, test, 1e-3);
        for place in 0..listed.len() {
            let sure = |list: &[u32]| -> Vec<u32> {
                let close = &lists.borderline[place];
                list.iter().copied().filter(|light| !close.contains(light)).collect()
            };
            assert_eq!(sure(run.lists[c].list(place)), sure(lists.list(place)), "{method} {clusters}");
        }
        let close: usize = lists.borderline.iter().map(Vec::len).sum();
        assert!(lists.indices.len() > 300 && close * 100 < lists.indices.len(), "{method}: {close}");
    }
}

#[test]
fn lists_of_frames_equal_their_twin() {
    compare_lists("tiled-16", Clusters::Visible);
    compare_lists("tiled-16", Clusters::All);
    compare_lists("encl-persp-32", Clusters::All);
    compare_lists("indi-ortho-8", Clusters::Visible);
}

#[test]
fn lists_of_lights_that_other_generators_make_equal_their_twin() {
    let config = config_of_lists("indi-persp-32", Clusters::Visible);
    let gamma = Config {
        light_source: GeneratorKind::Gamma,
        light_motion: Some(LightMotion::Bounce),
        light_radius_mean: Some(3.0),
        ..config.clone()
    };
    compare_lists_of(gamma);
    let volumes = ["scene:10x5x10", "-20,0,-20,20,8,20:5x10x10:0,0.5,0,1:6"];
    compare_lists_of(Config {
        light_source: GeneratorKind::Volume,
        light_volumes: volumes.map(|text| text.parse().unwrap()).to_vec(),
        light_set: Some("1x_1y_2z".parse().unwrap()),
        ..config
    });
}

/// What fragments on the far plane cost: it is where the depth buffer is cleared to, and seen by the test for equal
/// depth but not by marking from depth.
#[test]
fn the_far_plane_has_no_fragment_without_a_cluster() {
    let light = Light::new([0.0, 0.0, -6.0], [1.0; 3], 20.0, 0.5, 0.1);
    for marking in [Marking::Depth, Marking::Geometry] {
        for msaa in [1, 4] {
            let directory = tempfile::tempdir().unwrap();
            // Halves and eighths, so that depth comes out as 0 exactly.
            let config = square(directory.path(), 8.0, [0.5, 8.0], &light);
            let methods = ["all-lights", "indi-persp-8", "indi-ortho-1"];
            let methods = methods.map(|name| name.parse().unwrap()).to_vec();
            let runs = run(Config { methods, marking, msaa, ..config });
            for run in &runs {
                assert_eq!(
                    run.counts[0].counters.fragments_without_cluster, 0,
                    "{} {marking:?} {msaa}",
                    run.planned.name
                );
                let [color, truth] = [run, &runs[0]].map(|run| &run.images[0].1[0].color);
                assert_eq!(color, truth, "{} {marking:?} {msaa}", run.planned.name);
            }
        }
    }
}

/// Red of a pixel less the even ambient light on white.
fn lit(run: &Run, pixel: usize) -> f64 {
    f64::from(run.images[0].1[0].color[pixel][0].to_f32()) - 0.02
}

/// The point at `distance` metres along -Z in the centre of a pixel of 32 x 18.
fn point_of(frustum: &Frustum, pixel: usize, distance: f64) -> [f64; 3] {
    let [across, down] = [(pixel % 32) as f64 + 0.5, (pixel / 32) as f64 + 0.5];
    let x = frustum.x0 + (frustum.x1 - frustum.x0) * across / 32.0;
    let y = frustum.y1 + (frustum.y0 - frustum.y1) * down / 18.0;
    [x * distance, y * distance, -distance]
}

fn distance_to(light: &Light, point: [f64; 3]) -> f64 {
    point.iter().zip(light.position).map(|(a, b)| (a - f64::from(b)).powi(2)).sum::<f64>().sqrt()
}

/// The same light on the same surface: pixels of two functions are to each other as the functions are.
#[test]
fn attenuations_equal_their_twin() {
    let light = Light::new([0.3, 0.2, -4.0], [1.0; 3], 8.0, 0.5, 0.1);
    let directory = tempfile::tempdir().unwrap();
    let config = Config {
        methods: vec!["indi-persp-8".parse().unwrap()],
        ..square(directory.path(), 5.0, [0.4, 20.0], &light)
    };
    let frustum = plan(&config).views[0].frustum;
    let shaded = |attenuation| run(Config { attenuation, ..config.clone() }).remove(0);
    let physical = shaded(Attenuation::Phy);
    for function in Attenuation::ALL {
        let run = shaded(function);
        let mut compared = 0;
        for pixel in 0..32 * 18 {
            let distance = distance_to(&light, point_of(&frustum, pixel, 5.0));
            let [twin, reference] =
                [function, Attenuation::Phy].map(|f| cpu::attenuation(f, &light, distance));
            if (distance - f64::from(light.r1)).abs() < 0.05 {
                continue;
            }
            if reference == 0.0 {
                assert!(lit(&run, pixel).abs() < 1e-3, "{function:?} lights beyond its reach");
                continue;
            }
            let expected = lit(&physical, pixel) * twin / reference;
            // Half floats, and position from depth.
            let tolerance = 0.01 * expected + 2e-4;
            assert!(
                (lit(&run, pixel) - expected).abs() < tolerance,
                "{function:?} at {distance} m: {} instead of {expected}",
                lit(&run, pixel)
            );
            compared += 1;
        }
        assert!(compared > 50, "only {compared} pixels are lit");
    }
}

/// A spot light shows what the point light in its place does, times its cone's falloff; narrow and wide, along the surface's normal
/// and across it.
#[test]
fn cones_equal_their_twin() {
    let point = Light::new([0.3, 0.2, -3.0], [1.0; 3], 8.0, 0.5, 0.1);
    let directory = tempfile::tempdir().unwrap();
    let config = |light: &Light| Config {
        methods: ["all-lights", "indi-persp-8", "hashed-0.5-1"].map(|name| name.parse().unwrap()).to_vec(),
        pipeline: vec![ShadingPipeline::Forward, ShadingPipeline::Deferred],
        ..square(directory.path(), 5.0, [0.4, 20.0], light)
    };
    let frustum = plan(&config(&point)).views[0].frustum;
    let all_around = run(config(&point)).remove(0);
    for (direction, degrees) in [
        ([0.0, 0.0, -1.0], [10.0_f32, 30.0]),
        ([0.5, 0.2, -1.0], [40.0, 40.0]),
        ([1.0, 0.0, 0.0], [0.0, 85.0]),
    ] {
        let [inner, outer] = degrees.map(f32::to_radians);
        let spot = point.shining(Some(Spot::new(direction, inner, outer)));
        for run in run(config(&spot)) {
            let name = &run.planned.name;
            let (mut lit_pixels, mut needed) = (0, 0);
            for pixel in 0..32 * 18 {
                let part = spot.cone_part(DVec3::from_array(point_of(&frustum, pixel, 5.0)));
                let expected = lit(&all_around, pixel) * part;
                // Where a cone ends at once, the last bits of a position decide.
                let edge = if inner < outer { 0.0 } else { 0.3 * expected };
                let tolerance = 0.01 * expected + 4e-3 + edge;
                assert!(
                    (lit(&run, pixel) - expected).abs() < tolerance,
                    "{name} {degrees:?}: {} instead of {expected}",
                    lit(&run, pixel)
                );
                lit_pixels += u64::from(expected > 0.02);
                needed += u64::from(lit(&run, pixel) > 2e-3);
            }
            let counted = run.counts[0].counters.needed_computations;
            assert!(
                lit_pixels > 20 && counted >= needed && counted < 32 * 18,
                "{name} {lit_pixels} {counted}"
            );
        }
    }
}

/// White surfaces show 0.1 + 0.9 n.l (1 - d/R1)^2, nothing of a Cook-Torrance reflection and no 1/pi.
#[test]
fn the_white_material_equals_its_formula() {
    let light = Light::new([0.3, 0.2, -4.0], [1.0; 3], 8.0, 0.5, 0.1);
    let directory = tempfile::tempdir().unwrap();
    let config = Config {
        methods: vec!["indi-persp-8".parse().unwrap()],
        material: MaterialModel::White,
        attenuation: Attenuation::Tegelaers,
        ..square(directory.path(), 5.0, [0.4, 20.0], &light)
    };
    let frustum = plan(&config).views[0].frustum;
    let run = run(config).remove(0);
    let mut lit = 0;
    for pixel in 0..32 * 18 {
        let point = point_of(&frustum, pixel, 5.0);
        let distance = distance_to(&light, point);
        let facing = (f64::from(light.position[2]) - point[2]) / distance;
        let reach = (1.0 - distance / f64::from(light.r1)).clamp(0.0, 1.0);
        let expected = 0.1 + 0.9 * facing * reach.powi(2);
        let shown = f64::from(run.images[0].1[0].color[pixel][1].to_f32());
        assert!((shown - expected).abs() < 2e-3, "{shown} instead of {expected} at {distance} m");
        lit += u32::from(expected > 0.15);
    }
    assert!(lit > 50, "only {lit} pixels are lit");
}

/// On the street, whose surfaces have textures of all kinds, no texture shows where nothing is lit; what is cut out and what
/// lights do is the same.
#[test]
fn no_texture_of_a_white_street_shows_but_alpha() {
    let dark = Lighting { intensity: 1e-4, cutoff: 1.0, r0: 1e-3, ..Lighting::with_count(1) };
    let config = |material, lighting| Config {
        scene: "street".into(),
        recording: "bistro".into(),
        methods: vec!["indi-persp-32".parse().unwrap()],
        shading: vec![Shading::Prepass, Shading::Overdraw],
        lights: vec![lighting],
        resolution: [64, 36],
        frames: FrameRange { first: 300, end: Some(301), step: 1 },
        runs: 0.into(),
        exr: ExrFrames::All,
        material,
        ..Config::default()
    };
    for run in run(config(MaterialModel::White, dark)) {
        let ViewPixels { color, background, .. } = &run.images[0].1[0];
        // What a pixel shows of surfaces is before the background as far as it is covered.
        let off = |pixel: &[f32; 4], k: usize| pixel[k] - background[k] * (1.0 - pixel[3]) - 0.1 * pixel[3];
        let pixels = color.iter().map(|pixel| pixel.map(|value| value.to_f32()));
        let worst = pixels.flat_map(|pixel| [0, 1, 2].map(|k| off(&pixel, k).abs())).fold(0.0, f32::max);
        assert!(worst < 1e-3 && color.len() == 64 * 36, "{}: {worst}", run.planned.name);
    }
    let both = [MaterialModel::Textured, MaterialModel::White]
        .map(|material| run(config(material, Lighting::with_count(1000))));
    for (textured, white) in both[0].iter().zip(&both[1]) {
        assert_eq!(textured.counts, white.counts);
        let [textured, white] = [textured, white].map(|run| &run.images[0].1[0]);
        assert_eq!(textured.depth, white.depth);
        assert_ne!(textured.color, white.color);
    }
}
