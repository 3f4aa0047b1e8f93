//! Drawing the scene: what every geometry pass shares.

use crate::draw_list::{DrawRun, SurfaceKind};
use crate::frame::{Draws, Eyes, Frame, Layer};
use crate::gpu_interface::{DrawCommand, SET_BUFFERS, SET_MATERIAL};
use crate::pass::{Access, Recorder, Use};
use crate::texture_sets::TextureSet;
use crate::vk::{Buffer, Pipeline};
use ash::vk;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Opens dynamic rendering over whole views and sets the viewport (flipped, so that +Y stays up).
pub fn begin_rendering(
    r: &mut Recorder,
    frame: &Frame,
    eyes: Eyes,
    color: Option<&vk::RenderingAttachmentInfo>,
    depth: &vk::RenderingAttachmentInfo,
) {
    if let Draws::Indirect { buffers, .. } = &frame.draws {
        r.access(&[
            Access::buffer(buffers.commands.handle, Use::Indirect),
            Access::buffer(buffers.drawn_instances.handle, Use::VertexRead),
        ]);
    }
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
    let mut info = vk::RenderingInfo::default()
        .render_area(area)
        .layer_count(frame.view_count(eyes))
        .depth_attachment(depth);
    if let Some(color) = color {
        info = info.color_attachments(std::slice::from_ref(color));
    }
    let device = &r.context.device;
    unsafe {
        device.cmd_begin_rendering(r.commands(), &info);
        device.cmd_set_viewport(r.commands(), 0, &[viewport]);
        device.cmd_set_scissor(r.commands(), 0, &[area]);
        device.cmd_bind_vertex_buffers(r.commands(), 0, &[frame.scene.vertices.handle], &[0]);
        device.cmd_bind_index_buffer(r.commands(), frame.scene.indices.handle, 0, vk::IndexType::UINT32);
    }
}

/// Closes what [`begin_rendering`] opened.
pub fn end_rendering(r: &Recorder) {
    unsafe { r.context.device.cmd_end_rendering(r.commands()) };
}

/// What is attached of a view's image: its layer, or all layers for all views.
pub fn attached(layer: &Layer, eyes: Eyes) -> vk::ImageView {
    match eyes {
        Eyes::One(_) => layer.view,
        Eyes::All => layer.image.view,
    }
}

/// The depth attachment of some views: cleared to far, or kept for testing alone.
pub fn depth_attachment(frame: &Frame, eyes: Eyes, clear: bool) -> vk::RenderingAttachmentInfo<'static> {
    let (layout, load) = if clear {
        (vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL, vk::AttachmentLoadOp::CLEAR)
    } else {
        (vk::ImageLayout::DEPTH_READ_ONLY_OPTIMAL, vk::AttachmentLoadOp::LOAD)
    };
    vk::RenderingAttachmentInfo::default()
        .image_view(attached(&frame.targets[eyes.first()].depth, eyes))
        .image_layout(layout)
        .load_op(load)
        .store_op(if clear { vk::AttachmentStoreOp::STORE } else { vk::AttachmentStoreOp::NONE })
        .clear_value(vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth: 0.0, stencil: 0 } })
}

/// What draws surfaces of a kind.
#[derive(Clone, Copy)]
pub enum Pipelines<'a> {
    /// The same for all.
    One(&'a Pipeline),
    /// By the textures of the material.
    ByTextures(&'a BTreeMap<TextureSet, Arc<Pipeline>>),
}

/// Draws one kind of surface; material textures are bound where the pipelines read them.
pub fn draw(
    r: &Recorder,
    frame: &Frame,
    eyes: Eyes,
    pipelines: Pipelines,
    (kind, textured): (SurfaceKind, bool),
) {
    if !frame.draws_any(eyes, kind) {
        return;
    }
    let mut state = SurfaceState {
        pipelines,
        view: eyes.first(),
        textured,
        mirrored: false,
        textures: None,
        material: None,
        facing: None,
    };
    if let Pipelines::One(pipeline) = pipelines {
        frame.bind(r, vk::PipelineBindPoint::GRAPHICS, pipeline, state.view);
    }
    // Views drawn at once take a draw for each way that faces turn, and leave out what is not of it.
    for mirrored in [false, true].into_iter().filter(|&way| frame.any_mirrored(eyes, way)) {
        state.mirrored = mirrored;
        if eyes == Eyes::All {
            frame.push_step(r, u32::from(mirrored));
        }
        draw_all(r, frame, eyes, (kind, &mut state));
    }
}

fn draw_all(r: &Recorder, frame: &Frame, eyes: Eyes, (kind, state): (SurfaceKind, &mut SurfaceState)) {
    let (list, views) = (frame.list_of(eyes), frame.view_count(eyes));
    match &frame.draws {
        Draws::Listed(lists) => {
            for run in lists[list].runs(kind) {
                state.set(r, frame, run.batch);
                draw_run(r, frame, run, views);
            }
        }
        Draws::Indirect { slots, orders, buffers } => {
            let part = list * slots.slots.len();
            for group in orders[list].groups(slots, kind) {
                state.set(r, frame, group.batch);
                draw_commands(r, &buffers.commands, part as u64 + u64::from(group.first), group.count);
            }
        }
    }
}

/// Draws every instance of a run once for each view.
fn draw_run(r: &Recorder, frame: &Frame, run: &DrawRun, views: u32) {
    let batch = &frame.scene.batches[run.batch as usize];
    unsafe {
        r.context.device.cmd_draw_indexed(
            r.commands(),
            batch.index_count,
            views * run.instance_count,
            batch.first_index,
            batch.vertex_offset,
            views * run.first_instance,
        );
    }
}

/// Draws consecutive commands, in as many calls as the device's limit asks for.
fn draw_commands(r: &Recorder, commands: &Buffer, first: u64, count: u32) {
    const STRIDE: u32 = size_of::<DrawCommand>() as u32;
    let most = r.context.limits.max_draw_indirect_count;
    for done in (0..count).step_by(most as usize) {
        let offset = (first + u64::from(done)) * u64::from(STRIDE);
        let now = most.min(count - done);
        unsafe {
            r.context.device.cmd_draw_indexed_indirect(r.commands(), commands.handle, offset, now, STRIDE);
        }
    }
}

/// The pipeline and textures bound and the facing set, so that none is set twice.
struct SurfaceState<'a> {
    pipelines: Pipelines<'a>,
    view: usize,
    textured: bool,
    /// Whether what is drawn is seen in a mirror.
    mirrored: bool,
    textures: Option<TextureSet>,
    material: Option<u32>,
    facing: Option<(bool, bool)>,
}

