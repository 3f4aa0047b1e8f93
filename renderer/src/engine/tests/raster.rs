//! Meshes around lights on the device: lists equal to their twin's to the light, and none lost that a light reaches.

use super::bounds::with_clusters;
use super::boxes::by_law;
use super::*;
use crate::assign::Conservative::{self, Hardware, HardwareLayers, Software, SoftwareLayers};
use crate::assign::{Links, ListStore, MeshDetail, NODES_PER_CLUSTER};
use crate::engine::kept;
use crate::geometry::views::Pose;
use crate::geometry::{ClusterSpace, LightMesh, MeshKind, SliceLaw, Slices, SphereLevel, VolumeTest};
use crate::gpu_interface::{GridData, MeshFrame};
use crate::lights::Spot;
use crate::passes::raster;
use crate::selftest::cases::points_and_spots;
use crate::selftest::cases::sliced;
use crate::vk::{Context, DeviceOptions};

fn data_of(grid: &Grid) -> (GridData, Vec<f32>) {
    cpu::shell_grid(grid).unwrap()
}

/// The slices of each tile in which a light's mesh lies.
type Shell = Vec<Option<[u32; 2]>>;

/// The level of a light whose mesh is around a point.
fn level_of(detail: MeshDetail, frame: &MeshFrame, grid: &GridData) -> SphereLevel {
    let [radius, distance] =
        [frame.x, frame.origin].map(|vector| DVec3::from(vector.map(f64::from)).length());
    detail.level(radius, distance, grid.cell[0].into())
}

fn kind_of(detail: MeshDetail, frame: &MeshFrame, grid: &GridData) -> MeshKind {
    let is_spot = frame.tip != [0.0; 3];
    if is_spot { MeshKind::Spot } else { MeshKind::Sphere(level_of(detail, frame, grid)) }
}

fn shell_of(grid: &Grid, detail: MeshDetail, frame: &MeshFrame) -> Shell {
    let (data, planes) = data_of(grid);
    let mesh = LightMesh::new(kind_of(detail, frame, &data));
    let shell = cpu::placed_shell(&cpu::ShellGrid { grid: &data, planes: &planes }, &mesh, frame);
    shell.into_iter().map(|range| range.slices(grid.dimensions[2])).collect()
}

/// A method's lists of the visible clusters of a grid, these, and what placed the meshes.
fn lists(
    (name, law): (&str, SliceLaw),
    detail: MeshDetail,
    lights: &[Light],
) -> (Lists, Vec<u32>, Vec<MeshFrame>) {
    let method: Method = name.parse().unwrap();
    let config = Config { mesh_detail: vec![detail], ..by_law(law) };
    let (mut bench, clusters) = with_clusters(&config, (method, sliced(law)), lights);
    let lists = bench.lists();
    let words = size_of::<MeshFrame>() / 4 * lights.len();
    let frames = bytemuck::cast_slice(&bench.download(BufferName::LightFrames, words)).to_vec();
    (lists, clusters, frames)
}

const METHODS: [(&str, SliceLaw); 3] = [
    ("raster-13-9-21-e", SliceLaw::SecondPlane { metres: 5.0 }),
    ("raster-13-9-21-l", SliceLaw::Linear),
    ("raster-count-13-9-21-e", SliceLaw::SecondPlane { metres: 5.0 }),
];

const PAPERS: MeshDetail = MeshDetail::Level(SphereLevel::V42);

fn assert_lists_are_of_shells(grid: &Grid, (lists, clusters): (&Lists, &[u32]), shells: &[Shell]) {
    for (place, cluster) in clusters.iter().enumerate() {
        let [x, y, z] = grid.cluster_at(*cluster);
        let tile = (x + grid.dimensions[0] * y) as usize;
        let is_in = |shell: &Shell| shell[tile].is_some_and(|[first, last]| (first..=last).contains(&z));
        let twin: Vec<u32> =
            (0u32..).zip(shells).filter(|(_, shell)| is_in(shell)).map(|(light, _)| light).collect();
        assert_eq!(lists.of(place), twin, "cluster {cluster}");
    }
}

/// Every light that reaches a cluster by more than rounding is on its list.
fn assert_none_is_lost(lists: &Lists, twin: &cpu::LightLists) {
    for (place, borderline) in twin.borderline.iter().enumerate() {
        let is_lost = |light: &&u32| {
            borderline.binary_search(light).is_err() && lists.of(place).binary_search(light).is_err()
        };
        assert_eq!(twin.list(place).iter().find(is_lost), None, "list {place}");
    }
}

