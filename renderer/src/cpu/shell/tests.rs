//! Shells against what lights reach exactly, and against their meshes in double precision.

use super::*;
use crate::geometry::views::Pose;
use crate::geometry::{
    CellTest, ClusterSpace, Frustum, Grid, Hexahedron, LightMesh, LightVolume, MeshFrame, MeshKind, SliceLaw,
    Slices, SphereLevel, SphereTest, SphericalSector,
};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// What rounding may cost a light's place, in parts of the far distance and of its reach, metres.
const SLACK: f64 = 8e-7;

/// A grid with what the device has of it.
struct Case {
    grid: Grid,
    data: GridData,
    planes: Vec<f32>,
    meshes: [LightMesh; 2],
}

impl Case {
    /// A frustum from half a metre to 60 m.
    fn new(dimensions: [u32; 3], law: SliceLaw) -> Self {
        let frustum = Frustum { x0: -1.1, x1: 0.9, y0: -0.6, y1: 0.5, z0: -60.0, z1: -0.5 };
        let count = f64::from(dimensions[2]);
        let slices = Slices::new(law, &frustum, 120f64.powf(1.0 / count) - 1.0, count);
        let grid =
            Grid { pose: Pose::IDENTITY, space: ClusterSpace::Perspective { frustum, slices }, dimensions };
        let mut planes = vec![];
        grid.slice_planes(&mut planes);
        let cell = frustum.size() / DVec2::new(dimensions[0].into(), dimensions[1].into());
        let data = GridData {
            dimensions,
            origin: [frustum.x0 as f32, frustum.y0 as f32, 0.0],
            cell: [cell.x as f32, cell.y as f32, 0.0],
            ..bytemuck::Zeroable::zeroed()
        };
        let meshes = [MeshKind::Sphere(SphereLevel::V42), MeshKind::Spot].map(LightMesh::new);
        Self { grid, data, planes, meshes }
    }

    fn shell_grid(&self) -> ShellGrid<'_> {
        ShellGrid { grid: &self.data, planes: &self.planes }
    }

    /// Template and frame of the mesh around a light and what rounding may take of it.
    fn mesh(&self, volume: &LightVolume) -> (&LightMesh, MeshFrame) {
        let grown = |reach: f64| SLACK * reach.max(60.0);
        let volume = match volume.sector {
            Some(sector) => LightVolume::sector(sector.grown(grown(sector.range)).unwrap()),
            None => LightVolume::sphere(volume.centre, volume.radius + grown(volume.radius)),
        };
        (&self.meshes[usize::from(volume.sector.is_some())], MeshFrame::of(&volume))
    }

    /// Vertices as the device has them.
    fn vertices(&self, volume: &LightVolume) -> (Vec<Vec3>, &LightMesh) {
        let (mesh, frame) = self.mesh(volume);
        let frame = (&frame).into();
        (mesh.vertices.iter().map(|vertex| placed(&frame, vertex.as_vec4())).collect(), mesh)
    }

    fn shell(&self, volume: &LightVolume) -> Vec<Option<[u32; 2]>> {
        let (vertices, mesh) = self.vertices(volume);
        let mesh = ViewMesh { vertices: &vertices, triangles: &mesh.triangles };
        let ranges = shell(&self.shell_grid(), &mesh);
        ranges.into_iter().map(|range| range.slices(self.data.dimensions[2])).collect()
    }

    fn shell_of_tile(&self, volume: &LightVolume, tile: u32) -> Option<[u32; 2]> {
        let (vertices, mesh) = self.vertices(volume);
        let mesh = ViewMesh { vertices: &vertices, triangles: &mesh.triangles };
        shell_of_tile(&self.shell_grid(), &mesh, tile).slices(self.data.dimensions[2])
    }

    /// How far the cell reaches into what a light reaches, metres; below 0 where they do not meet.
    fn exact(&self, volume: &LightVolume, cell: [u32; 3]) -> f64 {
        match &volume.sector {
            Some(sector) => sector.range - Hexahedron::of_cell(&self.grid, cell).least_distance(sector),
            None => CellTest::new(SphereTest::Exact, &self.grid, cell).margin(volume),
        }
    }

    /// Least and greatest depth of what of a light's mesh lies in a tile, by cutting its triangles with the sides of the tile.
    fn depths_by_cutting(&self, volume: &LightVolume, tile: u32) -> Option<[f64; 2]> {
        let (mesh, frame) = self.mesh(volume);
        let [x, y] = [tile % self.data.dimensions[0], tile / self.data.dimensions[0]];
        let sides = &self.grid.cell_planes([x, y, 0])[..4];
        let corner = |vertex: u16| frame.place(mesh.vertices[usize::from(vertex)]);
        let triangles: Vec<[DVec3; 3]> = mesh.triangles.iter().map(|triangle| triangle.map(corner)).collect();
        let eye =
            triangles.iter().all(|[a, b, c]| (*b - *a).cross(*c - *a).dot(*a) >= 0.0).then_some(DVec3::ZERO);
        let cut = |polygon: Vec<DVec3>, side: &crate::geometry::Plane| {
            let at = |at: usize| (polygon[at % polygon.len()], side.distance(polygon[at % polygon.len()]));
            let piece = |from: usize| {
                let ((a, of_a), (b, of_b)) = (at(from), at(from + 1));
                let through = ((of_a < 0.0) != (of_b < 0.0)).then(|| a + (b - a) * (of_a / (of_a - of_b)));
                (of_a >= 0.0).then_some(a).into_iter().chain(through)
            };
            (0..polygon.len()).flat_map(piece).collect::<Vec<_>>()
        };
        let points = triangles.iter().flat_map(|triangle| sides.iter().fold(triangle.to_vec(), cut));
        let depths: Vec<f64> = points.chain(eye).map(|point| -point.z).collect();
        let least = depths.iter().copied().reduce(f64::min)?;
        Some([least, depths.into_iter().fold(least, f64::max)])
    }
}

