//! Compute passes, a call each.

use super::{Access, Declared, Recorder, Use};
use crate::buffers::{BufferName, BufferSet};
use crate::gpu_interface::{DispatchSize, Push, SET_BUFFERS, SET_TARGETS};
use crate::layouts::{BoundBuffers, Pipeline};
use ash::vk;

/// How many workgroups of a compute pass run.
#[derive(Debug, Clone, Copy)]
pub enum Size {
    /// As many along x and along y.
    Workgroups(u32, u32),
    /// As many as the device wrote into the entry of [`BufferName::Dispatches`] with this index.
    Indirect(u32),
}

impl Size {
    /// A thread for each of `items`, in workgroups of `workgroup` threads along x.
    pub fn threads(items: u32, workgroup: u32) -> Self {
        Self::Workgroups(items.div_ceil(workgroup), 1)
    }

    /// A thread for each pixel, in workgroups of 8 by 8.
    pub fn pixels([width, height]: [u32; 2]) -> Self {
        Self::Workgroups(width.div_ceil(8), height.div_ceil(8))
    }
}

impl Push {
    /// Tells the number of a view.
    pub fn view(view: usize) -> Self {
        Self { view: view as u32, ..Self::default() }
    }

    /// Tells the number of a step.
    pub fn step(step: u32) -> Self {
        Self { step, ..Self::default() }
    }
}

/// A depth image, as compute shaders sample it.
#[derive(Debug, Clone, Copy)]
pub struct DepthImage {
    /// The image with all its layers.
    pub image: vk::Image,
    /// Descriptor set that binds one layer of the image, among the targets of its view.
    pub set: vk::DescriptorSet,
}

/// A compute pass.
#[derive(Clone, Copy)]
pub struct Dispatch<'a> {
    /// Pipeline that runs.
    pub pipeline: &'a Pipeline,
    /// What the names of buffers stand for.
    pub buffers: BoundBuffers<'a>,
    /// How many workgroups run.
    pub size: Size,
    /// Buffers that are read alone.
    pub reads: BufferSet,
    /// Buffers that are written, and perhaps read.
    pub writes: BufferSet,
    /// The depth image that is sampled.
    pub depth: Option<DepthImage>,
    /// What shaders are told.
    pub push: Push,
}

impl<'a> Dispatch<'a> {
    /// A pass that needs no depth image and is told nothing besides; `reads` and `writes` as in its fields.
    pub fn new(
        pipeline: &'a Pipeline,
        buffers: BoundBuffers<'a>,
        size: Size,
        (reads, writes): (BufferSet, BufferSet),
    ) -> Self {
        Self { pipeline, buffers, size, reads, writes, depth: None, push: Push::default() }
    }
}

impl Recorder<'_> {
    /// Records a compute pass, after all that it reads and writes.
    pub fn dispatch(&mut self, pass: &Dispatch) {
        self.pass(pass.pipeline.stem(), |r| r.record_dispatch(pass));
    }

    fn record_dispatch(&mut self, pass: &Dispatch) {
        let dispatches = pass.buffers.handles[BufferName::Dispatches as usize];
        let declared = Declared { reads: pass.reads, writes: pass.writes };
        let sampled =
            |depth: DepthImage| Access::image(depth.image, vk::ImageAspectFlags::DEPTH, Use::ComputeSample);
        let indirect = matches!(pass.size, Size::Indirect(_));
        let others = [pass.depth.map(sampled), indirect.then(|| Access::buffer(dispatches, Use::Indirect))];
        self.prepare([pass.pipeline], &pass.buffers, declared, others);
        self.context.begin_label(self.commands(), &pass.pipeline.label);
        self.bind(vk::PipelineBindPoint::COMPUTE, pass.pipeline, &pass.buffers, pass.push);
        if let Some(depth) = pass.depth {
            self.bind_set(vk::PipelineBindPoint::COMPUTE, pass.pipeline, SET_TARGETS, depth.set);
        }
        let (device, commands) = (&self.context.device, self.commands());
        match pass.size {
            Size::Workgroups(x, y) => unsafe { device.cmd_dispatch(commands, x, y, 1) },
            Size::Indirect(index) => {
                let offset = u64::from(index) * size_of::<DispatchSize>() as u64;
                unsafe { device.cmd_dispatch_indirect(commands, dispatches, offset) };
            }
        }
        self.context.end_label(self.commands());
    }

    /// Binds a pipeline with what it uses of `buffers`, and pushes what its shaders are told.
    pub fn bind(
        &self,
        point: vk::PipelineBindPoint,
        pipeline: &Pipeline,
        buffers: &BoundBuffers,
        push: Push,
    ) {
        let (device, commands) = (&self.context.device, self.commands());
        unsafe { device.cmd_bind_pipeline(commands, point, pipeline.handle) };
        self.bind_set(point, pipeline, SET_BUFFERS, buffers.sets[pipeline.number]);
        self.push(pipeline, push);
    }

    /// Tells a pipeline's shaders something else.
    pub fn push(&self, pipeline: &Pipeline, push: Push) {
        let (layout, stages) = (pipeline.layout.handle, vk::ShaderStageFlags::ALL);
        let (device, commands) = (&self.context.device, self.commands());
        unsafe { device.cmd_push_constants(commands, layout, stages, 0, bytemuck::bytes_of(&push)) };
    }

    /// Binds one descriptor set for a pipeline.
    pub fn bind_set(
        &self,
        point: vk::PipelineBindPoint,
        pipeline: &Pipeline,
        index: u32,
        set: vk::DescriptorSet,
    ) {
        let layout = pipeline.layout.handle;
        unsafe {
            self.context.device.cmd_bind_descriptor_sets(self.commands(), point, layout, index, &[set], &[]);
        }
    }
}
