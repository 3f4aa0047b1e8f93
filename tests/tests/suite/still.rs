//! Stills: the onlooker changes nothing, sees the grid where it is, and draws what it is asked for.

use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};
use manylight::config::{Config, ExrFrames, FrameRange};
use manylight::engine::{FramePlan, plan_frames};
use manylight::inputs::Inputs;
use manylight::lights::{GeneratorKind, Lighting};
use manylight::output::planned_runs;
use manylight::shading::{Shading, ShadingPipeline};
use manylight::still::{Item, Look, Placed, Show, Still, Viewpoint, render};
use manylight_tests::run;
use manylight_tests::scenes::{recording, write_quads};

const FRAME: u32 = 300;

fn config(recording: &str, method: &str) -> Config {
    Config {
        recording: recording.into(),
        methods: vec![method.parse().unwrap()],
        lights: vec![Lighting::with_count(100)],
        resolution: [96, 64],
        frames: FrameRange { first: FRAME, end: Some(FRAME + 1), step: 1 },
        runs: 0.into(),
        validate: true,
        ..Config::default()
    }
}

fn still(config: &Config, inputs: &Inputs, view: Option<&str>, items: &[Item]) -> Still {
    seen_from(config, inputs, Viewpoint::Named(view), items)
}

fn seen_from(config: &Config, inputs: &Inputs, viewpoint: Viewpoint, items: &[Item]) -> Still {
    let show = Show::from_items(items, None).unwrap();
    render(inputs, &planned_runs(config)[0], viewpoint, &show).unwrap_or_else(|error| panic!("{error}"))
}

fn plan(config: &Config, inputs: &Inputs) -> FramePlan {
    plan_frames(config, &inputs.recording).unwrap().remove(0)
}

/// The world position of a pixel's centre.
fn world(still: &Still, pixel: usize) -> DVec3 {
    let pixels = &still.pixels;
    let (x, y) = (pixel as u32 % pixels.width, pixel as u32 / pixels.width);
    let ndc = DVec2::new(
        2.0 * (f64::from(x) + 0.5) / f64::from(pixels.width) - 1.0,
        1.0 - 2.0 * (f64::from(y) + 0.5) / f64::from(pixels.height),
    );
    let ahead = pixels.clip_from_view.inverse().project_point3(ndc.extend(1.0));
    let local = ahead * (f64::from(pixels.depth[pixel]) / -ahead.z);
    pixels.world_from_view.transform_point3(local)
}

/// Where a world position lies in the picture, pixels; `None` outside.
fn pixel_of(still: &Still, world: DVec3) -> Option<(u32, u32)> {
    let pixels = &still.pixels;
    let clip = pixels.clip_from_view * pixels.world_from_view.inverse() * world.extend(1.0);
    let ndc = clip.truncate() / clip.w;
    let x = (ndc.x + 1.0) / 2.0 * f64::from(pixels.width);
    let y = (1.0 - ndc.y) / 2.0 * f64::from(pixels.height);
    let inside = clip.w > 0.0
        && (1.0..f64::from(pixels.width) - 1.0).contains(&x)
        && (1.0..f64::from(pixels.height) - 1.0).contains(&y);
    inside.then_some((x as u32, y as u32))
}

#[test]
fn an_onlooker_sees_the_clusters_where_the_host_says_and_counts_as_a_replay() {
    for method in ["encl-displ-64-32", "encl-ortho-4"] {
        let config = config("bistro-vive", method);
        let inputs = Inputs::load(&config).unwrap();
        let seen = still(&config, &inputs, Some("birdseye"), &[Item::Clusters]);
        assert_eq!(seen.counts, run(config.clone()).remove(0).counts[0], "{method}");
        let grid = plan(&config, &inputs).grids[0];
        let clustered: Vec<usize> =
            (0..seen.pixels.depth.len()).filter(|&p| seen.pixels.cluster_index[p] != u32::MAX).collect();
        let agree = clustered
            .iter()
            .filter(|&&pixel| {
                let cluster = grid.cluster_of(world(&seen, pixel)).map(|cell| grid.linear(cell));
                cluster == Some(seen.pixels.cluster_index[pixel])
            })
            .count();
        assert!(clustered.len() > 200, "{method}: {} pixels with clusters", clustered.len());
        // The rest lies on the border of a cluster, where single and double precision part.
        assert!(100 * agree >= 99 * clustered.len(), "{method}: {agree} of {}", clustered.len());
        let hit = seen.pixels.depth.iter().filter(|depth| depth.is_finite()).count();
        assert!(hit > clustered.len(), "{method}: from above, something has no visible cluster");
    }
}

