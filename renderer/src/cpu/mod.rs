//! CPU twins of the GPU passes that build lists, and of what looks at depth: plain, readable, in f64, with the passes' stems.
//!
//! ```text
//! depth image ─mark─> fragments per cluster ─compact─> visible clusters ─assign─> light lists
//!                                          (scan: the prefix sums inside compact and assign)
//!             └─bounds─> what they take of their cells ─assign_measured─> light lists
//!             └─cones─> which way they face ─assign_facing─> light lists
//!             └─depth_steps─> how much depth jumps
//! boxes of instances ─cull─> what is drawn
//! grid ─build_boxes─> boxes around cells
//! meshes of lights ─shell─> slices of each light, tile by tile ─fill─> light lists
//! ```
//!
//! Assignment by other ways than brute force has twins of each of its steps, which take what the step before left on the
//! device:
//!
//! ```text
//! visible clusters ─mark_blocks─> blocks ─cull_lights─> candidates ─┬─keys, sorted, build_nodes─> tree ─descend─> lists
//!                                                                   └─scatter_groups─> groups ─scatter─> lists
//! lights ─light_rectangles─> cells in which each is seen ─rectangles─> lists
//! visible clusters ─sort_tiles─> tile by tile
//! bits ─read_masks─> lists      lists in any order ─sort_lists─> lists      lists ─cap_list─> capped ones
//! ```
//!
//! Where f32 may fall on the other side of a boundary, a twin given an epsilon says so itself ([`Marks`],
//! [`LightLists`], [`FoundLists`], [`CulledLights`], [`Descent`], [`Seen`]); everything else must agree exactly.

mod assign;
mod attenuation;
mod bounds;
mod brdf;
mod build_boxes;
mod compact;
mod cones;
mod cull;
mod cull_lights;
mod depth_steps;
mod fill;
mod hierarchy;
mod light_rectangles;
mod lists;
mod mark;
mod scan;
mod scatter;
mod shell;
mod sort_tiles;

pub use assign::{LightLists, assign, assign_facing, assign_measured};
pub use attenuation::attenuation;
pub use bounds::ClusterBounds;
pub use brdf::{Surface, reflected};
pub use build_boxes::build_boxes;
pub use compact::{Compacted, NOT_VISIBLE, compact};
pub use cones::ClusterCones;
pub use cull::{Seen, cull};
pub use cull_lights::{Blocks, Candidate, CellRange, CulledLights, cull_lights, mark_blocks};
pub use depth_steps::{depth_steps, log2_parts};
pub use fill::{END_OF_LIST, FilledLists, LinkedLists, Shells, fill, fill_linked};
pub use hierarchy::{Descent, Key, Node, Tree, build_nodes, descend, keys, sorted};
pub use light_rectangles::{light_rectangles, rectangles};
pub use lists::{FoundLists, cap_list, read_masks, sort_lists};
pub use mark::{DepthImage, Marks, mark};
pub use scan::scan;
pub use scatter::{ClusterGroup, scatter, scatter_groups};
pub use shell::{ShellGrid, SliceRange, ViewMesh, placed, placed_shell, shell, shell_grid, shell_of_tile};
pub use sort_tiles::{TileClusters, sort_tiles};

use crate::geometry::Grid;

/// The visible clusters of a grid.
#[derive(Debug, Clone, Copy)]
pub struct Visible<'a> {
    /// The grid whose cells the clusters are.
    pub grid: &'a Grid,
    /// Linear indices of the visible clusters, ascending.
    pub clusters: &'a [u32],
}

#[cfg(test)]
mod tests {
    use crate::geometry::views::Pose;
    use crate::geometry::{ClusterSpace, Frustum, Grid, LightVolume};
    use glam::{DVec3, Vec3};

    /// Unit cells along the x axis.
    pub fn row(cells: u32) -> Grid {
        let max = DVec3::new(f64::from(cells), 1.0, 1.0);
        let space = ClusterSpace::Orthographic { min: DVec3::ZERO, max };
        Grid { pose: Pose::IDENTITY, space, dimensions: [cells, 1, 1] }
    }

    /// A frustum of 7 x 5 x 9 cells that ends at 60 m.
    pub fn frustum_grid() -> Grid {
        let frustum = Frustum { x0: -1.0, x1: 0.8, y0: -0.6, y1: 0.7, z0: -60.0, z1: -0.5 };
        let ratio = 120f64.powf(1.0 / 9.0) - 1.0;
        Grid { pose: Pose::IDENTITY, space: ClusterSpace::geometric(frustum, ratio), dimensions: [7, 5, 9] }
    }

    /// Lights in front of the camera, spread evenly enough, in numbers that f32 has.
    pub fn volumes(count: u32) -> Vec<LightVolume> {
        let part = |i: u32, step: f32| (i as f32 * step).fract();
        (0..count)
            .map(|i| {
                let depth = 1.0 + 30.0 * part(i, 0.618_034);
                let across = |step: f32| depth * (2.0 * part(i, step) - 1.0);
                let centre = Vec3::new(across(0.414_214), across(0.732_051), -depth);
                LightVolume::sphere(centre.as_dvec3(), (0.3 + 3.0 * part(i, 0.236_068)).into())
            })
            .collect()
    }
}
