//! Drawing whose fragments leave what they find in buffers alone: no image is attached.

use super::{Declared, Push, Recorder};
use crate::buffers::BufferSet;
use crate::layouts::{BoundBuffers, Pipeline};
use ash::vk;

/// A draw of instances that vertex shaders make.
#[derive(Clone, Copy)]
pub struct Draw<'a> {
    /// Pipeline that draws.
    pub pipeline: &'a Pipeline,
    /// What the names of buffers stand for.
    pub buffers: BoundBuffers<'a>,
    /// Pixels along x and y; y goes down.
    pub size: [u32; 2],
    /// Vertices of an instance.
    pub vertices: u32,
    /// Number of instances.
    pub instances: u32,
    /// Buffers that are read alone.
    pub reads: BufferSet,
    /// Buffers that are written, and perhaps read.
    pub writes: BufferSet,
}

impl Recorder<'_> {
    /// Records a draw, after all that it reads and writes.
    pub fn draw(&mut self, draw: &Draw) {
        self.pass(draw.pipeline.stem(), |r| r.record_draw(draw));
    }

    fn record_draw(&mut self, draw: &Draw) {
        let declared = Declared { reads: draw.reads, writes: draw.writes };
        self.prepare([draw.pipeline], &draw.buffers, declared, []);
        self.context.begin_label(self.commands(), &draw.pipeline.label);
        let [width, height] = draw.size;
        let area = vk::Rect2D { offset: vk::Offset2D::default(), extent: vk::Extent2D { width, height } };
        let viewport = vk::Viewport {
            x: 0.0,
            y: 0.0,
            width: width as f32,
            height: height as f32,
            min_depth: 0.0,
            max_depth: 1.0,
        };
        let info = vk::RenderingInfo::default().render_area(area).layer_count(1);
        let (device, commands) = (&self.context.device, self.commands());
        unsafe {
            device.cmd_begin_rendering(commands, &info);
            device.cmd_set_viewport(commands, 0, &[viewport]);
            device.cmd_set_scissor(commands, 0, &[area]);
        }
        self.bind(vk::PipelineBindPoint::GRAPHICS, draw.pipeline, &draw.buffers, Push::default());
        unsafe {
            device.cmd_draw(commands, draw.vertices, draw.instances, 0, 0);
            device.cmd_end_rendering(commands);
        }
        self.context.end_label(self.commands());
    }
}
