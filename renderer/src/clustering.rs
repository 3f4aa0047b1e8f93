//! The device's side of one clustering: its buffers, their sizes, their descriptor sets.
//!
//! ```text
//! cluster_bits ─> word_ranks, visible_clusters ─> light_masks, list_lengths ─> list_offsets ─> light_indices
//! ```

use crate::assign::{self, Assigner};
use crate::culling::ViewPlanes;
use crate::frame::{DrawBuffers, SLOTS};
use crate::geometry::{ClusterSpace, Grid};
use crate::gpu_interface::{
    ASSIGN_GROUP, BLOCK_WORDS, BUFFERS, COUNTER_COUNT, Candidate, ClusterGroup, ClusteringState,
    DISPATCH_COUNT, DispatchSize, GridData, LightNode, PixelData, SCAN_BLOCK, SORT_BLOCK, SORT_DIGITS,
    ViewData,
};
use crate::layouts::{DescriptorSets, Layouts, write_buffer_set};
use crate::measure::Capacities;
use crate::views::{Pose, View};
use crate::vk::{Buffer, Context, Limits, Memory};
use crate::{Error, Result};
use ash::vk;
use std::ops::Range;
use std::sync::Arc;

/// Rounding of positions and planes in f32 stays below this fraction of the far distance (measured: see the
/// tests of the CPU twin), so radii grown by it never lose a light.
const SLACK_PER_METRE: f32 = 8e-7;

/// Everything that decides a clustering's buffer sizes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClusteringSizes {
    /// Clusters of the grid (largest of all frames); 0 for a method without clusters.
    pub clusters: u64,
    /// Lights (most of all frames).
    pub lights: u32,
    /// Entries.
    pub capacities: Capacities,
    /// How the lists are built.
    pub assigner: Assigner,
    /// Whether the atemporal run's buffers are there.
    pub counting: bool,
    /// Pixels of a view.
    pub pixels: u64,
}

impl ClusteringSizes {
    /// Words of the visibility bits.
    pub fn words(&self) -> u64 {
        self.clusters.div_ceil(32)
    }

    /// Words of the bits of all lists.
    fn mask_words(&self) -> u64 {
        assign::mask_capacity(self.lights, self.capacities.visible_clusters)
    }

    /// Lights, where there are candidates among them.
    fn culled_lights(&self) -> u64 {
        if self.assigner == Assigner::Brute { 0 } else { u64::from(self.lights) }
    }

    /// Lights in the hierarchy.
    fn tree_lights(&self) -> u64 {
        if self.assigner == Assigner::Hierarchy { u64::from(self.lights) } else { 0 }
    }

    /// Groups of visible clusters that scatter makes.
    fn groups(&self) -> u64 {
        let groups = u64::from(self.capacities.visible_clusters.div_ceil(ASSIGN_GROUP));
        if self.assigner == Assigner::Scatter { groups } else { 0 }
    }

    /// Lights of groups that are listed.
    fn group_lights(&self) -> u64 {
        if self.assigner == Assigner::Scatter {
            assign::group_capacity(self.lights, self.groups())
        } else {
            0
        }
    }

    /// Counts of the digits of all blocks of the sort.
    fn digit_counts(&self) -> u64 {
        self.tree_lights().div_ceil(u64::from(SORT_BLOCK)) * u64::from(SORT_DIGITS)
    }