#[test]
fn lists_are_those_of_the_shells_on_the_host() {
    for (name, law) in METHODS {
        let (grid, lights) = (sliced(law), points_and_spots(700));
        let (lists, clusters, frames) = lists((name, law), PAPERS, &lights);
        let shells: Vec<_> = frames.iter().map(|frame| shell_of(&grid, PAPERS, frame)).collect();
        assert_lists_are_of_shells(&grid, (&lists, &clusters), &shells);
        assert!(lists.indices.len() > 1000, "{name}");
    }
}

/// Finer meshes take fewer lights in vain.
#[test]
fn lists_are_those_of_meshes_of_their_level_which_take_fewer_the_finer_they_are() {
    let (grid, lights) = (sliced(METHODS[0].1), points_and_spots(70));
    let found = SphereLevel::ALL.map(|level| {
        let detail = MeshDetail::Level(level);
        let (lists, clusters, frames) = lists(METHODS[0], detail, &lights);
        let shells: Vec<_> = frames.iter().map(|frame| shell_of(&grid, detail, frame)).collect();
        assert_lists_are_of_shells(&grid, (&lists, &clusters), &shells);
        let exact: VolumeTest = "exact+cone".parse().unwrap();
        assert_none_is_lost(&lists, &cpu::assign(&grid, &clusters, &lights, exact, 1e-3));
        lists.indices.len()
    });
    assert!(found.is_sorted_by(|coarse, fine| coarse > fine), "{found:?}");
}

/// Every light goes through one of the pipelines of all levels, whichever stages these have.
#[test]
fn each_light_has_the_level_that_is_fine_enough_from_the_eye() {
    for (name, law) in [METHODS[0], METHODS[2]] {
        let (grid, lights) = (sliced(law), points_and_spots(120));
        let detail = MeshDetail::Auto(0.25);
        let (lists, clusters, frames) = lists((name, law), detail, &lights);
        let shells: Vec<_> = frames.iter().map(|frame| shell_of(&grid, detail, frame)).collect();
        assert_lists_are_of_shells(&grid, (&lists, &clusters), &shells);
        let data = data_of(&grid).0;
        let kinds: Vec<_> = frames.iter().map(|frame| kind_of(detail, frame, &data)).collect();
        let lights_of = |level| kinds.iter().filter(|kind| **kind == MeshKind::Sphere(level)).count();
        let spread = SphereLevel::ALL.map(lights_of);
        assert!(spread.iter().filter(|lights| **lights > 2).count() >= 3, "{name}: {spread:?}");
    }
}

#[test]
fn no_cluster_that_a_light_reaches_is_left_out_and_few_others_are_taken() {
    for (name, law) in METHODS {
        let (grid, lights) = (sliced(law), points_and_spots(700));
        let (lists, clusters, _) = lists((name, law), PAPERS, &lights);
        let exact: VolumeTest = "exact+cone".parse().unwrap();
        let twin = cpu::assign(&grid, &clusters, &lights, exact, 1e-3);
        assert_none_is_lost(&lists, &twin);
        let [found, reached] = [lists.indices.len(), twin.indices.len()];
        assert!(found >= reached && 10 * found < 16 * reached, "{name}: {found} of {reached}");
    }
}

/// Lists of a method on a grid of its own law, kept so, with the bench that made them.
fn kept_so(lists: ListStore, (name, grid): (&str, Grid), lights: &[Light]) -> (Lists, Bench) {
    let config = Config { lists: vec![lists], ..by_law(METHODS[0].1) };
    let (mut bench, _) = with_clusters(&config, (name.parse().unwrap(), grid), lights);
    (bench.lists(), bench)
}

/// The lights of each list in the order in which it is walked, list by list.
fn walked(bench: &mut Bench, links: Links) -> Vec<Vec<u32>> {
    let state = bench.state().unwrap();
    let heads = bench.download(BufferName::ListOffsets, state.visible as usize);
    let words = state.index_total as usize * links.node.words() as usize;
    let pool = bench.download(BufferName::LightIndices, words);
    heads.into_iter().map(|head| kept::walk(links.node, &pool, head).collect()).collect()
}

fn linked(name: &str) -> Links {
    name.parse::<ListStore>().unwrap().links().unwrap()
}

