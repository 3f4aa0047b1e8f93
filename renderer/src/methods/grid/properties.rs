//! What must hold for any views: asymmetric, canted, one to four of them.

use super::plan;
use crate::geometry::views::{Mirror, Pose, View};
use crate::geometry::{
    CellTest, ClusterSpace, DisplacedVolume, Frustum, Grid, LightVolume, SphereTest, axis_box, half_space,
};
use crate::methods::{Sharing, Space};
use glam::{DQuat, DVec3, EulerRot};
use proptest::prelude::*;

const RESOLUTION: [u32; 2] = [640, 720];

fn frustum() -> impl Strategy<Value = Frustum> {
    let side = || 0.3..1.6f64;
    (side(), side(), side(), side(), 10.0..200.0f64, 0.05..1.0f64)
        .prop_map(|(l, r, b, t, far, near)| Frustum { x0: -l, x1: r, y0: -b, y1: t, z0: -far, z1: -near })
}

/// A head anywhere, and eyes near it, or cameras around it, that are canted a little.
fn views() -> impl Strategy<Value = Vec<View>> {
    let pose =
        |metres: f64, most: f64| {
            let position = [-metres..metres, -metres..metres, -metres..metres].prop_map(DVec3::from_array);
            (position, (-most..most, -most..most, -most..most)).prop_map(|(position, (yaw, pitch, roll))| {
                Pose { position, rotation: DQuat::from_euler(EulerRot::YXZ, yaw, pitch, roll), mirror: None }
            })
        };
    let eye = prop_oneof![3 => pose(0.1, 0.2), 1 => pose(20.0, 0.2)];
    (pose(80.0, 3.0), prop::collection::vec((eye, frustum()), 1..=4), mirror()).prop_map(
        |(head, eyes, mirror)| {
            let view = |(eye, frustum)| View { pose: Pose { mirror, ..head * eye }, frustum };
            eyes.into_iter().map(view).collect()
        },
    )
}

/// A mirror that all views see, or none.
fn mirror() -> impl Strategy<Value = Option<Mirror>> {
    let angle = || -3.0..3.0f64;
    prop::option::weighted(0.3, (angle(), angle(), -50.0..50.0f64)).prop_map(|plane| {
        plane.map(|(yaw, pitch, offset)| Mirror {
            normal: DQuat::from_euler(EulerRot::YXZ, yaw, pitch, 0.0) * DVec3::Z,
            offset,
        })
    })
}

fn space() -> impl Strategy<Value = Space> {
    prop_oneof![
        (16.0..200.0f64).prop_map(|pixels| Space::Persp { pixels }),
        (1.0..20.0f64).prop_map(|metres| Space::Ortho { metres }),
        (16.0..200.0f64, 1.0..256.0f64)
            .prop_map(|(pixels, displacement)| Space::Displ { pixels, displacement }),
        [1..40u32, 1..24u32, 1..64u32].prop_map(|counts| {
            let [columns, rows, slices] = counts.map(f64::from);
            Space::Counted { columns, rows, slices }
        }),
    ]
}

fn sharing() -> impl Strategy<Value = Sharing> {
    prop_oneof![Just(Sharing::Indi), Just(Sharing::Encl)]
}

fn volume() -> impl Strategy<Value = DisplacedVolume> {
    prop_oneof![Just(DisplacedVolume::View), Just(DisplacedVolume::Own)]
}

/// Parts of the way from the lower to the upper bound on each axis, often the bounds themselves.
fn parts() -> impl Strategy<Value = DVec3> {
    let part = || prop_oneof![2 => 0.0..=1.0f64, 1 => Just(0.0), 1 => Just(1.0)];
    [part(), part(), part()].prop_map(DVec3::from_array)
}

/// The point of a view's frustum at some parts of its tangents and depths, in the world.
fn point_in(view: &View, parts: DVec3) -> DVec3 {
    let Frustum { x0, y0, z0, z1, .. } = view.frustum;
    let tangents = view.frustum.size() * parts.truncate();
    let distance = -z1 * (z0 / z1).powf(parts.z);
    view.pose.transform_point(DVec3::new(x0 + tangents.x, y0 + tangents.y, -1.0) * distance)
}

/// Each part of a test alone, and all together.
fn tests() -> [SphereTest; 7] {
    ["hs", "sat-e", "sat-n", "sat-p", "sat-v", "hs+sat-enpv", "exact"].map(|name| name.parse().unwrap())
}

/// Distance of a point from a cluster: 0 inside its planes, else that of the nearest of the twelve triangles of its surface.
fn surface_distance(grid: &Grid, cell: [u32; 3], point: DVec3) -> f64 {
    if half_space(grid, cell, point, 0.0) >= 0.0 {
        return 0.0;
    }
    let corners = grid.cell_corners(cell);
    let faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let distances =
        triangles.map(|triangle| triangle_distance(triangle.map(|corner| corners[corner]), point));
    distances.fold(f64::INFINITY, f64::min)
}