    /// Bytes of each buffer, in binding order of those that [`ClusteringBuffers`] makes.
    fn bytes(&self) -> [(&'static str, u64); 22] {
        let counting = u64::from(self.counting);
        let visible = u64::from(self.capacities.visible_clusters);
        let nodes = if self.tree_lights() > 0 { assign::tree_nodes(self.lights) } else { 0 };
        let blocks = self.scan_items().div_ceil(u64::from(SCAN_BLOCK));
        [
            ("light_spheres", 16 * u64::from(self.lights)),
            ("cluster_bits", 4 * self.words()),
            ("word_ranks", 4 * self.words()),
            ("visible_clusters", 4 * visible),
            ("block_sums", 4 * blocks),
            ("list_lengths", 4 * visible),
            ("list_offsets", 4 * (visible + 1)),
            ("light_indices", 4 * u64::from(self.capacities.light_indices)),
            ("state", size_of::<ClusteringState>() as u64),
            ("dispatches", u64::from(DISPATCH_COUNT) * size_of::<DispatchSize>() as u64),
            ("counters", 8 * COUNTER_COUNT as u64),
            ("visible_fragments", 4 * visible * counting),
            ("lights_per_fragment", 4 * (u64::from(self.lights) + 1) * counting),
            ("light_masks", 4 * self.mask_words()),
            ("sort_items", 2 * 8 * self.tree_lights()),
            ("digit_counts", 4 * (self.digit_counts() + self.group_lights() / u64::from(ASSIGN_GROUP))),
            ("tree_spheres", 16 * self.tree_lights()),
            ("tree_lights", 4 * (self.tree_lights() + self.group_lights())),
            (
                "light_nodes",
                size_of::<LightNode>() as u64 * nodes + size_of::<ClusterGroup>() as u64 * self.groups(),
            ),
            ("block_bits", 4 * u64::from(BLOCK_WORDS)),
            ("light_bits", 4 * self.culled_lights().div_ceil(32)),
            ("candidates", size_of::<Candidate>() as u64 * self.culled_lights()),
        ]
    }

    /// Items of the longest prefix sum.
    fn scan_items(&self) -> u64 {
        self.words().max(u64::from(self.capacities.visible_clusters)).max(self.digit_counts())
    }

    /// The most entries that the device's buffers hold.
    pub fn most(&self, limits: &Limits) -> Capacities {
        let words = limits.max_storage_buffer_range / 4;
        let entries = |words: u64| u32::try_from(words).unwrap_or(u32::MAX);
        Capacities { visible_clusters: entries(words - 1), light_indices: entries(words) }
    }

    /// Refuses what the device cannot hold or dispatch, naming the largest fault.
    pub fn check(&self, limits: &Limits) -> Result<()> {
        for (name, size) in self.bytes() {
            if size > limits.max_storage_buffer_range {
                return Err(Error::Device(format!(
                    "buffer {name} would need {size} bytes ({} clusters, {} lights, {} visible clusters, {} light \
                     indices) but the device binds at most {}: use fewer lights or larger clusters",
                    self.clusters,
                    self.lights,
                    self.capacities.visible_clusters,
                    self.capacities.light_indices,
                    limits.max_storage_buffer_range
                )));
            }
        }
        let most = u64::from(limits.max_compute_work_group_count[0]);
        let tiles = u64::from(self.lights.div_ceil(ASSIGN_GROUP));
        if tiles > most {
            return Err(Error::Device(format!(
                "{} lights would need a dispatch of {tiles} workgroups but the device allows {most}: use fewer lights",
                self.lights
            )));
        }
        let groups = self.scan_items().div_ceil(u64::from(SCAN_BLOCK));
        if groups > most {
            return Err(Error::Device(format!(
                "{} visible clusters would need a dispatch of {groups} workgroups but the device allows {most}: \
                 use larger clusters",
                self.capacities.visible_clusters
            )));
        }
        Ok(())
    }
}

/// Buffers that shaders fill.
pub struct ClusteringBuffers {
    /// Lights in clustering space: centre, radius.
    pub light_spheres: Buffer,
    /// A bit per cluster.
    pub cluster_bits: Buffer,
    /// Visible clusters before each word of bits.
    pub word_ranks: Buffer,
    /// Linear indices, ascending.
    pub visible_clusters: Buffer,
    /// Of the prefix sums.
    pub block_sums: Buffer,
    /// How many lights each list has.
    pub list_lengths: Buffer,
    /// Where each list begins, and the total.
    pub list_offsets: Buffer,
    /// The lists.
    pub light_indices: Buffer,
    /// [`ClusteringState`].
    pub state: Buffer,
    /// Sizes of indirect dispatches.
    pub dispatches: Buffer,
    /// 64-bit counters.
    pub counters: Buffer,
    /// Per visible cluster; counting alone.
    pub visible_fragments: Buffer,
    /// Histogram; counting alone.
    pub lights_per_fragment: Buffer,
    /// [`PixelData`] of one view.
    pub pixels: Buffer,
    /// Bits of the lists, a bit per light.
    pub light_masks: Buffer,
    /// (Key, candidate), two halves.
    pub sort_items: Buffer,
    /// Of the sort, by digit, then by block; or the groups of scatter's tiles.
    pub digit_counts: Buffer,
    /// `light_spheres` in the order of the hierarchy.
    pub tree_spheres: Buffer,
    /// Their numbers among the candidates; or the lights of scatter's groups.
    pub tree_lights: Buffer,
    /// The nodes of the hierarchy; or scatter's groups.
    pub light_nodes: Buffer,
    /// Blocks that hold visible clusters, a bit each.
    pub block_bits: Buffer,
    /// Lights that may meet a visible cluster, a bit each.
    pub light_bits: Buffer,
    /// Those lights.
    pub candidates: Buffer,
}

impl ClusteringBuffers {
    fn new(context: &Arc<Context>, sizes: &ClusteringSizes) -> Result<Self> {
        sizes.check(&context.limits)?;
        let bytes = sizes.bytes();
        let make = |name: &str| {
            let size = bytes.iter().find(|(known, _)| *known == name).map_or(0, |b| b.1);
            device_buffer(context, name, size)
        };
        let pixels = if sizes.counting { sizes.pixels * size_of::<PixelData>() as u64 } else { 0 };
        Ok(Self {
            light_spheres: make("light_spheres")?,
            cluster_bits: make("cluster_bits")?,
            word_ranks: make("word_ranks")?,
            visible_clusters: make("visible_clusters")?,
            block_sums: make("block_sums")?,
            list_lengths: make("list_lengths")?,
            list_offsets: make("list_offsets")?,
            light_indices: make("light_indices")?,
            state: make("state")?,
            dispatches: make("dispatches")?,
            counters: make("counters")?,
            visible_fragments: make("visible_fragments")?,
            lights_per_fragment: make("lights_per_fragment")?,
            pixels: device_buffer(context, "pixels", pixels)?,
            light_masks: make("light_masks")?,
            sort_items: make("sort_items")?,
            digit_counts: make("digit_counts")?,
            tree_spheres: make("tree_spheres")?,
            tree_lights: make("tree_lights")?,
            light_nodes: make("light_nodes")?,
            block_bits: make("block_bits")?,
            light_bits: make("light_bits")?,
            candidates: make("candidates")?,
        })
    }
}

/// Smallest buffer made, so that every binding has one.
const MIN_BUFFER: u64 = 256;

/// A device-local storage buffer that can be copied, filled and dispatched from.
pub fn device_buffer(context: &Arc<Context>, name: &str, size: u64) -> Result<Buffer> {
    use vk::BufferUsageFlags as U;
    let usage = U::STORAGE_BUFFER | U::TRANSFER_SRC | U::TRANSFER_DST | U::INDIRECT_BUFFER;
    Buffer::new(context, name, size.max(MIN_BUFFER).next_multiple_of(4), usage, Memory::Device)
}

/// Buffers that all clusterings share.
pub struct SharedBuffers<'a> {
    /// [`ViewData`] of all views, a buffer per frame in flight.
    pub views: [&'a Buffer; SLOTS],
    /// The frame's lights.
    pub lights: &'a Buffer,
    /// The scene's materials.
    pub materials: &'a Buffer,
    /// The scene's instances.
    pub instances: &'a Buffer,
    /// Its draw slots.
    pub draw_slots: &'a Buffer,
    /// Their counts and order, a buffer per frame in flight.
    pub draw_order: [&'a Buffer; SLOTS],
    /// What stage `cull` fills.
    pub draws: &'a DrawBuffers,
}

/// One clustering on the device.
pub struct Clustering {
    /// What shaders fill.
    pub buffers: ClusteringBuffers,
    /// [`GridData`], mapped, one per frame in flight.
    pub grids: [Buffer; SLOTS],
    /// The storage buffers, one set per frame in flight.
    pub sets: [vk::DescriptorSet; SLOTS],
    /// The views that look lights up here.
    pub views: Range<usize>,
    /// Words of visibility bits of this frame's grid.
    pub word_count: u32,
    /// Most visible clusters that fit.
    pub visible_capacity: u32,
    _sets: DescriptorSets,
}

impl Clustering {
    /// Makes the buffers and the sets that bind them.
    pub fn new(
        context: &Arc<Context>,
        layouts: &Layouts,
        shared: &SharedBuffers,
        sizes: &ClusteringSizes,
        views: Range<usize>,
    ) -> Result<Self> {
        let buffers = ClusteringBuffers::new(context, sizes)?;
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let grid = || Buffer::new(context, "grid", size_of::<GridData>() as u64, usage, Memory::Upload);
        let grids = [grid()?, grid()?];
        let kind = (vk::DescriptorType::STORAGE_BUFFER, BUFFERS.len() as u32);
        let sets = DescriptorSets::new(context, "clustering", layouts.buffers, kind, SLOTS)?;
        for (slot, grid) in grids.iter().enumerate() {
            write_buffer_set(context, sets.sets[slot], &handles(&buffers, shared, slot, grid));
        }
        Ok(Self {
            buffers,
            grids,
            sets: [sets.sets[0], sets.sets[1]],
            views,
            word_count: 0,
            visible_capacity: sizes.capacities.visible_clusters,
            _sets: sets,
        })
    }
}

/// In the order of [`BUFFERS`].
fn handles(
    b: &ClusteringBuffers,
    shared: &SharedBuffers,
    slot: usize,
    grid: &Buffer,
) -> [vk::Buffer; BUFFERS.len()] {
    [
        shared.views[slot],
        grid,
        shared.lights,
        &b.light_spheres,
        &b.cluster_bits,
        &b.word_ranks,
        &b.visible_clusters,
        &b.block_sums,
        &b.list_lengths,
        &b.list_offsets,
        &b.light_indices,
        &b.state,
        &b.dispatches,
        &b.counters,
        &b.visible_fragments,
        &b.lights_per_fragment,
        &b.pixels,
        shared.materials,
        shared.instances,
        &b.light_masks,
        &b.sort_items,
        &b.digit_counts,
        &b.tree_spheres,
        &b.tree_lights,
        &b.light_nodes,
        &b.block_bits,
        &b.light_bits,
        &b.candidates,
        shared.draw_slots,
        shared.draw_order[slot],
        &shared.draws.commands,
        &shared.draws.drawn_instances,
    ]
    .map(|buffer| buffer.handle)
}

/// A grid as shaders read it.
pub fn grid_data(grid: &Grid, lights: u32, sizes: &ClusteringSizes) -> GridData {
    let dimensions = glam::DVec3::from_array(grid.dimensions.map(f64::from));
    let (origin, cell, reach) = match grid.space {
        ClusterSpace::Perspective { frustum: f, ratio } => (
            glam::DVec3::new(f.x0, f.y0, -f.z1),
            glam::DVec3::new(
                (f.x1 - f.x0) / dimensions.x,
                (f.y1 - f.y0) / dimensions.y,
                ratio.ln_1p() / std::f64::consts::LN_2,
            ),
            -f.z0,
        ),
        ClusterSpace::Orthographic { min, max } => {
            (min, (max - min) / dimensions, min.abs().max(max.abs()).max_element())
        }
    };
    let (low, high) = bounds(grid);
    GridData {
        clustering_from_world: rigid_inverse(&grid.pose),
        dimensions: grid.dimensions,
        word_count: grid.cluster_count().div_ceil(32) as u32,
        origin: origin.as_vec3().to_array(),
        scale: (1.0 / cell).as_vec3().to_array(),
        cell: cell.as_vec3().to_array(),
        slack: SLACK_PER_METRE * reach as f32,
        light_count: lights,
        visible_capacity: sizes.capacities.visible_clusters,
        index_capacity: sizes.capacities.light_indices,
        mask_capacity: sizes.mask_words() as u32,
        group_capacity: sizes.group_lights() as u32,
        block_size: assign::block_size(grid.dimensions),
        sort_passes: assign::sort_passes(lights),
        tree_depth: assign::tree_depth(lights),
        bounds_low: low.as_vec3().to_array(),
        bounds_scale: (1024.0 / (high - low)).as_vec3().to_array(),
    }
}

/// Lowest and highest corner of a grid in clustering space.
fn bounds(grid: &Grid) -> (glam::DVec3, glam::DVec3) {
    let last = grid.dimensions.map(|count| count - 1);
    let (mut low, mut high) = (glam::DVec3::INFINITY, glam::DVec3::NEG_INFINITY);
    for corner in 0..8 {
        let cell = std::array::from_fn(|axis| if corner >> axis & 1 == 1 { last[axis] } else { 0 });
        let (cell_low, cell_high) = grid.cell_bounds(cell);
        (low, high) = (low.min(cell_low), high.max(cell_high));
    }
    (low, high)
}

/// What the lookup over all lights reads: no grid, every light.
pub fn gridless_data(lights: u32) -> GridData {
    GridData { light_count: lights, ..bytemuck::Zeroable::zeroed() }
}

fn rigid_inverse(pose: &Pose) -> [[f32; 4]; 4] {
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
    }
}