impl SurfaceState<'_> {
    fn set(&mut self, r: &Recorder, frame: &Frame, batch: u32) {
        let batch = &frame.scene.batches[batch as usize];
        if let Pipelines::ByTextures(pipelines) = self.pipelines {
            let textures = frame.scene.texture_sets[batch.material as usize];
            if self.textures.replace(textures) != Some(textures) {
                frame.bind(r, vk::PipelineBindPoint::GRAPHICS, &pipelines[&textures], self.view);
            }
        }
        if self.textured && self.material.replace(batch.material) != Some(batch.material) {
            let textures = frame.scene.material_sets[batch.material as usize];
            frame.bind_set(r, vk::PipelineBindPoint::GRAPHICS, SET_MATERIAL, textures);
        }
        let facing = (batch.mirrored != self.mirrored, batch.double_sided);
        if self.facing.replace(facing) != Some(facing) {
            set_facing(r, facing.0, facing.1);
        }
    }
}

/// Sets which faces are front, the other ones where what is drawn is `mirrored`, and whether the others are left out.
pub fn set_facing(r: &Recorder, mirrored: bool, double_sided: bool) {
    let cull = if double_sided { vk::CullModeFlags::NONE } else { vk::CullModeFlags::BACK };
    let front = if mirrored { vk::FrontFace::CLOCKWISE } else { vk::FrontFace::COUNTER_CLOCKWISE };
    unsafe {
        r.context.device.cmd_set_cull_mode(r.commands(), cull);
        r.context.device.cmd_set_front_face(r.commands(), front);
    }
}

impl Frame<'_> {
    /// Whether a pass draws surfaces of a kind; where the device culls, whether there are any.
    pub fn draws_any(&self, eyes: Eyes, kind: SurfaceKind) -> bool {
        let list = self.list_of(eyes);
        match &self.draws {
            Draws::Listed(lists) => !lists[list].runs(kind).is_empty(),
            Draws::Indirect { slots, orders, .. } => !orders[list].groups(slots, kind).is_empty(),
        }
    }

    /// Binds a pipeline with the buffers and the number of `view`.
    pub fn bind(&self, r: &Recorder, point: vk::PipelineBindPoint, pipeline: &Pipeline, view: usize) {
        let clustering = self.clustering_of_view(view);
        self.bind_clustering(r, point, pipeline, clustering);
        self.push_view(r, view);
    }

    /// Tells shaders the number of the view.
    pub fn push_view(&self, r: &Recorder, view: usize) {
        self.push(r, 0, view as u32);
    }

    /// Pushes the number of the step, for pipelines that run several times in a stage.
    pub fn push_step(&self, r: &Recorder, step: u32) {
        self.push(r, 4, step);
    }

    fn push(&self, r: &Recorder, offset: u32, value: u32) {
        let (layout, stages) = (self.layouts.pipeline, vk::ShaderStageFlags::ALL);
        let bytes = value.to_ne_bytes();
        unsafe { r.context.device.cmd_push_constants(r.commands(), layout, stages, offset, &bytes) };
    }

    /// Binds a pipeline with the buffers of clustering `clustering`.
    pub fn bind_clustering(
        &self,
        r: &Recorder,
        point: vk::PipelineBindPoint,
        pipeline: &Pipeline,
        clustering: usize,
    ) {
        unsafe { r.context.device.cmd_bind_pipeline(r.commands(), point, pipeline.handle) };
        self.bind_set(r, point, SET_BUFFERS, self.clusterings[clustering].sets[self.slot]);
    }

    /// Binds one descriptor set.
    pub fn bind_set(&self, r: &Recorder, point: vk::PipelineBindPoint, index: u32, set: vk::DescriptorSet) {
        unsafe {
            r.context.device.cmd_bind_descriptor_sets(
                r.commands(),
                point,
                self.layouts.pipeline,
                index,
                &[set],
                &[],
            );
        }
    }
}
