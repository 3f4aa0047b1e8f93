//! The device's side of one clustering: its buffers and the descriptor sets that bind them.

mod host_data;

pub use host_data::{
    SLACK_PER_METRE, SLACK_PER_METRE_BEYOND, grid_data, gridless_data, view_data, world_slack,
};

use crate::buffers::{BUFFER_COUNT, BufferName, BufferSet, BufferView, ClusteringSizes, Owner, set};
use crate::geometry::{ClusterSpace, Grid};
use crate::layouts::{BoundBuffers, DescriptorSets, Pipeline};
use crate::vk::{Buffer, Context, Memory, TexelView};
use crate::{Error, Result};
use ash::vk;
use std::ops::{Index, Range};
use std::sync::Arc;

/// How many frames may be in flight at once; each has a slot of its own.
pub const FRAME_SLOTS: usize = 2;

/// Smallest buffer made, so that every binding has one.
const MIN_BUFFER: u64 = 256;

/// Makes a buffer of `size` bytes with the debug name and the uses that are declared of `name`.
pub fn make_buffer(context: &Arc<Context>, name: BufferName, size: u64, memory: Memory) -> Result<Buffer> {
    let info = name.info();
    let size = if info.uniform.is_some() { size } else { size.max(MIN_BUFFER).next_multiple_of(4) };
    Buffer::new(context, info.name, size, info.usage(), memory)
}

/// The buffers that have one owner, by their names.
pub struct ClusteringBuffers([Option<Buffer>; BUFFER_COUNT]);

impl ClusteringBuffers {
    fn new(context: &Arc<Context>, sizes: &ClusteringSizes, owner: Owner, memory: Memory) -> Result<Self> {
        let mut buffers = [const { None }; BUFFER_COUNT];
        for name in BufferName::ALL.into_iter().filter(|name| name.info().owner == owner) {
            let size = name.info().size.map_or(0, |size| size(sizes));
            buffers[name as usize] = Some(make_buffer(context, name, size, memory)?);
        }
        Ok(Self(buffers))
    }
}

impl Index<BufferName> for ClusteringBuffers {
    type Output = Buffer;

    fn index(&self, name: BufferName) -> &Buffer {
        self.0[name as usize].as_ref().unwrap_or_else(|| panic!("{name:?} is no clustering's"))
    }
}

/// A buffer that all clusterings share, as each frame in flight has it.
pub type SharedBuffer<'a> = (BufferName, [&'a Buffer; FRAME_SLOTS]);

/// One clustering on the device.
pub struct Clustering {
    /// Buffers that shaders fill.
    pub buffers: ClusteringBuffers,
    /// What the host writes for each frame, one per frame in flight, mapped.
    pub host: [ClusteringBuffers; FRAME_SLOTS],
    /// The views that look lights up here.
    pub views: Range<usize>,
    /// Cells of this frame's grid along each axis; zero without a grid.
    pub dimensions: [u32; 3],
    /// Clusters of this frame's grid.
    pub cluster_count: u32,
    /// Words of visibility bits of this frame's grid.
    pub word_count: u32,
    /// Most visible clusters that fit.
    pub visible_capacity: u32,
    /// The grid, wherever it lies, whose boxes are on the device, or will be once they are built.
    boxes_of: Option<(ClusterSpace, [u32; 3])>,
    /// Whether the frame at hand builds the boxes around cells.
    pub builds_boxes: bool,
    handles: [[vk::Buffer; BUFFER_COUNT]; FRAME_SLOTS],
    sets: [Vec<vk::DescriptorSet>; FRAME_SLOTS],
    empty: BufferSet,
    pools: Vec<DescriptorSets>,
    texels: Texels,
}

impl Clustering {
    /// Makes the buffers, and for each of `pipelines` the descriptor sets that bind what it uses of them.
    pub fn new(
        context: &Arc<Context>,
        shared: &[SharedBuffer],
        sizes: &ClusteringSizes,
        views: Range<usize>,
        pipelines: &[Arc<Pipeline>],
    ) -> Result<Self> {
        sizes.check(&context.limits)?;
        let buffers = ClusteringBuffers::new(context, sizes, Owner::Clustering, Memory::Device)?;
        let host = || ClusteringBuffers::new(context, sizes, Owner::ClusteringFrame, Memory::Upload);
        let host = [host()?, host()?];
        let all = [all_buffers(&buffers, &host[0], shared, 0)?, all_buffers(&buffers, &host[1], shared, 1)?];
        let mut texels = Texels { views: vec![], handles: [vk::BufferView::null(); BUFFER_COUNT] };
        for name in BufferName::ALL {
            if let Some(view) = name.info().texels {
                let view = TexelView::new(context, all[0][name as usize], view.format())?;
                texels.handles[name as usize] = view.handle;
                texels.views.push(view);
            }
        }
        let mut this = Self {
            handles: all.map(|all| all.map(|buffer| buffer.handle)),
            buffers,
            host,
            views,
            dimensions: [0; 3],
            cluster_count: 0,
            word_count: 0,
            visible_capacity: sizes.capacities.visible_clusters,
            boxes_of: None,
            builds_boxes: false,
            sets: [const { vec![] }; FRAME_SLOTS],
            empty: empty(sizes),
            pools: vec![],
            texels,
        };
        this.bind(context, pipelines)?;
        Ok(this)
    }