/// Distance of a point from a triangle: from its plane where the foot lies inside, else from the nearest edge.
fn triangle_distance([a, b, c]: [DVec3; 3], point: DVec3) -> f64 {
    let normal = (b - a).cross(c - a).normalize();
    let foot = point - normal * normal.dot(point - a);
    let inside =
        [[a, b], [b, c], [c, a]].iter().all(|&[from, to]| normal.dot((to - from).cross(foot - from)) >= 0.0);
    if inside {
        return point.distance(foot);
    }
    let segment = |from: DVec3, to: DVec3| {
        let along = (to - from).dot(point - from) / (to - from).length_squared();
        point.distance(from + (to - from) * along.clamp(0.0, 1.0))
    };
    segment(a, b).min(segment(b, c)).min(segment(c, a))
}

/// Each view with the grid that serves it.
fn with_grids<'a>(views: &'a [View], grids: &'a [Grid]) -> impl Iterator<Item = (&'a View, &'a Grid)> {
    views.iter().enumerate().map(|(index, view)| (view, &grids[index.min(grids.len() - 1)]))
}

/// How far, in metres, a point of clustering space lies outside a cell's planes; rounding errors grow with
/// the point's distance.
fn outside(grid: &Grid, cell: [u32; 3], local: DVec3) -> f64 {
    -half_space(grid, cell, local, 0.0) / (1.0 + local.length())
}

fn neighbours(grid: &Grid, cell: [u32; 3]) -> impl Iterator<Item = [u32; 3]> {
    let dimensions = grid.dimensions;
    (0..3).flat_map(move |axis| {
        let shifted = move |by: i64| {
            let index = i64::from(cell[axis]) + by;
            let mut other = cell;
            other[axis] = u32::try_from(index).ok().filter(|&i| i < dimensions[axis])?;
            Some(other)
        };
        [shifted(-1), shifted(1)].into_iter().flatten()
    })
}

proptest! {
    #[test]
    fn every_view_corner_lies_in_the_enclosing_grid(views in views(), space in space(), volume in volume()) {
        let grids = plan(space, Sharing::Encl, &views, RESOLUTION, volume).unwrap();
        prop_assert_eq!(grids.len(), 1);
        for view in &views {
            for corner in view.frustum.corners() {
                prop_assert!(grids[0].cluster_of(view.pose.transform_point(corner)).is_some());
            }
        }
    }

    #[test]
    fn every_point_seen_is_in_exactly_one_cluster(
        views in views(), space in space(), sharing in sharing(), volume in volume(), parts in parts(),
    ) {
        let grids = plan(space, sharing, &views, RESOLUTION, volume).unwrap();
        for (view, grid) in with_grids(&views, &grids) {
            let local = grid.pose.inverse_transform_point(point_in(view, parts));
            let cell = grid.cluster_of_local(local);
            prop_assert!(cell.is_some(), "{local} has no cluster");
            let cell = cell.unwrap();
            prop_assert_eq!(grid.nearest_cluster(local), Some(cell));
            prop_assert!(outside(grid, cell, local) < 1e-9);
            let (low, high) = grid.cell_bounds(cell);
            let slack = 1e-9 * (1.0 + local.length());
            prop_assert!(local.cmpge(low - slack).all() && local.cmple(high + slack).all());
            for other in neighbours(grid, cell) {
                prop_assert!(outside(grid, other, local) > -1e-9, "also in {other:?}");
            }
        }
    }

    #[test]
    fn linear_indices_count_the_clusters(dimensions in [1..9u32, 1..9u32, 1..9u32]) {
        let space = ClusterSpace::Orthographic { min: DVec3::ZERO, max: DVec3::ONE };
        let grid = Grid { pose: Pose::IDENTITY, space, dimensions };
        let count = u32::try_from(grid.cluster_count()).unwrap();
        for linear in 0..count {
            let cell = grid.cluster_at(linear);
            prop_assert!(cell.iter().zip(dimensions).all(|(&index, size)| index < size));
            prop_assert_eq!(grid.linear(cell), linear);
        }
    }

    #[test]
    fn no_test_misses_a_sphere_that_reaches_into_the_cell(
        views in views(), space in space(), sharing in sharing(),
        in_view in parts(), in_cell in parts(), towards in parts(), radius in 0.01..30.0f64, reach in parts(),
    ) {
        let grid = plan(space, sharing, &views, RESOLUTION, DisplacedVolume::View).unwrap()[0];
        let cell = grid.cluster_of(point_in(&views[0], in_view)).unwrap();
        let point = grid.point_at(DVec3::from_array(cell.map(f64::from)) + in_cell);
        let direction = (towards - 0.5).normalize_or(DVec3::X);
        let center = point + direction * radius * reach.x;
        let slack = 1e-9 * (1.0 + point.length());
        prop_assert!(half_space(&grid, cell, center, radius) >= -slack);
        prop_assert!(axis_box(&grid, cell, center, radius) >= -slack);
        for test in tests() {
            let volume = LightVolume::sphere(center, radius);
            prop_assert!(CellTest::new(test, &grid, cell).margin(&volume) >= -slack, "{test}");
        }
    }

    #[test]
    fn exact_is_the_distance_and_no_test_accepts_less(
        (views, space, sharing) in (views(), space(), sharing()),
        (in_view, in_cell, towards) in (parts(), parts(), parts()), radius in 0.01..30.0f64, reach in 0.0..4.0f64,
    ) {
        let grid = plan(space, sharing, &views, RESOLUTION, DisplacedVolume::View).unwrap()[0];
        let cell = grid.cluster_of(point_in(&views[0], in_view)).unwrap();
        let direction = (towards - 0.5).normalize_or(DVec3::X);
        let point = grid.point_at(DVec3::from_array(cell.map(f64::from)) + in_cell);
        let center = point + direction * radius * reach;
        let volume = LightVolume::sphere(center, radius);
        let margin = |test| CellTest::new(test, &grid, cell).margin(&volume);
        let slack = 1e-8 * (1.0 + center.length());
        let exact = radius - surface_distance(&grid, cell, center);
        prop_assert!((margin(SphereTest::Exact) - exact).abs() < slack, "{} {exact}", margin(SphereTest::Exact));
        for test in tests() {
            prop_assert!(exact <= slack || margin(test) > -slack, "{test} loses a sphere");
        }
        // Half spaces enclose what any test with normals accepts.
        let normals = margin("sat-p".parse().unwrap());
        prop_assert!(normals <= margin(SphereTest::HALF_SPACES) + slack);
    }

    #[test]
    fn points_and_coordinates_are_inverse(
        views in views(), space in space(), sharing in sharing(), parts in parts(),
    ) {
        let grid = plan(space, sharing, &views, RESOLUTION, DisplacedVolume::View).unwrap()[0];
        let at = parts * DVec3::from_array(grid.dimensions.map(f64::from));
        let back = grid.coordinates(grid.point_at(at)).unwrap();
        prop_assert!((back - at).abs().max_element() < 1e-6, "{back} is not {at}");
    }
}

