//! Drawing the scene: what every geometry pass shares.

use crate::draw_list::DrawRun;
use crate::frame::Frame;
use crate::gpu_interface::{SET_BUFFERS, SET_MATERIAL};
use crate::pass::Recorder;
use crate::vk::Pipeline;
use ash::vk;

/// Opens dynamic rendering over a whole view and sets the viewport (flipped, so that +Y stays up).
pub fn begin_rendering(
    r: &Recorder,
    frame: &Frame,
    color: Option<&vk::RenderingAttachmentInfo>,
    depth: &vk::RenderingAttachmentInfo,
) {
    let [width, height] = frame.resolution;
    let area = vk::Rect2D { offset: vk::Offset2D::default(), extent: vk::Extent2D { width, height } };
    let viewport = vk::Viewport {
        x: 0.0,
        y: height as f32,
        width: width as f32,
        height: -(height as f32),
        min_depth: 0.0,
        max_depth: 1.0,
    };
    let mut info = vk::RenderingInfo::default().render_area(area).layer_count(1).depth_attachment(depth);
    if let Some(color) = color {
        info = info.color_attachments(std::slice::from_ref(color));
    }
    let device = &r.context.device;
    unsafe {
        device.cmd_begin_rendering(r.commands, &info);
        device.cmd_set_viewport(r.commands, 0, &[viewport]);
        device.cmd_set_scissor(r.commands, 0, &[area]);
        device.cmd_bind_vertex_buffers(r.commands, 0, &[frame.scene.vertices.handle], &[0]);
        device.cmd_bind_index_buffer(r.commands, frame.scene.indices.handle, 0, vk::IndexType::UINT32);
    }
}

/// Closes what [`begin_rendering`] opened.
pub fn end_rendering(r: &Recorder) {
    unsafe { r.context.device.cmd_end_rendering(r.commands) };
}

/// The depth attachment of a view: cleared to far, or kept for testing alone.
pub fn depth_attachment(frame: &Frame, view: usize, clear: bool) -> vk::RenderingAttachmentInfo<'static> {
    let (layout, load) = if clear {
        (vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL, vk::AttachmentLoadOp::CLEAR)
    } else {
        (vk::ImageLayout::DEPTH_READ_ONLY_OPTIMAL, vk::AttachmentLoadOp::LOAD)
    };
    vk::RenderingAttachmentInfo::default()
        .image_view(frame.targets[view].depth.view)
        .image_layout(layout)
        .load_op(load)
        .store_op(if clear { vk::AttachmentStoreOp::STORE } else { vk::AttachmentStoreOp::NONE })
        .clear_value(vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth: 0.0, stencil: 0 } })
}

/// Draws `runs` of one view with one pipeline; material textures are bound where the pipeline reads them.
pub fn draw(r: &Recorder, frame: &Frame, view: usize, pipeline: &Pipeline, runs: &[DrawRun], textured: bool) {
    if runs.is_empty() {
        return;
    }
    let device = &r.context.device;
    frame.bind(r, vk::PipelineBindPoint::GRAPHICS, pipeline, view);
    let (mut material, mut facing) = (None, None);
    for run in runs {
        let batch = &frame.scene.batches[run.batch as usize];
        if textured && material != Some(batch.material) {
            material = Some(batch.material);
            frame.bind_set(
                r,
                vk::PipelineBindPoint::GRAPHICS,
                SET_MATERIAL,
                frame.scene.material_sets[batch.material as usize],
            );
        }
        if facing != Some((batch.mirrored, batch.double_sided)) {
            facing = Some((batch.mirrored, batch.double_sided));
            set_facing(r, batch.mirrored, batch.double_sided);
        }
        unsafe {
            device.cmd_draw_indexed(
                r.commands,
                batch.index_count,
                run.instance_count,
                batch.first_index,
                batch.vertex_offset,
                run.first_instance,
            );
        }
    }
}

fn set_facing(r: &Recorder, mirrored: bool, double_sided: bool) {
    let cull = if double_sided { vk::CullModeFlags::NONE } else { vk::CullModeFlags::BACK };
    let front = if mirrored { vk::FrontFace::CLOCKWISE } else { vk::FrontFace::COUNTER_CLOCKWISE };
    unsafe {
        r.context.device.cmd_set_cull_mode(r.commands, cull);
        r.context.device.cmd_set_front_face(r.commands, front);
    }
}

impl Frame<'_> {
    /// Binds a pipeline with the buffers and the number of `view`.
    pub fn bind(&self, r: &Recorder, point: vk::PipelineBindPoint, pipeline: &Pipeline, view: usize) {
        let clustering = self.clustering_of_view(view);
        self.bind_clustering(r, point, pipeline, clustering);
        self.push_view(r, view);
    }

    /// Tells shaders the number of the view.
    pub fn push_view(&self, r: &Recorder, view: usize) {
        let stages = vk::ShaderStageFlags::ALL;
        let view = (view as u32).to_ne_bytes();
        unsafe {
            r.context.device.cmd_push_constants(r.commands, self.layouts.pipeline, stages, 0, &view);
        }
    }

    /// Pushes the number of the step, for pipelines that run several times in a stage.
    pub fn push_step(&self, r: &Recorder, step: u32) {
        let (stages, step) = (vk::ShaderStageFlags::ALL, step.to_ne_bytes());
        unsafe {
            r.context.device.cmd_push_constants(r.commands, self.layouts.pipeline, stages, 4, &step);
        }
    }

    /// Binds a pipeline with the buffers of clustering `clustering`.
    pub fn bind_clustering(
        &self,
        r: &Recorder,
        point: vk::PipelineBindPoint,
        pipeline: &Pipeline,
        clustering: usize,
    ) {
        unsafe { r.context.device.cmd_bind_pipeline(r.commands, point, pipeline.handle) };
        self.bind_set(r, point, SET_BUFFERS, self.clusterings[clustering].sets[self.slot]);
    }

    /// Binds one descriptor set.
    pub fn bind_set(&self, r: &Recorder, point: vk::PipelineBindPoint, index: u32, set: vk::DescriptorSet) {
        unsafe {
            r.context.device.cmd_bind_descriptor_sets(
                r.commands,
                point,
                self.layouts.pipeline,
                index,
                &[set],
                &[],
            );
        }
    }
}
