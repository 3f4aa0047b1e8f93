//! Which clusters hold fragments, from a depth image.

use crate::geometry::Grid;
use crate::geometry::views::View;
use glam::{DVec2, DVec3};

/// A depth buffer read back: reversed depth, 0 where nothing was drawn.
#[derive(Debug, Clone, Copy)]
pub struct DepthImage<'a> {
    /// Width and height, pixels.
    pub resolution: [u32; 2],
    /// Where the samples lie in their pixel, (0, 0) its upper left and (1, 1) its lower right corner;
    /// `[[0.5, 0.5]]` without multisampling.
    pub sample_positions: &'a [[f32; 2]],
    /// Row by row from the top left; the samples of a pixel follow each other.
    pub depths: &'a [f32],
}

/// How many fragments lie in each cluster of a grid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Marks {
    /// Number of fragments (samples) in each cluster of the grid.
    pub fragments: Vec<u32>,
    /// Number of fragments so close to one of the sides of each cluster that f32 may count them in it or in a
    /// neighbour: a device's count differs from `fragments` by at most this.
    pub borderline: Vec<u32>,
}

impl Marks {
    /// No fragment yet in any cluster of `grid`.
    pub fn none(grid: &Grid) -> Self {
        let count = grid.cluster_count() as usize;
        Self { fragments: vec![0; count], borderline: vec![0; count] }
    }
}

/// Counts the fragments that `view` sees in every cluster of `grid`, on top of what `marks` holds, so that
/// one grid can be marked from several views.
///
/// `epsilon`, in clusters, is how close to a side a fragment is borderline.
///
/// # Panics
/// Where the image does not hold one depth for every sample, or `marks` is not of this grid.
pub fn mark(image: DepthImage<'_>, view: &View, grid: &Grid, epsilon: f64, marks: &mut Marks) {
    assert_eq!(marks.fragments.len() as u64, grid.cluster_count(), "marks of this grid");
    image.fragments(view, grid).for_each(|local| count(grid, local, epsilon, marks));
}

impl DepthImage<'_> {
    /// The fragments that `view` sees, in the clustering space of `grid`.
    pub(super) fn fragments(&self, view: &View, grid: &Grid) -> impl Iterator<Item = DVec3> {
        let [width, height] = self.resolution.map(|side| side as usize);
        let samples = self.sample_positions.len();
        assert_eq!(self.depths.len(), width * height * samples, "one depth for every sample");
        let grid_from_view = grid.pose.inverse() * view.pose;
        let size = DVec2::new(width as f64, height as f64);
        let there = self.depths.iter().enumerate().filter(|(_, depth)| **depth > 0.0);
        there.map(move |(index, &depth)| {
            let pixel = index / samples;
            let corner = DVec2::new((pixel % width) as f64, (pixel / width) as f64);
            let [x, y] = self.sample_positions[index % samples].map(f64::from);
            let seen = view.frustum.unproject((corner + DVec2::new(x, y)) / size, f64::from(depth));
            grid_from_view.transform_point(seen)
        })
    }
}

/// Counts one fragment at `local` in clustering space.
fn count(grid: &Grid, local: DVec3, epsilon: f64, marks: &mut Marks) {
    let (Some(at), Some(cell)) = (grid.coordinates(local), grid.nearest_cluster(local)) else { return };
    marks.fragments[grid.linear(cell) as usize] += 1;
    let possible = possible_cells(grid, at, epsilon);
    if possible.len() > 1 {
        for cell in possible {
            marks.borderline[grid.linear(cell) as usize] += 1;
        }
    }
}