#[test]
fn the_views_of_the_recording_miss_no_cluster_and_onlookers_do() {
    let config = config("bistro-vive", "indi-persp-64");
    let inputs = Inputs::load(&config).unwrap();
    let magenta =
        |still: &Still| still.image.pixels().filter(|p| p[0] > 60 && p[1] == 0 && p[0] == p[2]).count();
    for view in ["left", "right"] {
        let seen = still(&config, &inputs, Some(view), &[Item::Missing, Item::LightCount]);
        assert_eq!(magenta(&seen), 0, "{view}");
        let known = seen.pixels.cluster_index.iter().zip(&seen.pixels.depth);
        assert!(known.clone().any(|(_, depth)| depth.is_finite()));
        assert!(known.into_iter().all(|(&cluster, depth)| (cluster == u32::MAX) == depth.is_infinite()));
        assert!(seen.pixels.fragment_count.iter().any(|&count| count > 0));
    }
    let seen = still(&config, &inputs, Some("birdseye"), &[Item::Missing]);
    assert!(magenta(&seen) > 100);
}

#[test]
fn frusta_reach_their_corners_and_lights_tint_the_picture() {
    let config = Config { msaa: 4, ..config("bistro", "indi-displ-64-32") };
    let inputs = Inputs::load(&config).unwrap();
    let plain = still(&config, &inputs, Some("birdseye"), &[]);
    let lines = still(&config, &inputs, Some("birdseye"), &[Item::Frusta]);
    let differs = |a: &Still, (x, y): (u32, u32)| {
        (x - 1..=x + 1)
            .flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)))
            .any(|(x, y)| a.image.get_pixel(x, y) != plain.image.get_pixel(x, y))
    };
    let plan = plan(&config, &inputs);
    // Corners of the near plane, and points of the edges that lead to the far one.
    let (near, far) = (plan.views[0].frustum.near_corners(), plan.views[0].frustum.far_corners());
    let points = (0..4).flat_map(|i| [0.0, 0.05, 0.1, 0.2, 0.5, 1.0].map(|part| near[i].lerp(far[i], part)));
    let corners: Vec<_> = points.map(|point| plan.views[0].pose.transform_point(point)).collect();
    let visible: Vec<_> = corners.iter().filter_map(|&corner| pixel_of(&lines, corner)).collect();
    assert!(visible.len() >= 12, "{visible:?}");
    assert!(visible.iter().all(|&corner| differs(&lines, corner)), "{visible:?}");
    let lights = still(&config, &inputs, Some("birdseye"), &[Item::Lights]);
    let changed = lights.image.pixels().zip(plain.image.pixels()).filter(|(a, b)| a != b).count();
    assert!(changed > 500, "{changed}");
    assert_eq!(lights.pixels.depth, plain.pixels.depth, "what is drawn over a picture has no depth");
}

/// How many entries a picture of hash tables has of a colour. Its margin, 4 entries wide, tells how large entries are.
fn entries_of(table: &RgbImage, color: Rgb<u8>) -> u64 {
    let gap = *table.get_pixel(0, 0);
    let is_gap = |x: &u32| (0..table.height()).all(|y| *table.get_pixel(*x, y) == gap);
    let margin = (0..table.width()).take_while(is_gap);
    let scale = margin.count() as u64 / 4;
    assert!(scale > 0, "there is a margin");
    table.pixels().filter(|pixel| **pixel == color).count() as u64 / (scale * scale)
}

#[test]
fn an_octree_is_shown_by_its_leaves_and_by_its_tables() {
    let config = Config { lights: vec![Lighting::with_count(10)], ..config("bistro-vive", "hashed-2-2") };
    let inputs = Inputs::load(&config).unwrap();
    let shown = |items: &[Item]| still(&config, &inputs, Some("birdseye"), items);
    let [plain, lines, tables] = [&[][..], &[Item::Octree], &[Item::Hash]].map(shown);
    assert!(plain.counts == lines.counts && plain.counts == tables.counts, "looking changes nothing");
    let drawn = plain.image.pixels().zip(lines.image.pixels()).filter(|(a, b)| a != b).count();
    assert!(drawn > 100, "edges of leaves are drawn: {drawn}");
    assert!(plain.image == tables.image && plain.tables.is_empty() && lines.tables.is_empty());
    let depths: Vec<u32> = tables.tables.iter().map(|table| table.depth).collect();
    assert!(!depths.is_empty() && depths.iter().copied().eq((2..).take(depths.len())), "{depths:?}");
    let leaf = Rgb([86, 180, 233]);
    let leaves: u64 = tables.tables.iter().map(|table| entries_of(&table.image, leaf)).sum();
    assert_eq!(leaves, tables.counts.visible_clusters());
}