fn direction() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-1.0..1.0f64)
        .prop_filter_map("a direction", |v| DVec3::from_array(v).try_normalize())
}

/// Points and spots, in the frustum, beside it, before the near plane, beyond the far one, behind the eye, around it.
fn volume() -> impl Strategy<Value = LightVolume> {
    let depth = prop_oneof![6 => 0.3..60.0f64, 1 => 55.0..90.0f64, 1 => -5.0..1.0f64];
    let place = (-1.3..1.1f64, -0.8..0.7f64, depth);
    let place = place.prop_map(|(x, y, depth)| DVec3::new(x * depth.abs(), y * depth.abs(), -depth));
    let range = prop_oneof![5 => 0.05..12.0f64, 1 => 12.0..200.0f64];
    let angle = prop_oneof![0.5..90f64, 0.5..5f64, Just(90.0)];
    (place, range, direction(), prop::option::weighted(0.6, angle)).prop_map(|(apex, range, axis, angle)| {
        match angle {
            None => LightVolume::sphere(apex, range),
            Some(angle) => {
                LightVolume::sector(SphericalSector { apex, axis, range, half_angle: angle.to_radians() })
            }
        }
    })
}

fn cases() -> Vec<Case> {
    let laws = [SliceLaw::Geometric, SliceLaw::Linear, SliceLaw::SecondPlane { metres: 3.0 }];
    laws.into_iter().map(|law| Case::new([7, 5, 16], law)).collect()
}

/// Lights that touch what they are asked of: their apices are the eye or corners of cells, their axes lie in sides of tiles or along
/// those of the camera, their ranges end at corners.
fn touching(grid: &Grid) -> impl Strategy<Value = LightVolume> + use<> {
    let grid = *grid;
    let corner = move |[x, y, z]: [u32; 3]| grid.point_at(DVec3::new(x.into(), y.into(), z.into()));
    let place = (0..=7u32, 0..=5u32, 0..=16u32).prop_map(move |(x, y, z)| corner([x, y, z]));
    let apex = prop_oneof![1 => Just(DVec3::ZERO), 4 => place.clone()];
    let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
    let axis = prop_oneof![
        prop::sample::select(axes.to_vec()),
        place.clone().prop_map(|place| place.normalize_or(DVec3::NEG_Z))
    ];
    let angle =
        prop_oneof![Just(None), prop::sample::select(vec![0.5, 30.0, 45.0, 60.0, 90.0]).prop_map(Some)];
    (apex, place, axis, angle).prop_map(|(apex, end, axis, angle): (DVec3, DVec3, DVec3, Option<f64>)| {
        let range = apex.distance(end).max(0.1);
        match angle {
            None => LightVolume::sphere(apex, range),
            Some(angle) => {
                LightVolume::sector(SphericalSector { apex, axis, range, half_angle: angle.to_radians() })
            }
        }
    })
}

