//! Light lists by brute force: every visible cluster against every light.

use super::scan;
use crate::geometry::{
    CellTest, Grid, LightVolume, MeasuredBounds, NormalCones, SphericalSector, VolumeTest,
};
use crate::lights::Light;

/// The light lists of all visible clusters, one behind the other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LightLists {
    /// Where the list of each visible cluster starts in `indices`, and last their total length.
    pub offsets: Vec<u32>,
    /// Indices of lights, ascending within each list.
    pub indices: Vec<u32>,
    /// Lights so close to the boundary of each visible cluster that f32 may decide otherwise, ascending.
    pub borderline: Vec<Vec<u32>>,
}

impl LightLists {
    /// The list of a visible cluster, by its position among the visible ones.
    pub fn list(&self, visible_index: usize) -> &[u32] {
        &self.indices[self.offsets[visible_index] as usize..self.offsets[visible_index + 1] as usize]
    }
}

/// Assigns `lights` (world space, influence radius R1) to the `visible` clusters of `grid` (linear indices).
///
/// `epsilon`, in metres, is how small a margin makes a pair borderline.
pub fn assign(
    grid: &Grid,
    visible: &[u32],
    lights: &[Light],
    test: impl Into<VolumeTest>,
    epsilon: f64,
) -> LightLists {
    let test = test.into();
    let cells = visible.iter().map(|&cluster| Some(CellTest::new(test, grid, grid.cluster_at(cluster))));
    assign_cells(cells, grid, lights, epsilon)
}

/// The same for what is measured of `visible` clusters, of which some may hold nothing: their lists are empty.
pub fn assign_measured(
    grid: &Grid,
    (visible, bounds): (&[u32], &[MeasuredBounds]),
    lights: &[Light],
    test: impl Into<VolumeTest>,
    epsilon: f64,
) -> LightLists {
    let test = test.into();
    let cell = |(&cluster, bounds): (&u32, &MeasuredBounds)| {
        (!bounds.is_empty()).then(|| CellTest::measured(test, grid, grid.cluster_at(cluster), bounds))
    };
    assign_cells(visible.iter().zip(bounds).map(cell), grid, lights, epsilon)
}

/// The same without the lights that lie behind all samples of a cluster, of which `cones` tell which ways they face, a bit for
/// each of `divided`.
pub fn assign_facing(
    grid: &Grid,
    (visible, bounds, cones): (&[u32], &[MeasuredBounds], &[u64]),
    lights: &[Light],
    (test, divided): (VolumeTest, NormalCones),
    epsilon: f64,
) -> LightLists {
    let volumes: Vec<_> = lights.iter().map(|light| volume_of_light(grid, light)).collect();
    let groups = visible.iter().zip(bounds).zip(cones).map(|((&cluster, bounds), &cones)| {
        let cell =
            (!bounds.is_empty()).then(|| CellTest::measured(test, grid, grid.cluster_at(cluster), bounds));
        cell.map(|cell| (cell, bounds.ball(grid), cones))
    });
    LightLists::by_margin(groups, &volumes, epsilon, |group, volume| {
        let Some((cell, ball, cones)) = group else { return f64::NEG_INFINITY };
        let light = volume.sector.map_or(volume.centre, |sector| sector.apex);
        let facing = |growth: f64| divided.facing(*cones, (ball.0, ball.1 + growth), light);
        match cell.margin(volume) {
            margin if margin < -epsilon => margin,
            // A ball that is little larger may hide much less: what lies between is too close to call.
            margin if facing(0.0) < 0.0 && facing(epsilon) >= 0.0 => margin.min(0.0),
            margin => margin.min(facing(0.0)),
        }
    })
}

fn assign_cells(
    cells: impl Iterator<Item = Option<CellTest>>,
    grid: &Grid,
    lights: &[Light],
    epsilon: f64,
) -> LightLists {
    let volumes: Vec<_> = lights.iter().map(|light| volume_of_light(grid, light)).collect();
    LightLists::by_margin(cells, &volumes, epsilon, |cell, volume| {
        cell.map_or(f64::NEG_INFINITY, |cell| cell.margin(volume))
    })
}