#[test]
fn the_clusters_of_each_light_add_up_to_what_lists_hold() {
    for (method, lists) in
        [("raster-24-12-32-e", "linked-32-unsorted"), ("sc-e-48-40", "fixed-4"), ("m", "offsets")]
    {
        // Far enough for some geometry, wherever they are.
        let lights = vec![Lighting { intensity: 1000.0, ..Lighting::with_count(2) }];
        let config = Config { lights, lists: vec![lists.parse().unwrap()], ..config("bistro", method) };
        let inputs = Inputs::load(&config).unwrap();
        let stills = [0, 1].map(|light| {
            let show = Show::from_items(&[Item::LightClusters], Some(light)).unwrap();
            render(&inputs, &planned_runs(&config)[0], Viewpoint::Named(None), &show).unwrap()
        });
        let clusters = stills.each_ref().map(|still| still.light.as_ref().unwrap().clusters);
        let listed = stills[0].counts.light_indices();
        assert!(
            listed > 0 && clusters.iter().sum::<u64>() == listed,
            "{method}, {lists}: {clusters:?} of {listed}"
        );
    }
}

/// The pixels that differ from the one in the corner: least and greatest x and y.
fn drawn(image: &RgbImage) -> Option<[u32; 4]> {
    let background = image.get_pixel(0, 0);
    let drawn = image.enumerate_pixels().filter(|(.., pixel)| *pixel != background);
    let places = drawn.map(|(x, y, _)| [x, y, x, y]);
    places.reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])])
}

/// From beside the camera, without the scene: what is drawn of clusters reaches around the mesh that is rasterised to them.
#[test]
fn the_clusters_of_a_light_are_drawn_around_its_mesh() {
    const SPOT: u32 = 113;
    let config = Config {
        scene: "hall".into(),
        spots: 0.5.try_into().unwrap(),
        lights: vec![Lighting { intensity: 5.5, ..Lighting::with_count(SPOT + 1) }],
        resolution: [192, 96],
        frames: FrameRange { first: 0, end: Some(1), step: 1 },
        ..config("aisle", "raster-24-12-64-e")
    };
    let inputs = Inputs::load(&config).unwrap();
    let beside = Viewpoint::Placed(Placed::new([0.0, 3.0, 14.0], [-2.0, 2.6, 2.2], None).unwrap());
    let shown = |item: Option<Item>, light| {
        let items: Vec<_> = item.into_iter().chain([Item::NoScene]).collect();
        let show = Show::from_items(&items, light).unwrap();
        render(&inputs, &planned_runs(&config)[0], beside, &show).unwrap()
    };
    let nothing = shown(None, None);
    assert_eq!(drawn(&nothing.image), None, "without the scene there are lines alone");
    let [mesh, cells] = [Item::LightMesh, Item::LightClusters].map(|item| shown(Some(item), Some(SPOT)));
    let apex = mesh.light.as_ref().unwrap().position.map(f64::from).into();
    let (x, y) = pixel_of(&mesh, apex).unwrap();
    assert_ne!(mesh.image.get_pixel(x, y), nothing.image.get_pixel(x, y), "the apex of the spot is drawn");
    let [mesh, cells, used] =
        [mesh, cells, shown(Some(Item::UsedClusters), None)].map(|still| drawn(&still.image).unwrap());
    // A line is two pixels wide.
    let holds = |outer: [u32; 4], inner: [u32; 4]| {
        (0..2).all(|at| outer[at] <= inner[at] + 1 && outer[at + 2] + 1 >= inner[at + 2])
    };
    assert!(mesh[2] - mesh[0] > 20 && mesh[3] - mesh[1] > 20, "{mesh:?}");
    assert!(holds(cells, mesh) && !holds(mesh, cells), "{cells:?} around {mesh:?}");
    assert!(holds(used, cells) && !holds(cells, used), "{used:?} around {cells:?}");
}