/// Asks every cell of a tile; how many the light reaches.
fn assert_none_is_lost(case: &Case, volume: &LightVolume, tile: u32) -> u32 {
    let found = case.shell_of_tile(volume, tile);
    let of_slice = |slice: u32| {
        let exact = case.exact(volume, [tile % 7, tile / 7, slice]);
        let is_in = found.is_some_and(|[first, last]| (first..=last).contains(&slice));
        assert!(
            is_in || exact < 0.0,
            "slice {slice} of tile {tile}, reached by {exact}: {found:?}, {volume:?}"
        );
        u32::from(exact >= 0.0)
    };
    (0..16).map(of_slice).sum()
}

/// No cell that a light reaches is left out, of any law; more than a hundred thousand cells.
#[test]
fn every_cell_that_a_light_reaches_is_in_its_shell() {
    let mut runner = TestRunner::deterministic();
    for case in &cases() {
        let strategies = [(volume().boxed(), 0..35u32), (touching(&case.grid).boxed(), 0..35u32)];
        for strategy in strategies {
            let pairs = (0..1200).map(|_| strategy.new_tree(&mut runner).unwrap().current());
            let met: u32 = pairs.map(|(volume, tile)| assert_none_is_lost(case, &volume, tile)).sum();
            assert!(met > 1000, "{met}");
        }
    }
}

/// In each tile the slices are those between the depths at which the mesh begins and ends there, to rounding.
#[test]
fn shells_are_no_longer_than_their_meshes() {
    let cases = cases();
    let (mut runner, strategy) = (TestRunner::deterministic(), (volume(), 0..35u32, 0..3usize));
    let (mut some, mut none) = (0, 0);
    for _ in 0..20_000 {
        let (volume, tile, case) = strategy.new_tree(&mut runner).unwrap().current();
        let case = &cases[case];
        let (found, depths) = (case.shell_of_tile(&volume, tile), case.depths_by_cutting(&volume, tile));
        let slack = 1e-4 * (1.0 + volume.radius + volume.centre.length());
        let Some([least, greatest]) = depths else {
            none += 1;
            continue;
        };
        let Some([first, last]) = found else {
            assert!(greatest < 0.5 + slack || least > 60.0 - slack, "{least} to {greatest}: {volume:?}");
            continue;
        };
        some += 1;
        let plane = |slice: u32| f64::from(case.planes[slice as usize]);
        assert!(
            first == 0 || plane(first) <= least + slack && plane(first + 1) > least - slack,
            "{first} {least} {volume:?}"
        );
        assert!(
            last == 15 || plane(last + 1) > greatest - slack && plane(last) <= greatest + slack,
            "{last} {greatest} {volume:?}"
        );
    }
    assert!(some > 2000 && none > 2000, "{some} {none}");
}

/// A light alone in a grid of 3 x 3 tiles and 8 slices, with its shell.
fn shell_of(volume: LightVolume) -> Vec<Option<[u32; 2]>> {
    Case::new([3, 3, 8], SliceLaw::Geometric).shell(&volume)
}

fn spot(apex: DVec3, axis: DVec3, range: f64, degrees: f64) -> LightVolume {
    let half_angle = degrees.to_radians();
    LightVolume::sector(SphericalSector { apex, axis: axis.normalize(), range, half_angle })
}