/// The cells within `epsilon` of fractional cluster coordinates.
pub(super) fn possible_cells(grid: &Grid, at: DVec3, epsilon: f64) -> Vec<[u32; 3]> {
    let index = |coordinates: DVec3, axis: usize| {
        let last = f64::from(grid.dimensions[axis]) - 1.0;
        coordinates[axis].floor().clamp(0.0, last) as u32
    };
    let range = |axis: usize| index(at - epsilon, axis)..=index(at + epsilon, axis);
    range(2).flat_map(|z| range(1).flat_map(move |y| range(0).map(move |x| [x, y, z]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::views::Pose;
    use crate::geometry::{DisplacedVolume, Frustum};
    use crate::methods::grid::plan;
    use crate::methods::{Sharing, Space};

    const CENTRE: &[[f32; 2]] = &[[0.5, 0.5]];

    fn view() -> View {
        let frustum = Frustum { x0: -1.0, x1: 0.6, y0: -0.8, y1: 0.7, z0: -100.0, z1: -0.4 };
        View { pose: Pose::from_position(DVec3::new(3.0, 1.0, 2.0)), frustum }
    }

    fn persp(pixels: f64, resolution: [u32; 2]) -> Grid {
        let space = Space::Persp { pixels };
        plan(space, Sharing::Indi, &[view()], resolution, DisplacedVolume::View).unwrap()[0]
    }

    /// Reversed depth at a distance, by the projection matrix itself.
    fn depth_at(distance: f64) -> f32 {
        view().clip_from_view().project_point3(DVec3::new(0.0, 0.0, -distance)).z as f32
    }

    #[test]
    fn pixels_fall_into_the_columns_and_rows_of_persp_from_the_lower_left() {
        let (resolution, grid) = ([10, 6], persp(4.0, [10, 6]));
        let slice = grid.cluster_of_local(DVec3::new(0.0, 0.0, -20.0)).unwrap()[2];
        for y in 0..6 {
            for x in 0..10 {
                let mut depths = vec![0.0; 60];
                depths[(y * 10 + x) as usize] = depth_at(20.0);
                let image = DepthImage { resolution, sample_positions: CENTRE, depths: &depths };
                let mut marks = Marks::none(&grid);
                mark(image, &view(), &grid, 1e-4, &mut marks);
                let expected = grid.linear([x / 4, (5 - y) / 4, slice]) as usize;
                assert_eq!(marks.fragments.iter().sum::<u32>(), 1);
                assert_eq!(marks.fragments[expected], 1, "pixel {x} {y}");
                assert!(marks.borderline.iter().all(|&count| count == 0));
            }
        }
    }

    #[test]
    fn every_sample_counts_where_it_lies() {
        let (resolution, grid) = ([4, 1], persp(1.0, [4, 1]));
        let sample_positions: &[[f32; 2]] = &[[0.375, 0.125], [0.875, 0.375]];
        let mut depths = vec![0.0; 8];
        (depths[4], depths[5]) = (depth_at(1.0), depth_at(50.0));
        let mut marks = Marks::none(&grid);
        mark(DepthImage { resolution, sample_positions, depths: &depths }, &view(), &grid, 1e-4, &mut marks);
        for distance in [1.0, 50.0] {
            let slice = grid.cluster_of_local(DVec3::new(0.0, 0.0, -distance)).unwrap()[2];
            assert_eq!(marks.fragments[grid.linear([2, 0, slice]) as usize], 1);
        }
    }

    #[test]
    fn a_fragment_on_a_side_is_borderline_for_both_cells() {
        let (resolution, grid) = ([4, 1], persp(2.0, [4, 1]));
        let sample_positions: &[[f32; 2]] = &[[0.99999, 0.5]];
        let depths = [0.0, depth_at(20.0), 0.0, 0.0];
        let mut marks = Marks::none(&grid);
        mark(DepthImage { resolution, sample_positions, depths: &depths }, &view(), &grid, 1e-4, &mut marks);
        let slice = grid.cluster_of_local(DVec3::new(0.0, 0.0, -20.0)).unwrap()[2];
        let [left, right] = [0, 1].map(|x| grid.linear([x, 0, slice]) as usize);
        assert_eq!((marks.fragments[left], marks.fragments[right]), (1, 0));
        assert_eq!((marks.borderline[left], marks.borderline[right]), (1, 1));
    }

    #[test]
    fn what_is_seen_lies_where_the_enclosing_grid_has_it() {
        let resolution = [8, 8];
        let eyes = [view(), View { pose: Pose::from_position(DVec3::new(3.06, 1.0, 2.0)), ..view() }];
        let space = Space::Ortho { metres: 3.0 };
        let grid = plan(space, Sharing::Encl, &eyes, resolution, DisplacedVolume::View).unwrap()[0];
        let depths = vec![depth_at(30.0); 64];
        let mut marks = Marks::none(&grid);
        for eye in &eyes {
            mark(
                DepthImage { resolution, sample_positions: CENTRE, depths: &depths },
                eye,
                &grid,
                1e-4,
                &mut marks,
            );
        }
        assert_eq!(marks.fragments.iter().sum::<u32>(), 128);
        let seen = eyes[1].frustum.unproject(DVec2::new(0.5, 2.5) / 8.0, f64::from(depths[0]));
        let cell = grid.cluster_of(eyes[1].pose.transform_point(seen)).unwrap();
        assert!(marks.fragments[grid.linear(cell) as usize] > 0);
    }
}