#[test]
fn linked_lists_hold_the_lights_of_offsets_spots_first_and_in_order_where_they_are_sorted() {
    let lights = points_and_spots(700);
    let is_point = |light: &u32| lights[*light as usize].spot.is_none();
    for name in ["raster-13-9-21-e", "raster-count-13-9-21-e"] {
        let case = (name, sliced(METHODS[0].1));
        let (offsets, _) = kept_so(ListStore::Offsets, case, &lights);
        for store in ["linked-64", "linked-32", "linked-64-unsorted", "linked-32-unsorted"] {
            let links = linked(store);
            let (lists, mut bench) = kept_so(ListStore::Linked(links), case, &lights);
            assert!(lists == offsets, "{name}, {store}");
            let key = |light: &u32| (is_point(light), links.sorted.then_some(*light));
            let lists = walked(&mut bench, links);
            assert!(lists.iter().all(|list| list.is_sorted_by_key(key)), "{name}, {store}");
            assert!(lists.iter().any(|list| list.iter().any(is_point) && !list.iter().all(is_point)));
        }
    }
}

/// What has no room is counted, so that the host can tell how large the pool should be; what has room is in some list, once.
#[test]
fn pools_that_are_too_small_tell_how_many_nodes_they_lack() {
    let mut grid = sliced(METHODS[0].1);
    grid.dimensions = [2, 2, 21];
    let ClusterSpace::Perspective { frustum, .. } = grid.space else { panic!("a frustum") };
    grid.space =
        ClusterSpace::Perspective { frustum, slices: Slices::new(METHODS[0].1, &frustum, 0.3, 21.0) };
    let lights = random_lights(2000, 21, 14.0, |_| 60.0);
    let (offsets, _) = kept_so(ListStore::Offsets, ("raster-2-2-21-e", grid), &lights);
    let (lists, mut bench) =
        kept_so(ListStore::Linked(linked("linked-64")), ("raster-2-2-21-e", grid), &lights);
    let state = bench.state().unwrap();
    let pool = NODES_PER_CLUSTER * grid.cluster_count() as u32;
    assert!(state.index_total > pool, "{}", state.index_total);
    assert_eq!(state.index_total as usize, offsets.indices.len());
    assert_eq!(lists.indices.len(), pool as usize);
    for list in 0..lists.offsets.len() - 1 {
        assert!(lists.of(list).iter().all(|light| offsets.of(list).binary_search(light).is_ok()));
        assert!(lists.of(list).is_sorted_by(|a, b| a < b));
    }
}

/// Around the eye of a camera, cut by its near and far plane, behind the eye, as narrow and as wide as spots get; and many others.
fn lights_that_are_cut(pose: &Pose) -> Vec<Light> {
    let point = |local: [f64; 3], r1| {
        let position = pose.transform_point(DVec3::from_array(local)).as_vec3().to_array();
        Light { r1, ..Light::new(position, [1.0; 3], 1.0, 0.1, 0.1) }
    };
    let spot = |local, direction: [f64; 3], r1, degrees: f32| {
        let direction = (pose.rotation * DVec3::from_array(direction)).as_vec3().to_array();
        point(local, r1).shining(Some(Spot::new(direction, 0.0, degrees.to_radians())))
    };
    let mut lights = points_and_spots(200);
    for z in [-200.0, -60.0, -3.0, -0.3, 0.0, 0.3, 5.0] {
        lights.extend([0.2, 4.0, 300.0].map(|r1| point([0.1, -0.2, z], r1)));
        for degrees in [0.5, 45.0, 85.0] {
            let directions = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.3, 0.0]];
            lights.extend(directions.map(|direction| spot([0.0, 0.1, z], direction, 12.0, degrees)));
        }
    }
    lights
}

/// The slices that a way of rasterising leaves of each light and tile, and whether the device has it as hardware.
fn shell_words(
    (way, detail): (Conservative, MeshDetail),
    law: SliceLaw,
    lights: &[Light],
) -> (Vec<u32>, bool) {
    words_on(
        sliced(law),
        &Config { conservative: vec![way], mesh_detail: vec![detail], ..by_law(law) },
        lights,
    )
}

fn words_on(grid: Grid, config: &Config, lights: &[Light]) -> (Vec<u32>, bool) {
    let [columns, rows, slices] = grid.dimensions;
    let method = format!("raster-{columns}-{rows}-{slices}-e").parse().unwrap();
    let (mut bench, _) = with_clusters(config, (method, grid), lights);
    bench.lists();
    let words = bench.download(BufferName::ShellRanges, (columns * rows) as usize * lights.len());
    (words, bench.session.context.limits.conservative_rasterization)
}