#[test]
fn lights_around_the_eye_begin_in_the_first_slice() {
    let whole = vec![Some([0, 7]); 9];
    assert_eq!(shell_of(LightVolume::sphere(DVec3::new(1.0, 2.0, 3.0), 500.0)), whole);
    assert_eq!(shell_of(spot(DVec3::new(0.0, 0.0, 5.0), DVec3::NEG_Z, 900.0, 80.0)), whole);
    assert_eq!(shell_of(spot(DVec3::new(0.0, 0.0, 5.0), DVec3::NEG_Z, 900.0, 70.0)), whole);
    let small = shell_of(LightVolume::sphere(DVec3::new(0.0, 0.0, -0.1), 1.0));
    assert_eq!(small, vec![Some([0, 1]); 9], "planes at 0.5, 0.91 and 1.66 m");
    let before_near = shell_of(LightVolume::sphere(DVec3::ZERO, 0.3));
    assert_eq!(before_near, [None; 9]);
}

/// Rounding has an eye in the plane of a triangle on either side of it; outside, only the far side of the light would be found.
#[test]
fn an_eye_on_the_side_of_a_mesh_is_inside() {
    let mesh = LightMesh::sphere(SphereLevel::V42);
    for [a, b, c] in
        mesh.triangles.iter().map(|triangle| triangle.map(|at| mesh.vertices[usize::from(at)].truncate()))
    {
        let normal = (b - a).cross(c - a).normalize();
        for radius in [0.37, 5.1, 77.0] {
            let around = LightVolume::sphere(-normal * radius, radius);
            let frame = (&MeshFrame::of(&around)).into();
            let vertices: Vec<Vec3> =
                mesh.vertices.iter().map(|vertex| placed(&frame, vertex.as_vec4())).collect();
            assert!(
                ViewMesh { vertices: &vertices, triangles: &mesh.triangles }.eye_is_inside(),
                "{radius} {normal}"
            );
        }
    }
}

#[test]
fn lights_that_are_not_seen_are_nowhere() {
    for volume in [
        LightVolume::sphere(DVec3::new(0.0, 0.0, 4.0), 3.0),
        LightVolume::sphere(DVec3::new(0.0, 0.0, -70.0), 5.0),
        LightVolume::sphere(DVec3::new(90.0, 0.0, -30.0), 20.0),
        LightVolume::sphere(DVec3::new(0.0, 0.0, -0.2), 0.1),
        spot(DVec3::new(0.0, 0.0, 1.0), DVec3::Z, 50.0, 80.0),
        spot(DVec3::new(0.0, 0.0, -61.0), DVec3::new(0.0, 5.0, -1.0), 50.0, 10.0),
    ] {
        assert_eq!(shell_of(volume), [None; 9], "{volume:?}");
    }
}

#[test]
fn lights_cut_by_near_and_far_plane_reach_the_first_and_last_slice() {
    let middle = |volume| shell_of(volume)[4];
    assert_eq!(middle(LightVolume::sphere(DVec3::new(0.0, 0.0, -1.0), 0.8)), Some([0, 2]));
    assert_eq!(middle(LightVolume::sphere(DVec3::new(0.0, 0.0, -58.0), 10.0)), Some([7, 7]));
    assert_eq!(middle(spot(DVec3::new(0.0, 0.0, -40.0), DVec3::NEG_Z, 500.0, 10.0)), Some([7, 7]));
    assert_eq!(middle(spot(DVec3::new(0.0, 0.0, -40.0), DVec3::Z, 39.8, 10.0)), Some([0, 7]));
}

proptest! {
    /// Triangles may come in any order, and each from any corner on.
    #[test]
    fn the_order_of_triangles_does_not_matter(volume in volume(), tile in 0..35u32, from in 0..80usize) {
        let case = Case::new([7, 5, 16], SliceLaw::Geometric);
        let (vertices, mesh) = case.vertices(&volume);
        let found = |triangles: &[[u16; 3]]| {
            shell_of_tile(&case.shell_grid(), &ViewMesh { vertices: &vertices, triangles }, tile)
        };
        let mut turned = mesh.triangles.clone();
        turned.rotate_left(from % mesh.triangles.len());
        prop_assert_eq!(found(&turned), found(&mesh.triangles));
        turned.reverse();
        prop_assert_eq!(found(&turned), found(&mesh.triangles));
    }

    #[test]
    fn ranges_join_and_are_two_bytes(a in 0..255u8, b in 0..255u8, c in 0..255u8, d in 0..255u8) {
        let range = |first: u8, last: u8| SliceRange::from_bytes([first.min(last), 254 - first.max(last)]);
        let (one, other) = (range(a, b), range(c, d));
        let ends = [a.min(b).min(c).min(d), a.max(b).max(c).max(d)].map(u32::from);
        prop_assert_eq!(one.joined(other).slices(255), Some(ends));
        prop_assert_eq!(SliceRange::from_bytes(one.to_bytes()), one);
        prop_assert_eq!(one.joined(SliceRange::EMPTY), one);
    }
}

