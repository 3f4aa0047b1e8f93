//! Grids and frusta whose numbers are known: near 0.4, far 100, 1280x720 unless told otherwise.

use super::plan;
use crate::geometry::DisplacedVolume::{Own, View as OfView};
use crate::geometry::views::{Pose, View, head_space};
use crate::geometry::{
    ClusterSpace, Frustum, Grid, average_volume, enclosing, from_pixels, side_in_tangents,
};
use crate::methods::Sharing::{Encl, Indi};
use crate::methods::{Sharing, Space};
use glam::{DQuat, DVec3};
use std::f64::consts::FRAC_PI_2;

const SCREEN: [u32; 2] = [1280, 720];
const HALF_SCREEN: [u32; 2] = [640, 720];
const RECORDED_FOV: f64 = 1.2610621452;
const PERSP_64: Space = Space::Persp { pixels: 64.0 };
const ORTHO_4: Space = Space::Ortho { metres: 4.0 };
const DISPL_64_32: Space = Space::Displ { pixels: 64.0, displacement: 32.0 };

/// Somewhere, turned some way: grids must not depend on it.
fn pose() -> Pose {
    let rotation = DQuat::from_rotation_y(2.7) * DQuat::from_rotation_x(-0.2);
    Pose { position: DVec3::new(17.8, 4.9, -41.8), rotation, mirror: None }
}

fn mono(fov: f64) -> Vec<View> {
    vec![View { pose: pose(), frustum: Frustum::from_fov(fov, SCREEN, 0.4, 100.0).unwrap() }]
}

fn vive_frusta() -> [Frustum; 2] {
    let depths = Frustum { x0: 0.0, x1: 0.0, y0: 0.0, y1: 0.0, z0: -100.0, z1: -0.4 };
    [
        Frustum { x0: -1.3896277, x1: 1.2424954, y0: -1.4736392, y1: 1.4612536, ..depths },
        Frustum { x0: -1.2475655, x1: 1.3957016, y0: -1.473202, y1: 1.4637187, ..depths },
    ]
}

fn vive(head: Pose) -> Vec<View> {
    let eye = |x: f64| head * Pose::from_position(DVec3::new(x, 0.0, 0.015));
    let [left, right] = vive_frusta();
    vec![View { pose: eye(-0.0307), frustum: left }, View { pose: eye(0.0307), frustum: right }]
}

fn only_grid(space: Space, sharing: Sharing, views: &[View], resolution: [u32; 2]) -> Grid {
    let grids = plan(space, sharing, views, resolution, OfView).unwrap();
    assert_eq!(grids.len(), 1);
    grids[0]
}

fn dimensions(space: Space, sharing: Sharing, views: &[View], resolution: [u32; 2]) -> [u32; 3] {
    only_grid(space, sharing, views, resolution).dimensions
}

fn frustum_of(grid: &Grid) -> Frustum {
    match grid.space {
        ClusterSpace::Perspective { frustum, .. } => frustum,
        ClusterSpace::Orthographic { .. } => panic!("not a perspective grid"),
    }
}

fn assert_frustum(found: Frustum, [x0, x1, y0, y1, z0, z1]: [f64; 6], epsilon: f64) {
    let pairs =
        [(found.x0, x0), (found.x1, x1), (found.y0, y0), (found.y1, y1), (found.z0, z0), (found.z1, z1)];
    for (found, known) in pairs {
        assert!((found - known).abs() < epsilon, "{found} is not {known}");
    }
}

#[test]
fn mono_persp() {
    let views = mono(FRAC_PI_2);
    for (pixels, known) in [(16.0, [80, 45, 224]), (64.0, [20, 12, 58]), (128.0, [10, 6, 31])] {
        assert_eq!(dimensions(Space::Persp { pixels }, Indi, &views, SCREEN), known);
    }
    let counts = from_pixels(&views[0].frustum, SCREEN, 64.0);
    assert!((side_in_tangents(&views[0].frustum, SCREEN, 64.0) - 0.1).abs() < 1e-12);
    assert!((average_volume(&views[0].frustum, &counts) - 53.879307).abs() < 1e-6);
}

#[test]
fn mono_persp_as_recorded() {
    let views = mono(RECORDED_FOV);
    assert_eq!(dimensions(PERSP_64, Indi, &views, SCREEN), [20, 12, 79]);
    let counts = from_pixels(&views[0].frustum, SCREEN, 64.0);
    assert!((side_in_tangents(&views[0].frustum, SCREEN, 64.0) - 0.072992844).abs() < 1e-9);
    assert!((average_volume(&views[0].frustum, &counts) - 21.075771).abs() < 1e-6);
}

