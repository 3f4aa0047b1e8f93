//! What the host writes for each frame: grids and views as shaders read them.

use crate::assign;
use crate::buffers::ClusteringSizes;
use crate::culling::ViewPlanes;
use crate::geometry::views::{Pose, View};
use crate::geometry::{ClusterSpace, Grid};
use crate::gpu_interface::{GridData, ViewData};
use crate::origin::AT_HOME;
use glam::{DVec3, DVec4};

/// Rounding of positions and planes in f32 stays below this fraction of the grid's reach (the far distance, or the
/// farthest side of a box), or of the radius where that is larger, so radii grown by it never lose a light. It is measured
/// (see the tests of lights that touch) for views whose corners are up to two reaches from the apex, and [`AT_HOME`]; bounding every rounding by its worst gives
/// about three times as much.
pub const SLACK_PER_METRE: f32 = 8e-7;

/// The worst of all roundings together, for each metre that a corner or a grid lies beyond views of a usual width and
/// [`AT_HOME`], and of positions anywhere in the world.
pub const SLACK_PER_METRE_BEYOND: f64 = 2.4e-6;

/// Corners of views up to so many reaches from the apex: those of a headset are at 2.27.
const WIDE: f64 = 2.0;

/// Depth on the near plane may round to less, but not to less than this part.
const NEAR: f64 = 1.0 - 1e-5;

/// What rounding may cost in a grid whose planes are up to `reach` metres from its apex, metres. `grid` is relative to the
/// frame's `origin`, `views`, which look lights up in it, are in the world.
fn slack(grid: &Grid, views: &[View], origin: DVec3, reach: f64) -> f32 {
    let corners = views.iter().flat_map(|view| view.frustum.corners().map(|c| view.pose.transform_point(c)));
    let from_apex = |corner: DVec3| grid.pose.inverse_transform_point(corner - origin).length();
    let sideways = corners.map(from_apex).fold(0.0, f64::max) - WIDE * reach;
    let away = grid.pose.transform_point(DVec3::ZERO).length() - AT_HOME * reach;
    let beyond = SLACK_PER_METRE_BEYOND * (sideways.max(0.0) + away.max(0.0));
    (SLACK_PER_METRE * reach as f32).max(beyond as f32)
}

/// What rounding may cost in a grid that does not depend on the views, metres, where no geometry is farther than `reach` metres
/// from the frame's `origin`. `grid` is relative to that; `views` are in the world.
///
/// Each rounding is bounded by its worst, for what is shaded is anywhere in the scene. It is the same for all views nearer
/// to the origin than the geometry's farthest, so that lists do not depend on them.
pub fn world_slack(grid: &Grid, views: &[View], origin: DVec3, reach: f64) -> f32 {
    let eyes = views.iter().map(|view| view.eye().distance(origin)).fold(reach, f64::max);
    let (low, high) = grid.bounds();
    let cells = grid.pose.transform_point(DVec3::ZERO).length() + low.abs().max(high.abs()).length();
    (SLACK_PER_METRE_BEYOND * (reach + eyes + cells)) as f32
}

/// A grid as shaders read it: `grid` is relative to the frame's `origin`, `views`, which look lights up in it, are in the
/// world.
pub fn grid_data(
    grid: &Grid,
    views: &[View],
    origin: DVec3,
    lights: u32,
    sizes: &ClusteringSizes,
) -> GridData {
    let dimensions = DVec3::from_array(grid.dimensions.map(f64::from));
    let (lowest, cell, [slice_bias, near], reach) = match grid.space {
        ClusterSpace::Perspective { frustum: f, slices } => {
            let [origin, step] = slices.on_device();
            let cell = DVec3::new((f.x1 - f.x0) / dimensions.x, (f.y1 - f.y0) / dimensions.y, step);
            (DVec3::new(f.x0, f.y0, origin), cell, [slices.bias(), f.near() * NEAR], -f.z0)
        }
        ClusterSpace::Orthographic { min, max } => {
            (min, (max - min) / dimensions, [0.0; 2], min.abs().max(max.abs()).max_element())
        }
    };
    let (low, high) = grid.bounds();
    GridData {
        clustering_from_world: inverse(&grid.pose),
        dimensions: grid.dimensions,
        word_count: grid.cluster_count().div_ceil(32) as u32,
        origin: lowest.as_vec3().to_array(),
        scale: (1.0 / cell).as_vec3().to_array(),
        cell: cell.as_vec3().to_array(),
        slice_bias: slice_bias as f32,
        near: near as f32,
        slack: slack(grid, views, origin, reach),
        slack_per_radius: SLACK_PER_METRE,
        light_count: lights,
        visible_capacity: sizes.capacities.visible_clusters,
        index_capacity: u32::try_from(sizes.light_indices()).unwrap_or(u32::MAX),
        list_capacity: sizes.list_bound(),
        mask_capacity: sizes.mask_words() as u32,
        group_capacity: sizes.group_lights() as u32,
        block_scale: assign::block_size(grid.dimensions).map(|clusters| 1.0 / clusters as f32),
        sort_passes: assign::sort_passes(lights),
        tree_depth: assign::tree_depth(lights),
        bounds_low: low.as_vec3().to_array(),
        bounds_scale: (1024.0 / (high - low)).as_vec3().to_array(),
    }
}

/// What the lookup over all lights reads: no grid, every light.
pub fn gridless_data(lights: u32) -> GridData {
    GridData { light_count: lights, ..bytemuck::Zeroable::zeroed() }
}

fn inverse(pose: &Pose) -> [[f32; 4]; 4] {
    pose.inverse().to_matrix().as_mat4().to_cols_array_2d()
}

/// A view as shaders read it; `grid` is what it looks lights up in, and no instance reaches farther than `reach` metres
/// from the world's origin.
pub fn view_data(view: &View, grid: Option<&Grid>, resolution: [u32; 2], reach: f64) -> ViewData {
    let f = &view.frustum;
    let view_from_world = view.pose.inverse().to_matrix();
    let world_from_view = view.pose.to_matrix();
    let clustering_from_view =
        grid.map_or(glam::DMat4::IDENTITY, |grid| grid.pose.inverse().to_matrix() * world_from_view);
    ViewData {
        clip_from_world: (f.clip_from_view() * view_from_world).as_mat4().to_cols_array_2d(),
        world_from_view: world_from_view.as_mat4().to_cols_array_2d(),
        clustering_from_view: clustering_from_view.as_mat4().to_cols_array_2d(),
        tangent_min: [f.x0 as f32, f.y0 as f32],
        tangent_extent: [(f.x1 - f.x0) as f32, (f.y1 - f.y0) as f32],
        resolution,
        near: -f.z1 as f32,
        far: -f.z0 as f32,
        planes: ViewPlanes::new(view).for_device(reach),
        clip_plane: view.pose.mirror.map_or(DVec4::W, |mirror| mirror.plane()).as_vec4().to_array(),
        mirrored: u32::from(view.pose.mirror.is_some()),
    }
}
