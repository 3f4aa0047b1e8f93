use super::*;
use crate::assign::Clusters;
use crate::cpu::Visible;
use crate::geometry::SphereTest;
use crate::lights::Light;
use crate::methods::grid;
use proptest::prelude::*;

const SCENE: Option<(DVec3, DVec3)> = Some((DVec3::new(-40.0, -1.0, -60.0), DVec3::new(90.0, 12.0, 30.0)));

fn light(position: [f32; 3], r1: f32) -> Light {
    Light { position, tint: [1.0; 3], intensity: 1.0, cutoff: 1.0, r0: 0.01, r1, spot: None }
}

fn placed(cells: f64, lights: &[Light], grid_box: GridBox) -> Grid {
    let around = Scenery { lights, scene: SCENE, models: 0, grid_box };
    Method::World(WorldGrid { cells }).settled(&plan(WorldGrid { cells }).unwrap(), &around)
}

/// The box of a grid in the world.
fn corners(grid: &Grid) -> (DVec3, DVec3) {
    let (low, high) = grid.bounds();
    (grid.pose.transform_point(low), grid.pose.transform_point(high))
}

#[test]
fn numbers_of_cells_are_whole_and_fit_the_indices() {
    for cells in [1.0, 20.0, 512.0] {
        assert_eq!(plan(WorldGrid { cells }).unwrap().dimensions, [cells as u32; 3]);
    }
    for cells in [0.5, 20.5, 513.0, 1e9] {
        let message = plan(WorldGrid { cells }).unwrap_err().to_string();
        assert!(message.starts_with(&format!("method g-{cells}: ")) && !message.contains('\n'), "{message}");
    }
}

#[test]
fn a_grid_lies_around_what_it_is_asked_to() {
    let lights = [light([1.0, 2.0, 3.0], 9.0), light([-5.0, 8.0, 4.5], 0.1), light([0.0, 3.0, 4.0], 1.0)];
    let (low, high) = corners(&placed(20.0, &lights, GridBox::Lights));
    assert_eq!((low, high), (DVec3::new(-5.0, 2.0, 3.0), DVec3::new(1.0, 8.0, 4.5)));
    for lights in [&lights[..], &[]] {
        let found = corners(&placed(20.0, lights, GridBox::Scene));
        assert_eq!(Some(found), SCENE);
    }
    assert_eq!(Some(corners(&placed(20.0, &[], GridBox::Lights))), SCENE);
}

#[test]
fn a_box_without_thickness_gets_one_that_single_precision_divides() {
    for lights in [&[light([5.0, 2.0, 7.0], 1.0)][..], &[light([0.0; 3], 1.0), light([9.0, 0.0, 0.0], 1.0)]] {
        let grid = placed(512.0, lights, GridBox::Lights);
        let (low, high) = corners(&grid);
        assert!((high - low).min_element() > 1e-5, "{low} {high}");
        let (first, last) = SCENE.unwrap();
        for point in [first, last] {
            let at = grid.coordinates(grid.pose.inverse_transform_point(point)).unwrap();
            assert!(at.abs().max_element() < f64::from(i32::MAX), "{at}");
        }
    }
}

#[test]
fn only_lists_of_all_cells_serve_any_view() {
    let method = Method::World(WorldGrid { cells: 4.0 });
    for asked in [Clusters::Visible, Clusters::All] {
        assert_eq!(method.listed(asked), Clusters::All);
        assert_eq!(Method::AllLights.listed(asked), asked);
    }
}

fn place() -> impl Strategy<Value = [f32; 3]> {
    [-50.0..50.0f32, -2.0..20.0f32, -50.0..50.0f32]
}

proptest! {
    /// The clamp rule: whatever lies outside, the list of the nearest cell has every light that reaches it.
    #[test]
    fn the_nearest_cell_has_every_light_that_reaches_a_point(
        lights in prop::collection::vec((place(), 0.01..30.0f32), 1..20),
        point in [-200.0..200.0f64, -50.0..50.0f64, -200.0..200.0f64],
        cells in 1..9u32,
    ) {
        let lights: Vec<_> = lights.into_iter().map(|(position, r1)| light(position, r1)).collect();
        let grid = placed(cells.into(), &lights, GridBox::Lights);
        let point = DVec3::from_array(point);
        let cell = grid.nearest_cluster(grid.pose.inverse_transform_point(point)).unwrap();
        let cluster = [grid.linear(cell)];
        let listed = Visible { grid: &grid, clusters: &cluster };
        let lists = grid::twin::light_lists(listed, &lights, SphereTest::Box, 0.0);
        for (index, light) in (0..).zip(&lights) {
            let distance = DVec3::from_array(light.position.map(f64::from)).distance(point);
            if distance < f64::from(light.r1) - 1e-9 {
                prop_assert!(lists.list(0).contains(&index), "light {index} of {lights:?}");
            }
        }
    }

    /// In the box of the scene lights may lie anywhere, for what is shaded does not.
    #[test]
    fn a_cell_of_the_scene_has_every_light_that_reaches_a_point_in_it(
        lights in prop::collection::vec(([-200.0..200.0f32, -90.0..90.0f32, -200.0..200.0f32], 0.01..99.0f32), 1..20),
        part in [0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64],
        cells in 1..9u32,
    ) {
        let lights: Vec<_> = lights.into_iter().map(|(position, r1)| light(position, r1)).collect();
        let grid = placed(cells.into(), &lights, GridBox::Scene);
        let (low, high) = corners(&grid);
        let point = low + (high - low) * DVec3::from_array(part);
        let cluster = [grid.linear(grid.cluster_of(point).unwrap())];
        let listed = Visible { grid: &grid, clusters: &cluster };
        let lists = grid::twin::light_lists(listed, &lights, SphereTest::Box, 0.0);
        for (index, light) in (0..).zip(&lights) {
            let distance = DVec3::from_array(light.position.map(f64::from)).distance(point);
            if distance < f64::from(light.r1) - 1e-9 {
                prop_assert!(lists.list(0).contains(&index), "light {index} of {lights:?}");
            }
        }
    }
}
