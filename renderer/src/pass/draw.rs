//! Drawing whose fragments leave what they find in buffers, with no image attached, or in layers of an image, the least of all.

use super::{Access, Declared, Push, Recorder, Use};
use crate::buffers::BufferSet;
use crate::layouts::{BoundBuffers, Pipeline};
use crate::vk::Image;
use ash::vk;
use std::ops::Range;

/// A draw of instances that vertex shaders make.
#[derive(Clone)]
pub struct Draw<'a> {
    /// Pipeline that draws.
    pub pipeline: &'a Pipeline,
    /// What the names of buffers stand for.
    pub buffers: BoundBuffers<'a>,
    /// Pixels along x and y; y goes down.
    pub size: [u32; 2],
    /// Vertices of an instance.
    pub vertices: u32,
    /// Which instances; shaders are told the first as the step.
    pub instances: Range<u32>,
    /// An image of as many layers as there are instances or more, of which that many are cleared to ones and drawn into.
    pub layers: Option<&'a Image>,
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
        let attached = |image: &Image| Access::image(image.handle, image.aspect, Use::Color);
        self.prepare([draw.pipeline], &draw.buffers, declared, [draw.layers.map(attached)]);
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
        let ones = vk::ClearValue { color: vk::ClearColorValue { float32: [1.0; 4] } };
        let colors = draw.layers.map(|image| {
            [vk::RenderingAttachmentInfo::default()
                .image_view(image.view)
                .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
                .load_op(vk::AttachmentLoadOp::CLEAR)
                .store_op(vk::AttachmentStoreOp::STORE)
                .clear_value(ones)]
        });
        let instances = draw.instances.len() as u32;
        let info = vk::RenderingInfo::default()
            .render_area(area)
            .layer_count(if colors.is_some() { instances } else { 1 })
            .color_attachments(colors.as_ref().map_or(&[], |colors| colors));
        let (device, commands) = (&self.context.device, self.commands());
        unsafe {
            device.cmd_begin_rendering(commands, &info);
            device.cmd_set_viewport(commands, 0, &[viewport]);
            device.cmd_set_scissor(commands, 0, &[area]);
        }
        let first = draw.instances.start;
        self.bind(vk::PipelineBindPoint::GRAPHICS, draw.pipeline, &draw.buffers, Push::step(first));
        unsafe {
            device.cmd_draw(commands, draw.vertices, instances, 0, first);
            device.cmd_end_rendering(commands);
        }
        self.context.end_label(self.commands());
    }
}