/// What clusters hold over a floor somewhere in the world.
fn lines_at(away: DVec3) -> RgbImage {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name);
    let at = |x: f64, y: f64, z: f64| (away + DVec3::new(x, y, z)).to_array();
    let floor = [[-9.0, 0.0, 3.0], [9.0, 0.0, 3.0], [9.0, 0.0, -15.0], [-9.0, 0.0, -15.0]];
    write_quads(&path("s.gltf"), &[floor], away.to_array(), &[]);
    let [x, y, z] = at(0.0, 1.0, 2.0);
    let rain_box = [at(-5.0, 0.0, -12.0), at(5.0, 4.0, -2.0)];
    let recording = recording([0.125, 32.0], [x, y, z, 0.0, 0.0, 0.0, 1.0, 1.3], rain_box, &[]);
    std::fs::write(path("r.json"), recording.to_string()).unwrap();
    let config = Config {
        scene: path("s.gltf").to_str().unwrap().into(),
        lights: vec![Lighting { count: 6, intensity: 2.0, cutoff: 0.5, r0: 0.01 }],
        frames: FrameRange { first: 0, end: Some(1), step: 1 },
        ..config(path("r.json").to_str().unwrap(), "raster-24-12-32-e")
    };
    let placed = Placed::new(at(9.0, 7.0, 6.0), at(0.0, 0.0, -7.0), None).unwrap();
    let items = [Item::UsedClusters, Item::LightMesh, Item::Frusta, Item::NoScene];
    let inputs = Inputs::load(&config).unwrap();
    seen_from(&config, &inputs, Viewpoint::Placed(placed), &items).image
}

#[test]
fn lines_lie_about_their_frame_wherever_it_is() {
    let [home, away] = [DVec3::ZERO, DVec3::new(4096.0, 0.0, -8192.0)].map(lines_at);
    let differ = home.pixels().zip(away.pixels()).filter(|(a, b)| a != b).count();
    let drawn = home.pixels().filter(|pixel| *pixel != home.get_pixel(0, 0)).count();
    assert!(drawn > 500 && differ * 20 < drawn, "{differ} of {drawn} pixels differ");
}

#[test]
fn what_cannot_be_shown_is_refused_before_the_device_is_asked() {
    let config = config("bistro", "all-lights");
    let inputs = Inputs::load(&config).unwrap();
    let runs = planned_runs(&config);
    let refused = |view, items: &[Item]| {
        let show = Show::from_items(items, None).unwrap();
        render(&inputs, &runs[0], Viewpoint::Named(view), &show).err().map(|error| error.to_string()).unwrap()
    };
    assert!(refused(None, &[Item::Clusters]).contains("all-lights has no clusters"));
    assert!(refused(Some("left"), &[Item::Frusta]).contains("birdseye"));
    assert!(refused(None, &[Item::UsedClusters]).contains("all-lights has no clusters"));
    assert!(refused(None, &[Item::LightMesh]).contains("all-lights rasterises no meshes"));
}

#[test]
fn a_replay_sees_from_above_what_a_still_sees_and_counts_as_if_nobody_looked() {
    for (recording, method) in [("bistro", "indi-displ-64-32"), ("bistro-vive", "encl-ortho-4")] {
        let alone = config(recording, method);
        let frames = FrameRange { first: FRAME, end: Some(FRAME + 2), step: 1 };
        let replayed = |exr| run(Config { frames, exr: ExrFrames::List(exr), ..alone.clone() }).remove(0);
        let (watched, unwatched) = (replayed(vec![FRAME]), replayed(vec![]));
        assert_eq!(watched.counts, unwatched.counts, "{method}");
        assert!(unwatched.looks.is_empty());
        let inputs = Inputs::load(&alone).unwrap();
        let still = still(&alone, &inputs, Some("birdseye"), &[Item::Clusters, Item::Frusta]);
        assert_eq!(watched.looks, [(FRAME, Look::Birdseye, still.image)], "{method}");
    }
}

#[test]
fn brute_force_looks_at_volumes_of_lights_and_at_its_gbuffer() {
    let config = Config {
        light_source: GeneratorKind::Volume,
        pipeline: vec![ShadingPipeline::Deferred],
        exr: ExrFrames::List(vec![FRAME]),
        ..config("bistro", "all-lights")
    };
    let inputs = Inputs::load(&config).unwrap();
    let watched = run(config.clone()).remove(0);
    let alone = Config { exr: ExrFrames::List(vec![]), ..config };
    let plan = still(&alone, &inputs, Some("birdseye"), &[Item::Frusta, Item::Lights]);
    let gbuffer = still(&alone, &inputs, None, &[Item::Gbuffer]);
    let looks = [(FRAME, Look::Plan, plan.image), (FRAME, Look::Gbuffer, gbuffer.image)];
    assert!(watched.looks == looks, "{:?}", watched.looks.iter().map(|look| look.1).collect::<Vec<_>>());
}