impl LightLists {
    /// The lists of groups, each of the lights whose `margin` to it, in metres, is at least 0; one below `epsilon` is
    /// borderline.
    pub fn by_margin<G, L>(
        groups: impl Iterator<Item = G>,
        lights: &[L],
        epsilon: f64,
        margin: impl Fn(&G, &L) -> f64,
    ) -> Self {
        let (mut lengths, mut indices, mut borderline) = (Vec::new(), Vec::new(), Vec::new());
        for group in groups {
            let before = indices.len();
            let mut close = Vec::new();
            for (number, light) in (0u32..).zip(lights) {
                let margin = margin(&group, light);
                if margin >= 0.0 {
                    indices.push(number);
                }
                if margin.abs() < epsilon {
                    close.push(number);
                }
            }
            lengths.push((indices.len() - before) as u32);
            borderline.push(close);
        }
        Self { offsets: scan(&lengths), indices, borderline }
    }
}

/// What a light reaches, in the space of `grid`; without the slack that covers the device's rounding.
fn volume_of_light(grid: &Grid, light: &Light) -> LightVolume {
    let to_grid = |world| grid.pose.inverse_transform_point(world);
    match light.sector() {
        None => LightVolume::sphere(to_grid(light.place()), light.r1.into()),
        Some(sector) => {
            let apex = to_grid(sector.apex);
            let axis = to_grid(sector.apex + sector.axis) - apex;
            LightVolume::sector(SphericalSector { apex, axis: axis.normalize(), ..sector })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::views::Pose;
    use crate::geometry::{ClusterSpace, SphereTest};
    use glam::DVec3;

    fn light(x: f32, r1: f32) -> Light {
        Light {
            position: [x, 0.5, 10.5],
            tint: [1.0; 3],
            intensity: 1.0,
            cutoff: 1.0,
            r0: 0.1,
            r1,
            spot: None,
        }
    }

    /// A row of four unit cells, ten metres up the Z axis.
    fn grid() -> Grid {
        let space = ClusterSpace::Orthographic { min: DVec3::ZERO, max: DVec3::new(4.0, 1.0, 1.0) };
        Grid { pose: Pose::from_position(DVec3::Z * 10.0), space, dimensions: [4, 1, 1] }
    }

    #[test]
    fn lists_follow_the_visible_clusters_with_ascending_lights() {
        let lights = [light(3.5, 0.25), light(0.5, 1.0), light(2.25, 0.5), light(9.0, 1.0)];
        for test in [SphereTest::Box, SphereTest::HALF_SPACES, SphereTest::Exact] {
            let lists = assign(&grid(), &[0, 1, 3], &lights, test, 1e-4);
            assert_eq!(lists.offsets, [0, 1, 3, 4]);
            assert_eq!([lists.list(0), lists.list(1), lists.list(2)], [&[1][..], &[1, 2], &[0]]);
            assert!(lists.borderline.iter().all(Vec::is_empty));
        }
    }

    #[test]
    fn a_light_near_the_boundary_is_borderline_on_either_side_of_it() {
        let lights = [light(1.5, 0.50001), light(1.5, 0.49999), light(1.5, 0.6)];
        let lists = assign(&grid(), &[0], &lights, SphereTest::Box, 1e-4);
        assert_eq!(lists.list(0), [0, 2]);
        assert_eq!(lists.borderline, [[0, 1]]);
    }

    #[test]
    fn no_cluster_and_no_light_make_no_list() {
        let lists = assign(&grid(), &[], &[light(0.0, 1.0)], SphereTest::Box, 1e-4);
        assert_eq!((lists.offsets, lists.indices), (vec![0], vec![]));
        assert_eq!(assign(&grid(), &[2], &[], SphereTest::HALF_SPACES, 1e-4).offsets, [0, 0]);
    }
}