/// As the paper has it, triangles that face the eye tell where a light begins, and the others where it ends, where the eye is outside:
/// all triangles together tell the same.
#[test]
fn front_faces_begin_and_back_faces_end_what_all_of_them_tell() {
    let case = Case::new([7, 5, 16], SliceLaw::Geometric);
    let (mut runner, strategy) = (TestRunner::deterministic(), (volume(), 0..35u32));
    let mut some = 0;
    for _ in 0..4000 {
        let (volume, tile) = strategy.new_tree(&mut runner).unwrap().current();
        let (vertices, mesh) = case.vertices(&volume);
        let whole = ViewMesh { vertices: &vertices, triangles: &mesh.triangles };
        if whole.eye_is_inside() {
            continue;
        }
        let behind = |triangle: &&[u16; 3]| eye_is_behind(&whole.corners(triangle));
        let (back, front): (Vec<[u16; 3]>, Vec<[u16; 3]>) = mesh.triangles.iter().partition(behind);
        let of = |triangles: &[[u16; 3]]| {
            shell_of_tile(&case.shell_grid(), &ViewMesh { vertices: &vertices, triangles }, tile).halves()
        };
        // A mesh of back faces alone counts as one around the eye, so that only its other half is asked.
        let ([first, _], [_, last]) = (of(&front), of(&back));
        assert_eq!([first, last], of(&mesh.triangles), "{volume:?}");
        some += u32::from(first != SliceRange::NONE);
    }
    assert!(some > 400, "{some}");
}

/// How many cells a light's mesh is in beyond those that the light reaches, in parts of these: around 4 % of points, 4 to 9 % of spots
/// of up to 45 degrees, 13 to 21 % of wider ones, over grids of 24 x 12 x 32 to 48 x 24 x 32 cells.
#[test]
fn meshes_are_in_few_cells_in_vain() {
    let case = Case::new([18, 10, 24], SliceLaw::SecondPlane { metres: 3.0 });
    for (angles, most) in [(None, 0.08), (Some(8.0..45.0), 0.12), (Some(45.0..90.0), 0.25)] {
        let (mut runner, strategy) = (TestRunner::deterministic(), (volume(), 0.0..1.0f64));
        let (mut found, mut reached) = (0, 0);
        for _ in 0..60 {
            let (volume, part) = strategy.new_tree(&mut runner).unwrap().current();
            let apex = DVec3::new(0.0, 0.0, -4.0 - 30.0 * part);
            let volume = match &angles {
                None => LightVolume::sphere(apex, 2.0 + 4.0 * part),
                Some(std::ops::Range { start, end }) => {
                    spot(apex, volume.centre, 2.0 + 4.0 * part, start + (end - start) * part)
                }
            };
            for (tile, slices) in (0..).zip(case.shell(&volume)) {
                for slice in slices.into_iter().flat_map(|[first, last]| first..=last) {
                    found += 1;
                    reached += u32::from(case.exact(&volume, [tile % 18, tile / 18, slice]) >= 0.0);
                }
            }
        }
        let in_vain = f64::from(found - reached) / f64::from(reached);
        assert!((0.01..most).contains(&in_vain), "{found} for {reached}, {angles:?}");
    }
}

#[test]
fn half_a_range_is_none() {
    assert_eq!(SliceRange::EMPTY.slices(255), None);
    assert_eq!(SliceRange::from_bytes([3, 0xFF]).slices(255), None);
    assert_eq!(SliceRange::from_bytes([0xFF, 3]).slices(255), None);
    assert_eq!(SliceRange::EMPTY.to_bytes(), [0xFF; 2]);
}