#[test]
fn a_camera_may_be_placed_anywhere_and_sees_the_same_frame() {
    let config = config("bistro", "indi-ortho-4");
    let inputs = Inputs::load(&config).unwrap();
    let counts = still(&config, &inputs, None, &[]).counts;
    let plan = plan(&config, &inputs);
    let (own, grid) = (plan.views[0], plan.grids[0]);
    let placed = |eye: DVec3, target: DVec3, fov| {
        let placed = Placed::new(eye.to_array(), target.to_array(), Some(fov)).unwrap();
        seen_from(&config, &inputs, Viewpoint::Placed(placed), &[Item::Clusters])
    };
    // Where the recording's camera is, and what it sees in its middle.
    let ahead = own.pose.transform_point(DVec3::NEG_Z * 10.0);
    let fov = 2.0 * own.frustum.x1.atan();
    let same = placed(own.pose.position, ahead, fov);
    assert_eq!((same.counts, same.view.as_str()), (counts.clone(), "eye"));
    let first = still(&config, &inputs, None, &[Item::Clusters]);
    let equal = same.pixels.cluster_index.iter().zip(&first.pixels.cluster_index).filter(|(a, b)| a == b);
    assert!(
        100 * equal.count() >= 98 * first.pixels.cluster_index.len(),
        "the same camera sees other clusters"
    );
    // Outside the scene, farther away than the recording's own cameras see: clusters lie where the host says.
    let outside = placed(ahead + DVec3::new(20.0, 120.0, 20.0), ahead, 0.25);
    assert_eq!(outside.counts, counts);
    let clustered: Vec<usize> =
        (0..outside.pixels.depth.len()).filter(|&p| outside.pixels.cluster_index[p] != u32::MAX).collect();
    let agree = clustered.iter().filter(|&&pixel| {
        let cluster = grid.cluster_of(world(&outside, pixel)).map(|cell| grid.linear(cell));
        cluster == Some(outside.pixels.cluster_index[pixel])
    });
    let agree = agree.count();
    assert!(clustered.len() > 20, "{} pixels with clusters", clustered.len());
    assert!(100 * agree >= 95 * clustered.len(), "{agree} of {}", clustered.len());
}

/// From a view of the recording and from above, whether or not there is a prepass.
#[test]
fn a_gbuffer_is_shown_as_base_colours_normals_and_depth_beside_the_picture_that_it_makes() {
    let plain = config("bistro", "sc-e-48-40");
    let inputs = Inputs::load(&plain).unwrap();
    let forward = still(&plain, &inputs, None, &[]);
    let [width, height] = plain.resolution;
    for (shading, msaa) in [(Shading::Prepass, 1), (Shading::Overdraw, 1), (Shading::Prepass, 4)] {
        let (shading, pipeline) = (vec![shading], vec![ShadingPipeline::Deferred]);
        let config = Config { shading, pipeline, msaa, ..plain.clone() };
        for view in [None, Some("birdseye")] {
            let shown = still(&config, &inputs, view, &[Item::Gbuffer]);
            assert_eq!(shown.image.dimensions(), (3 * width, height));
            let part =
                |part: u32, x: u32, y: u32| shown.image.get_pixel(part * width + x, y).0.map(f32::from);
            let mut upward = 0;
            for (at, distance) in (0..).zip(&shown.pixels.depth) {
                let (x, y) = (at % width, at / width);
                let [base, normal, depth] = [0, 1, 2].map(|which| part(which, x, y));
                if msaa > 1 {
                    continue;
                }
                assert_eq!(distance.is_finite(), depth[0] > 0.0);
                if distance.is_finite() {
                    let length = normal.map(|c| (c / 127.5 - 1.0).powi(2)).iter().sum::<f32>().sqrt();
                    assert!((length - 1.0).abs() < 0.02, "{normal:?}");
                    upward += u32::from(normal[1] > 240.0);
                } else {
                    assert_eq!((base, normal), ([0.0; 3], [0.0; 3]));
                }
            }
            assert!(msaa > 1 || upward > width * height / 20, "the street lies flat: {upward}");
            if view.is_none() && msaa == 1 {
                let away = |a: &[half::f16; 4], b: &[half::f16; 4]| (a[0].to_f32() - b[0].to_f32()).abs();
                let colors = shown.pixels.color.iter().zip(&forward.pixels.color);
                assert!(colors.clone().any(|(a, _)| a[0].to_f32() > 0.1));
                colors.for_each(|(a, b)| assert!(away(a, b) < 0.03 * b[0].to_f32() + 2e-3, "{a:?} {b:?}"));
            }
        }
    }
}