#[test]
fn drawn_shells_are_those_of_the_kernel() {
    // Of the finest meshes a part of the lights is enough.
    let several = (METHODS[0].1, MeshDetail::Auto(1.0), 4);
    for (law, detail, step) in [(METHODS[0].1, PAPERS, 1), (METHODS[1].1, PAPERS, 1), several] {
        let lights: Vec<_> = lights_that_are_cut(&sliced(law).pose).into_iter().step_by(step).collect();
        let (computed, has_hardware) = shell_words((Conservative::Compute, detail), law, &lights);
        let from_the_eye = computed.iter().filter(|word| *word & 0xFFFF == 0).count();
        assert!(from_the_eye * step > 1000 && computed.contains(&u32::MAX));
        // Hardware is asked where the device has it.
        let has = |way: &&Conservative| has_hardware || !way.is_hardware();
        let drawn = [HardwareLayers, Hardware, SoftwareLayers, Software];
        for &way in drawn.iter().filter(has) {
            assert!(shell_words((way, detail), law, &lights).0 == computed, "{way}, {detail}");
        }
    }
}

/// Of 7 layers all but the last batch have 7 lights, points and spots among them.
#[test]
fn batches_of_layers_leave_the_slices_of_all_lights() {
    let law = METHODS[0].1;
    let (grid, lights) = (sliced(law), lights_that_are_cut(&sliced(law).pose));
    let config = Config { conservative: vec![SoftwareLayers], ..by_law(law) };
    let (computed, _) = shell_words((Conservative::Compute, PAPERS), law, &lights);
    let options = DeviceOptions { validate: true, most_layers: Some(7), ..DeviceOptions::default() };
    let context = Context::new(&options).unwrap();
    let log = context.validation_log();
    assert!(context.limits.max_layers == 7 && !lights.len().is_multiple_of(7));
    let session = Session::on(context, &config, &street(), workbench::ONE_VIEW).unwrap();
    let capacities = Capacities { visible_clusters: 1, light_indices: 100_000, ..Capacities::default() };
    let case = Case { method: "raster-13-9-21-e".parse().unwrap(), grid, lights: &lights, capacities };
    let mut bench = Bench(Workbench::on(session, &config, case).unwrap());
    bench.run(|r, frame| {
        let lights = light_upload::record(r, frame);
        raster::mesh_frames(r, frame, lights, given());
        raster::shells(r, frame, given());
    });
    let drawn = bench.download(BufferName::ShellRanges, computed.len());
    let differ = drawn.iter().zip(&computed).filter(|(drawn, computed)| drawn != computed).count();
    assert_eq!(differ, 0, "of {}", computed.len());
    drop(bench);
    assert_eq!(log.messages(), Vec::<String>::new());
}

/// Lavapipe ends a shader's loops after so many turns, in silence; workgroups share the tiles of a light.
#[test]
fn nothing_is_left_out_where_there_are_many_tiles() {
    let law = METHODS[0].1;
    let mut grid = sliced(law);
    grid.dimensions = [120, 68, 4];
    let ClusterSpace::Perspective { frustum, .. } = grid.space else { panic!("a frustum") };
    grid.space = ClusterSpace::Perspective { frustum, slices: Slices::new(law, &frustum, 0.3, 4.0) };
    let place = grid.pose.transform_point(DVec3::new(0.0, 0.0, -6.0)).as_vec3().to_array();
    let lights = [Light { r1: 5.9, ..Light::new(place, [1.0; 3], 1.0, 0.1, 0.1) }];
    let [computed, drawn] = [Conservative::Compute, Software].map(|way| {
        let mesh_detail = vec![MeshDetail::Level(SphereLevel::V642)];
        words_on(grid, &Config { conservative: vec![way], mesh_detail, ..by_law(law) }, &lights).0
    });
    let seen = computed.iter().filter(|word| **word != u32::MAX).count();
    assert!(seen > 5000, "{seen} tiles");
    let differ = computed.iter().zip(&drawn).filter(|(computed, drawn)| computed != drawn).count();
    assert!(computed == drawn, "{differ} tiles");
    let [filled, counted] = ["raster-120-68-4-e", "raster-count-120-68-4-e"]
        .map(|name| kept_so(ListStore::Offsets, (name, grid), &lights).0);
    assert!(filled == counted && filled.indices.len() > 500, "{}", filled.indices.len());
}
