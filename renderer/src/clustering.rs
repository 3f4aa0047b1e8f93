//! The device's side of one clustering: its buffers, their sizes, their descriptor sets.
//!
//! ```text
//! cluster_bits ─> word_ranks, visible_clusters ─> light_masks, list_lengths ─> list_offsets ─> light_indices
//! ```

mod host_data;
mod sizes;

pub use host_data::{grid_data, gridless_data, view_data};
pub use sizes::ClusteringSizes;

use crate::Result;
use crate::frame::{DrawBuffers, SLOTS};
use crate::gpu_interface::{BUFFERS, ClusteringState, GridData, PixelData, TEXELS};
use crate::layouts::{BUFFER_SET, BufferSet, DescriptorSets, Layouts, write_buffer_set};
use crate::vk::{Buffer, Context, Memory, TexelView};
use ash::vk;
use std::ops::Range;
use std::sync::Arc;

/// Buffers that shaders fill.
pub struct ClusteringBuffers {
    /// Lights, or candidates, in clustering space: centre, radius.
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
    /// [`crate::gpu_interface::ClusteringState`].
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
    /// Lights that may meet a visible cluster, a bit each; then how many there are before each word.
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
            state: state_buffer(context)?,
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

/// A device-local storage buffer that can be viewed as texels, copied, filled and dispatched from.
pub fn device_buffer(context: &Arc<Context>, name: &str, size: u64) -> Result<Buffer> {
    use vk::BufferUsageFlags as U;
    let usage =
        U::STORAGE_BUFFER | U::UNIFORM_TEXEL_BUFFER | U::TRANSFER_SRC | U::TRANSFER_DST | U::INDIRECT_BUFFER;
    Buffer::new(context, name, size.max(MIN_BUFFER).next_multiple_of(4), usage, Memory::Device)
}

fn state_buffer(context: &Arc<Context>) -> Result<Buffer> {
    use vk::BufferUsageFlags as U;
    let usage = U::STORAGE_BUFFER | U::UNIFORM_BUFFER | U::TRANSFER_SRC;
    Buffer::new(context, "state", size_of::<ClusteringState>() as u64, usage, Memory::Device)
}

/// Buffers that all clusterings share.
pub struct SharedBuffers<'a> {
    /// [`crate::gpu_interface::ViewData`] of all views, a buffer per frame in flight.
    pub views: [&'a Buffer; SLOTS],
    /// The frame's lights.
    pub lights: &'a Buffer,
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
    /// Depths between slices, mapped, as many.
    pub slice_planes: [Buffer; SLOTS],
    /// The storage buffers, one set per frame in flight.
    pub sets: [vk::DescriptorSet; SLOTS],
    /// The views that look lights up here.
    pub views: Range<usize>,
    /// Words of visibility bits of this frame's grid.
    pub word_count: u32,
    /// Most visible clusters that fit.
    pub visible_capacity: u32,
    _sets: DescriptorSets,
    _texels: [TexelView; TEXELS.len()],
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
        let usage = vk::BufferUsageFlags::UNIFORM_BUFFER;
        let grid = || Buffer::new(context, "grid", size_of::<GridData>() as u64, usage, Memory::Upload);
        let grids = [grid()?, grid()?];
        let bytes = (4 * u64::from(sizes.slice_planes)).max(MIN_BUFFER);
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let planes = || Buffer::new(context, "slice planes", bytes, usage, Memory::Upload);
        let slice_planes = [planes()?, planes()?];
        let texels = texels(context, shared, &buffers)?;
        let sets = DescriptorSets::new(context, "clustering", layouts.buffers, &BUFFER_SET, SLOTS)?;
        for (slot, (grid, planes)) in grids.iter().zip(&slice_planes).enumerate() {
            let to = BufferSet {
                buffers: storage(&buffers, shared, (slot, planes)),
                texels: &texels,
                uniforms: [shared.views[slot], grid, &buffers.state],
            };
            write_buffer_set(context, sets.sets[slot], &to);
        }
        Ok(Self {
            buffers,
            grids,
            slice_planes,
            sets: [sets.sets[0], sets.sets[1]],
            views,
            word_count: 0,
            visible_capacity: sizes.capacities.visible_clusters,
            _sets: sets,
            _texels: texels,
        })
    }
}

/// In the order of [`TEXELS`].
fn texels(
    context: &Arc<Context>,
    shared: &SharedBuffers,
    b: &ClusteringBuffers,
) -> Result<[TexelView; TEXELS.len()]> {
    let view = |buffer, place: usize| TexelView::new(context, buffer, TEXELS[place].2);
    Ok([
        view(shared.lights, 0)?,
        view(shared.instances, 1)?,
        view(&b.light_spheres, 2)?,
        view(&b.light_indices, 3)?,
        view(&b.light_masks, 4)?,
        view(&b.block_bits, 5)?,
        view(&b.candidates, 6)?,
        view(&b.tree_spheres, 7)?,
        view(&b.light_nodes, 8)?,
    ])
}

/// In the order of [`BUFFERS`].
fn storage<'a>(
    b: &'a ClusteringBuffers,
    shared: &SharedBuffers<'a>,
    (slot, slice_planes): (usize, &'a Buffer),
) -> [&'a Buffer; BUFFERS.len()] {
    [
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
        slice_planes,
    ]
}