#[test]
fn mono_ortho() {
    let views = mono(FRAC_PI_2);
    for sharing in [Indi, Encl] {
        assert_eq!(dimensions(ORTHO_4, sharing, &views, SCREEN), [50, 29, 25]);
        assert_eq!(dimensions(Space::Ortho { metres: 1.0 }, sharing, &views, SCREEN), [200, 113, 100]);
    }
}

#[test]
fn mono_displ() {
    let views = mono(FRAC_PI_2);
    let grid = only_grid(DISPL_64_32, Indi, &views, SCREEN);
    assert_eq!(grid.dimensions, [33, 19, 31]);
    let (x, y) = (0.7575757576, 0.4261363636);
    assert_frustum(frustum_of(&grid), [-x, x, -y, y, -132.0, -32.4], 1e-9);
    let behind = views[0].pose.transform_point(DVec3::Z * 32.0);
    assert!((grid.pose.position - behind).length() < 1e-9);
    assert_eq!(dimensions(DISPL_64_32, Encl, &views, SCREEN), [33, 19, 31]);
}

#[test]
fn mono_displ_by_its_own_volume() {
    let views = mono(RECORDED_FOV);
    assert_eq!(dimensions(DISPL_64_32, Indi, &views, SCREEN), [33, 19, 42]);
    for sharing in [Indi, Encl] {
        assert_eq!(plan(DISPL_64_32, sharing, &views, SCREEN, Own).unwrap()[0].dimensions, [30, 17, 39]);
    }
}

#[test]
fn vive_enclosing_frustum() {
    let views = vive(Pose::IDENTITY);
    let found = enclosing(&Pose::IDENTITY, &views).unwrap();
    assert!((found.apex - 0.037092).abs() < 1e-6, "{}", found.apex);
    let known = [-1.3896277, 1.3957003, -1.4733137, 1.4633954, -100.022092, -0.422092];
    assert_frustum(found.frustum, known, 1e-6);
    let head = head_space(&vive(pose()));
    let turned = enclosing(&head, &vive(pose())).unwrap();
    assert!((turned.apex + 0.015 - found.apex).abs() < 1e-9, "head space lies between the eyes");
}

#[test]
fn vive_half_screens() {
    let eyes = vive(pose());
    for grid in plan(PERSP_64, Indi, &eyes, HALF_SCREEN, OfView).unwrap() {
        assert_eq!(grid.dimensions, [10, 12, 24]);
    }
    assert_eq!(dimensions(PERSP_64, Encl, &eyes, HALF_SCREEN), [11, 12, 25]);
    assert_eq!(dimensions(ORTHO_4, Encl, &eyes, HALF_SCREEN), [70, 74, 25]);
}

#[test]
fn vive_full_screens() {
    let eyes = vive(pose());
    for grid in plan(PERSP_64, Indi, &eyes, SCREEN, OfView).unwrap() {
        assert_eq!(grid.dimensions, [20, 12, 31]);
    }
    assert_eq!(dimensions(PERSP_64, Encl, &eyes, SCREEN), [16, 16, 33]);
    assert_eq!(dimensions(DISPL_64_32, Encl, &eyes, SCREEN), [25, 26, 17]);
}

#[test]
fn persp_starts_at_the_first_pixel_and_grows_the_far_sides() {
    let [eye, _] = vive(pose())[..] else { panic!("two eyes") };
    let grid = only_grid(PERSP_64, Indi, &[eye], HALF_SCREEN);
    let (seen, grown) = (eye.frustum, frustum_of(&grid));
    assert_eq!((grown.x0, grown.y0, grown.z0, grown.z1), (seen.x0, seen.y0, seen.z0, seen.z1));
    assert!((grown.x1 - seen.x1).abs() < 1e-12, "10 columns of 64 fill 640 pixels");
    let row = grown.size().y / 12.0;
    assert!((row - seen.size().y * 64.0 / 720.0).abs() < 1e-12, "12 rows of 64 are more than 720 pixels");
    let ClusterSpace::Perspective { slices, .. } = grid.space else { unreachable!() };
    let last = slices.depth_at(grid.dimensions[2].into());
    assert!((last - 100.0).abs() < 1e-9, "the slices end at the far plane");
}