#[test]
fn what_cannot_be_planned_is_refused_with_the_methods_name() {
    let frustum = Frustum::from_fov(1.0, RESOLUTION, 0.4, 100.0).unwrap();
    let view = View { pose: Pose::IDENTITY, frustum };
    let behind = View { pose: Pose { rotation: DQuat::from_rotation_y(3.0), ..Pose::IDENTITY }, frustum };
    let upside_down = View { frustum: Frustum { y0: 1.0, y1: -1.0, ..frustum }, ..view };
    let persp = |pixels: f64| Space::Persp { pixels };
    let ortho = |metres: f64| Space::Ortho { metres };
    let displ = |displacement: f64| Space::Displ { pixels: 64.0, displacement };
    let cases: [(Space, &[View], [u32; 2], &str); 13] = [
        (persp(0.0), &[view], RESOLUTION, "encl-persp-0: a size of 0"),
        (persp(f64::NAN), &[view], RESOLUTION, "NaN"),
        (ortho(-4.0), &[view], RESOLUTION, "-4"),
        (ortho(f64::INFINITY), &[view], RESOLUTION, "inf"),
        (displ(0.0), &[view], RESOLUTION, "encl-displ-64-0"),
        (displ(f64::NAN), &[view], RESOLUTION, "NaN"),
        (ortho(0.01), &[view], RESOLUTION, "encl-ortho-0.01"),
        (ortho(1e-300), &[view], RESOLUTION, "clusters is more than 4294967295"),
        (persp(0.001), &[view], RESOLUTION, "larger size"),
        (persp(64.0), &[view, behind], RESOLUTION, "Ortho"),
        (persp(64.0), &[view, upside_down], RESOLUTION, "bottom tangent"),
        (persp(64.0), &[view], [0, 720], "0x720"),
        (persp(64.0), &[], RESOLUTION, "no view"),
    ];
    for (space, views, resolution, words) in cases {
        let planned = plan(space, Sharing::Encl, views, resolution, DisplacedVolume::View);
        let message = planned.unwrap_err().to_string();
        assert!(message.contains(words), "'{message}' does not say '{words}'");
    }
    let mirror = Some(Mirror { normal: DVec3::Y, offset: -2.0 });
    let seen = View { pose: Pose { mirror, ..Pose::IDENTITY }, frustum };
    for space in [persp(64.0), displ(32.0)] {
        let planned = |views: &[View]| plan(space, Sharing::Encl, views, RESOLUTION, DisplacedVolume::View);
        let message = planned(&[view, seen]).unwrap_err().to_string();
        assert!(message.contains("mirror") && message.contains("encl-ortho-4"), "{message}");
        assert!(planned(&[seen, seen]).is_ok(), "views in one mirror agree");
    }
    for views in [[view, behind], [view, seen]] {
        let planned = plan(ortho(4.0), Sharing::Encl, &views, RESOLUTION, DisplacedVolume::View);
        assert!(planned.is_ok(), "Ortho encloses any views");
    }
}