    /// Makes the sets that bind what more pipelines use.
    pub fn bind(&mut self, context: &Arc<Context>, pipelines: &[Arc<Pipeline>]) -> Result<()> {
        let pool = allocate(context, pipelines)?;
        let most = pipelines.iter().map(|pipeline| pipeline.number + 1).max().unwrap_or(0);
        for (slot, sets) in self.sets.iter_mut().enumerate() {
            sets.resize(most.max(sets.len()), vk::DescriptorSet::null());
            for (pipeline, made) in pipelines.iter().zip(pool.sets.chunks(FRAME_SLOTS)) {
                context.name(made[slot], &pipeline.name);
                write(context, made[slot], pipeline, &self.handles[slot], &self.texels.handles);
                sets[pipeline.number] = made[slot];
            }
        }
        self.pools.push(pool);
        Ok(())
    }

    /// Has the boxes around the cells of `grid` built, unless the device has them, or those of one like it elsewhere.
    pub fn want_boxes(&mut self, grid: &Grid) {
        let wanted = Some((grid.space, grid.dimensions));
        if self.boxes_of != wanted {
            self.boxes_of = wanted;
            self.builds_boxes = true;
        }
    }

    /// What passes bind for the frame in flight in `slot`.
    pub fn bound(&self, slot: usize) -> BoundBuffers<'_> {
        BoundBuffers { handles: &self.handles[slot], sets: &self.sets[slot], empty: self.empty }
    }
}

/// The buffers that the way at hand leaves empty.
fn empty(sizes: &ClusteringSizes) -> BufferSet {
    let is_empty = |name: &BufferName| name.info().size.is_some_and(|size| size(sizes) == 0);
    BufferName::ALL.into_iter().filter(is_empty).fold(BufferSet::EMPTY, |all, name| all | set(&[name]))
}

/// Views of buffers as texels, by the buffers' names.
struct Texels {
    views: Vec<TexelView>,
    handles: [vk::BufferView; BUFFER_COUNT],
}

/// Every buffer of one frame in flight, in the order of their names.
fn all_buffers<'a>(
    buffers: &'a ClusteringBuffers,
    host: &'a ClusteringBuffers,
    shared: &[SharedBuffer<'a>],
    slot: usize,
) -> Result<[&'a Buffer; BUFFER_COUNT]> {
    let found = |name: BufferName| {
        let own = || buffers.0[name as usize].as_ref().or(host.0[name as usize].as_ref());
        let given = shared.iter().find(|(known, _)| *known == name).map(|(_, buffers)| buffers[slot]);
        given.or_else(own).ok_or_else(|| Error::Internal(format!("nobody makes buffer {}", name.info().name)))
    };
    let all = BufferName::ALL.into_iter().map(found).collect::<Result<Vec<_>>>()?;
    Ok(std::array::from_fn(|name| all[name]))
}

/// Sets for the frames in flight of each pipeline, one behind the other.
fn allocate(context: &Arc<Context>, pipelines: &[Arc<Pipeline>]) -> Result<DescriptorSets> {
    let layouts: Vec<_> =
        pipelines.iter().flat_map(|pipeline| [pipeline.layout.buffers; FRAME_SLOTS]).collect();
    let kinds = BufferView::ALL.map(|view| {
        let uses = pipelines.iter().flat_map(|pipeline| pipeline.uses().views.keys());
        (view.descriptor(), (FRAME_SLOTS * uses.filter(|used| used.1 == view).count()) as u32)
    });
    DescriptorSets::of(context, "clustering", &layouts, &kinds)
}

/// Points what a pipeline uses to the whole of it.
fn write(
    context: &Context,
    set: vk::DescriptorSet,
    pipeline: &Pipeline,
    handles: &[vk::Buffer; BUFFER_COUNT],
    texels: &[vk::BufferView; BUFFER_COUNT],
) {
    let views = &pipeline.uses().views;
    let info = |&(name, _): &(BufferName, BufferView)| {
        [vk::DescriptorBufferInfo::default().buffer(handles[name as usize]).range(vk::WHOLE_SIZE)]
    };
    let infos: Vec<_> = views.keys().map(info).collect();
    let writes: Vec<_> = views
        .keys()
        .zip(&infos)
        .map(|(&(name, view), info)| {
            let write = vk::WriteDescriptorSet::default()
                .dst_set(set)
                .dst_binding(name.binding(view))
                .descriptor_type(view.descriptor());
            match view {
                BufferView::Storage | BufferView::Uniform => write.buffer_info(info),
                BufferView::Texels => write.texel_buffer_view(std::slice::from_ref(&texels[name as usize])),
            }
        })
        .collect();
    unsafe { context.device.update_descriptor_sets(&writes, &[]) };
}
