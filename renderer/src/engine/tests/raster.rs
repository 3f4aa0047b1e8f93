//! Meshes around lights on the device: lists equal to their twin's to the light, and none lost that a light reaches.

use super::bounds::with_clusters;
use super::boxes::{by_law, sliced};
use super::cones::mixed;
use super::*;
use crate::geometry::{ClusterSpace, LightMesh, MeshKind, SliceLaw, SphereLevel, VolumeTest};
use crate::gpu_interface::{GridData, MeshFrame};

/// What a device has of a grid, as far as shells ask it.
fn data_of(grid: &Grid) -> (GridData, Vec<f32>) {
    let ClusterSpace::Perspective { frustum, .. } = grid.space else { panic!("a frustum") };
    let [columns, rows, _] = grid.dimensions.map(f64::from);
    let mut planes = vec![];
    grid.slice_planes(&mut planes);
    let data = GridData {
        dimensions: grid.dimensions,
        origin: [frustum.x0 as f32, frustum.y0 as f32, 0.0],
        cell: [(frustum.size().x / columns) as f32, (frustum.size().y / rows) as f32, 0.0],
        ..Default::default()
    };
    (data, planes)
}

/// The slices of each tile in which a light's mesh lies.
fn shell_of(grid: &Grid, frame: &MeshFrame) -> Vec<Option<[u32; 2]>> {
    let (data, planes) = data_of(grid);
    let is_spot = frame.tip != [0.0; 3];
    let mesh = LightMesh::new(if is_spot { MeshKind::Spot } else { MeshKind::Sphere(SphereLevel::V42) });
    let vertices: Vec<_> = mesh.vertices.iter().map(|vertex| cpu::placed(frame, vertex.as_vec4())).collect();
    let mesh = cpu::ViewMesh { vertices: &vertices, triangles: &mesh.triangles };
    let shell = cpu::shell(&cpu::ShellGrid { grid: &data, planes: &planes }, &mesh);
    shell.into_iter().map(|range| range.slices(grid.dimensions[2])).collect()
}

/// A method's lists of the visible clusters of a grid, these, and what placed the meshes.
fn lists(name: &str, law: SliceLaw, lights: &[Light]) -> (Lists, Vec<u32>, Vec<MeshFrame>) {
    let method: Method = name.parse().unwrap();
    let (mut bench, clusters) = with_clusters(&by_law(law), (method, sliced(law)), lights);
    let lists = bench.lists();
    let words = size_of::<MeshFrame>() / 4 * lights.len();
    let frames = bytemuck::cast_slice(&bench.download(BufferName::LightFrames, words)).to_vec();
    (lists, clusters, frames)
}

const METHODS: [(&str, SliceLaw); 2] =
    [("raster-13-9-21-e", SliceLaw::SecondPlane { metres: 5.0 }), ("raster-13-9-21-l", SliceLaw::Linear)];

#[test]
fn lists_are_those_of_the_shells_on_the_host() {
    for (name, law) in METHODS {
        let (grid, lights) = (sliced(law), mixed(700));
        let (lists, clusters, frames) = lists(name, law, &lights);
        let shells: Vec<_> = frames.iter().map(|frame| shell_of(&grid, frame)).collect();
        for (place, cluster) in clusters.iter().enumerate() {
            let [x, y, z] = grid.cluster_at(*cluster);
            let tile = (x + grid.dimensions[0] * y) as usize;
            let is_in = |shell: &Vec<Option<[u32; 2]>>| {
                shell[tile].is_some_and(|[first, last]| (first..=last).contains(&z))
            };
            let twin: Vec<u32> =
                (0u32..).zip(&shells).filter(|(_, shell)| is_in(shell)).map(|(light, _)| light).collect();
            assert_eq!(lists.of(place), twin, "{name}: cluster {cluster}");
        }
        assert!(lists.indices.len() > 1000, "{name}");
    }
}

#[test]
fn no_cluster_that_a_light_reaches_is_left_out_and_few_others_are_taken() {
    for (name, law) in METHODS {
        let (grid, lights) = (sliced(law), mixed(700));
        let (lists, clusters, _) = lists(name, law, &lights);
        let exact: VolumeTest = "exact+cone".parse().unwrap();
        let twin = cpu::assign(&grid, &clusters, &lights, exact, 1e-3);
        for (place, cluster) in clusters.iter().enumerate() {
            let lost = |light: &&u32| {
                twin.borderline[place].binary_search(light).is_err()
                    && lists.of(place).binary_search(light).is_err()
            };
            assert_eq!(twin.list(place).iter().find(lost), None, "{name}: cluster {cluster}");
        }
        let [found, reached] = [lists.indices.len(), twin.indices.len()];
        assert!(found >= reached && 10 * found < 16 * reached, "{name}: {found} of {reached}");
    }
}
