//! Drawing the scene, a call a pass: what is attached, what is drawn with which pipelines, what their shaders touch.

use super::inputs::{Draws, Eyes, Frame, ImageLayer};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::draw_list::{DrawRun, SurfaceKind};
use crate::gpu_interface::{DrawCommand, SET_MATERIAL, SET_TARGETS};
use crate::layouts::{BoundBuffers, Pipeline};
use crate::pass::{Access, Declared, Push, Recorder, Use};
use crate::targets::{TARGET_COUNT, TargetName};
use crate::texture_sets::TextureSet;
use crate::vk::Buffer;
use ash::vk;
use std::collections::BTreeMap;
use std::sync::Arc;

/// How a pass uses the depth of its views.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DepthUse {
    /// Cleared to far, tested and written.
    Write,
    /// What is there is kept, tested and written.
    Keep,
    /// Depth is tested and not written.
    Test,
}

/// How a pass uses a colour target of its views.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ColorUse {
    /// Cleared to red, green, blue and alpha; the format of the target is one of floats.
    Clear([f32; 4]),
    /// What is there is kept and drawn over.
    Keep,
    /// What is there is of no use: nothing is read but what is drawn.
    Fresh,
}

/// What draws surfaces of a kind.
#[derive(Clone, Copy)]
pub enum SurfacePipelines<'a> {
    /// One pipeline for all materials.
    One(&'a Pipeline),
    /// A pipeline for each set of textures that materials have.
    ByTextures(&'a BTreeMap<TextureSet, Arc<Pipeline>>),
}

impl<'a> SurfacePipelines<'a> {
    /// All pipelines that may draw.
    fn all(self) -> impl Iterator<Item = &'a Pipeline> + Clone {
        let (one, by_textures) = match self {
            Self::One(pipeline) => (Some(pipeline), None),
            Self::ByTextures(pipelines) => (None, Some(pipelines)),
        };
        one.into_iter()
            .chain(by_textures.into_iter().flat_map(|all| all.values().map(|pipeline| &**pipeline)))
    }

    /// The pipeline for materials with these textures.
    fn of(self, textures: TextureSet) -> &'a Pipeline {
        match self {
            Self::One(pipeline) => pipeline,
            Self::ByTextures(pipelines) => &pipelines[&textures],
        }
    }
}

/// A pass that draws surfaces of the scene.
#[derive(Clone, Copy)]
pub struct SurfacePass<'a> {
    /// The views that the pass draws.
    pub eyes: Eyes,
    /// The colour targets that it draws into, in the order of the shaders' locations, and what becomes of each.
    pub colors: &'a [(TargetName, ColorUse)],
    /// What becomes of their depth.
    pub depth: DepthUse,
    /// What is drawn, in order.
    pub draws: &'a [(SurfaceKind, SurfacePipelines<'a>)],
    /// Buffers that are read alone, not counting those of the scene that draws read.
    pub reads: BufferSet,
    /// Buffers that are written, and perhaps read.
    pub writes: BufferSet,
}

/// Draws surfaces of the scene.
pub fn surfaces(r: &mut Recorder, frame: &Frame, pass: &SurfacePass) {
    let drawn = pass.draws.iter().any(|&(kind, _)| frame.draws_any(pass.eyes, kind));
    if !drawn && pass.colors.is_empty() && pass.depth == DepthUse::Test {
        return;
    }
    let attached = Attached { eyes: pass.eyes, colors: pass.colors, depth: pass.depth };
    let buffers = frame.buffers_of_view(pass.eyes.first());
    let (mut reads, mut commands) = (pass.reads, None);
    if let Draws::Indirect { buffers, .. } = &frame.draws {
        reads = reads | set(&[B::DrawnInstances]);
        commands = Some(Access::buffer(buffers.commands.handle, Use::Indirect));
    }
    let pipelines = pass.draws.iter().flat_map(|draw| draw.1.all());
    attached.check(r, pipelines.clone());
    let declared = Declared { reads, writes: pass.writes };
    r.prepare(pipelines, &buffers, declared, attached.accesses(frame).map(Some).chain([commands]));
    begin_rendering(r, frame, &attached);
    for &(kind, pipelines) in pass.draws {
        draw(r, frame, pass.eyes, (kind, pipelines));
    }
    unsafe { r.context.device.cmd_end_rendering(r.commands()) };
}

/// Draws surfaces of a view against the depth that it has, for what their fragments put into buffers.
pub fn visits(
    r: &mut Recorder,
    frame: &Frame,
    view: usize,
    draws: &[(SurfaceKind, SurfacePipelines)],
    (reads, writes): (BufferSet, BufferSet),
) {
    let pass =
        SurfacePass { eyes: Eyes::One(view), colors: &[], depth: DepthUse::Test, draws, reads, writes };
    surfaces(r, frame, &pass);
}

/// Instances of a shape that a vertex shader makes, drawn over a picture.
#[derive(Clone, Copy)]
pub struct Overlay<'a> {
    /// Pipeline that draws the overlay.
    pub pipeline: &'a Pipeline,
    /// Vertices of an instance.
    pub vertices: u32,
    /// Number of instances.
    pub count: u32,
    /// Data of each instance, where the shader reads any.
    pub instances: Option<&'a Buffer>,
    /// Whether the shape is closed, so that the faces away from the camera are left out.
    pub closed: bool,
    /// Buffers that are read.
    pub reads: BufferSet,
}

/// Draws over a view's cleared radiance, behind what its depth shows.
pub fn overlays(r: &mut Recorder, frame: &Frame, view: usize, overlays: &[Overlay]) {
    let colors = &[(TargetName::Radiance, ColorUse::Clear([0.0; 4]))];
    let attached = Attached { eyes: Eyes::One(view), colors, depth: DepthUse::Test };
    attached.check(r, overlays.iter().map(|overlay| overlay.pipeline));
    let buffers = frame.buffers_of_view(view);
    for overlay in overlays {
        let declared = Declared { reads: overlay.reads, writes: BufferSet::EMPTY };
        r.prepare([overlay.pipeline], &buffers, declared, []);
    }
    r.access(attached.accesses(frame));
    begin_rendering(r, frame, &attached);
    for overlay in overlays {
        r.bind(vk::PipelineBindPoint::GRAPHICS, overlay.pipeline, &buffers, Push::view(view));
        let (device, commands) = (&r.context.device, r.commands());
        if let Some(instances) = overlay.instances {
            unsafe { device.cmd_bind_vertex_buffers(commands, 0, &[instances.handle], &[0]) };
        }
        if overlay.closed {
            set_facing(r, frame.mirrored[view], false);
        }
        unsafe { device.cmd_draw(commands, overlay.vertices, overlay.count, 0, 0) };
    }
    unsafe { r.context.device.cmd_end_rendering(r.commands()) };
}

/// A pass over all pixels of a view that show a surface.
#[derive(Clone, Copy)]
pub struct ScreenPass<'a> {
    /// Pipeline that draws, which tests depth.
    pub pipeline: &'a Pipeline,
    /// What becomes of the radiance that is drawn over.
    pub radiance: ColorUse,
    /// Which of several things the shader draws; 0 where there is one.
    pub step: u32,
    /// Colour targets of the view that are sampled, beside its depth.
    pub sampled: &'a [TargetName],
    /// Buffers that are read alone.
    pub reads: BufferSet,
    /// Buffers that are written, and perhaps read.
    pub writes: BufferSet,
}

/// Draws over a view's radiance, by what other targets of it hold.
pub fn screen(r: &mut Recorder, frame: &Frame, view: usize, pass: &ScreenPass) {
    let colors = &[(TargetName::Radiance, pass.radiance)];
    let attached = Attached { eyes: Eyes::One(view), colors, depth: DepthUse::Test };
    attached.check(r, [pass.pipeline]);
    let (targets, buffers) = (&frame.targets[view], frame.buffers_of_view(view));
    let sampled = |&name: &TargetName| {
        let image = targets[name].drawn.image.handle;
        Access::image(image, vk::ImageAspectFlags::COLOR, Use::FragmentSample)
    };
    let depth =
        Access::image(targets.depth.image.handle, vk::ImageAspectFlags::DEPTH, Use::FragmentSampleDepth);
    // Depth is sampled and tested: of an image's two uses the second waits for the first, whose barrier is another.
    r.access(pass.sampled.iter().map(sampled).chain([depth]));
    let declared = Declared { reads: pass.reads, writes: pass.writes };
    r.prepare([pass.pipeline], &buffers, declared, attached.accesses(frame).map(Some));
    begin_rendering(r, frame, &attached);
    let push = Push { step: pass.step, ..Push::view(view) };
    r.bind(vk::PipelineBindPoint::GRAPHICS, pass.pipeline, &buffers, push);
    r.bind_set(vk::PipelineBindPoint::GRAPHICS, pass.pipeline, SET_TARGETS, targets.set);
    let (device, commands) = (&r.context.device, r.commands());
    unsafe {
        device.cmd_draw(commands, 3, 1, 0, 0);
        device.cmd_end_rendering(commands);
    }
}

/// What a pass draws into.
struct Attached<'a> {
    eyes: Eyes,
    colors: &'a [(TargetName, ColorUse)],
    depth: DepthUse,
}

impl Attached<'_> {
    /// # Panics
    /// Where builds or devices check and a pipeline draws into other targets: a fault of the program.
    fn check<'p>(&self, r: &Recorder, pipelines: impl IntoIterator<Item = &'p Pipeline>) {
        if !r.checks() {
            return;
        }
        for pipeline in pipelines {
            let attached: Vec<_> = self.colors.iter().map(|color| color.0).collect();
            let (name, drawn) = (&pipeline.name, pipeline.targets);
            assert!(drawn == attached, "{name}: draws into {drawn:?}, its pass into {attached:?}");
        }
    }

    /// What it does with the images.
    fn accesses(&self, frame: &Frame) -> impl Iterator<Item = Access> {
        let targets = &frame.targets[self.eyes.first()];
        let color = move |&(name, _): &(TargetName, ColorUse)| {
            Access::image(targets[name].drawn.image.handle, vk::ImageAspectFlags::COLOR, Use::Color)
        };
        let usage = if self.depth == DepthUse::Test { Use::DepthTest } else { Use::Depth };
        let depth = Access::image(targets.depth.image.handle, vk::ImageAspectFlags::DEPTH, usage);
        self.colors.iter().map(color).chain([depth])
    }

    /// The attachment of a view's image: its layer, or all layers for all views.
    fn attachment(&self, layer: &ImageLayer) -> vk::RenderingAttachmentInfo<'static> {
        vk::RenderingAttachmentInfo::default().image_view(match self.eyes {
            Eyes::One(_) => layer.view,
            Eyes::All => layer.image.view,
        })
    }

    /// The attachments of colour, of which the first are in use: as many as the pass names.
    fn colors(&self, frame: &Frame) -> [vk::RenderingAttachmentInfo<'static>; TARGET_COUNT] {
        let mut attachments = [vk::RenderingAttachmentInfo::default(); TARGET_COUNT];
        for (attachment, &color) in attachments.iter_mut().zip(self.colors) {
            *attachment = self.color(frame, color);
        }
        attachments
    }

    fn color(
        &self,
        frame: &Frame,
        (name, usage): (TargetName, ColorUse),
    ) -> vk::RenderingAttachmentInfo<'static> {
        let (load, float32) = match usage {
            ColorUse::Clear(color) => (vk::AttachmentLoadOp::CLEAR, color),
            ColorUse::Keep => (vk::AttachmentLoadOp::LOAD, [0.0; 4]),
            ColorUse::Fresh => (vk::AttachmentLoadOp::DONT_CARE, [0.0; 4]),
        };
        self.attachment(&frame.targets[self.eyes.first()][name].drawn)
            .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .load_op(load)
            .store_op(vk::AttachmentStoreOp::STORE)
            .clear_value(vk::ClearValue { color: vk::ClearColorValue { float32 } })
    }

    fn depth(&self, frame: &Frame) -> vk::RenderingAttachmentInfo<'static> {
        let (layout, load, store) = match self.depth {
            DepthUse::Write => (
                vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL,
                vk::AttachmentLoadOp::CLEAR,
                vk::AttachmentStoreOp::STORE,
            ),
            DepthUse::Keep => (
                vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL,
                vk::AttachmentLoadOp::LOAD,
                vk::AttachmentStoreOp::STORE,
            ),
            DepthUse::Test => (
                vk::ImageLayout::DEPTH_READ_ONLY_OPTIMAL,
                vk::AttachmentLoadOp::LOAD,
                vk::AttachmentStoreOp::NONE,
            ),
        };
        let far = vk::ClearDepthStencilValue { depth: 0.0, stencil: 0 };
        self.attachment(&frame.targets[self.eyes.first()].depth)
            .image_layout(layout)
            .load_op(load)
            .store_op(store)
            .clear_value(vk::ClearValue { depth_stencil: far })
    }
}

/// Opens dynamic rendering over whole views and sets the viewport (flipped, so that +Y stays up).
fn begin_rendering(r: &Recorder, frame: &Frame, attached: &Attached) {
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
    let (colors, depth) = (attached.colors(frame), attached.depth(frame));
    let info = vk::RenderingInfo::default()
        .render_area(area)
        .layer_count(frame.view_count(attached.eyes))
        .color_attachments(&colors[..attached.colors.len()])
        .depth_attachment(&depth);
    let device = &r.context.device;
    unsafe {
        device.cmd_begin_rendering(r.commands(), &info);
        device.cmd_set_viewport(r.commands(), 0, &[viewport]);
        device.cmd_set_scissor(r.commands(), 0, &[area]);
        device.cmd_bind_vertex_buffers(r.commands(), 0, &[frame.scene.vertices.handle], &[0]);
        device.cmd_bind_index_buffer(r.commands(), frame.scene.indices.handle, 0, vk::IndexType::UINT32);
    }
}

/// Draws one kind of surface; materials are bound where the pipelines read them.
fn draw(r: &Recorder, frame: &Frame, eyes: Eyes, (kind, pipelines): (SurfaceKind, SurfacePipelines)) {
    if !frame.draws_any(eyes, kind) {
        return;
    }
    let buffers = frame.buffers_of_view(eyes.first());
    // Views drawn at once take a draw for each way that faces turn, and leave out what is not of it.
    for mirrored in [false, true].into_iter().filter(|&way| frame.any_mirrored(eyes, way)) {
        let push = Push { mirrored: u32::from(eyes == Eyes::All && mirrored), ..Push::view(eyes.first()) };
        let mut state =
            SurfaceState { pipelines, buffers, push, mirrored, bound: None, material: None, facing: None };
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
        Draws::Indirect { drawables, orders, buffers } => {
            let part = list * drawables.all.len();
            for draw in orders[list].multi_draws(drawables, kind) {
                state.set(r, frame, draw.batch);
                draw_commands(r, &buffers.commands, part as u64 + u64::from(draw.first), draw.count);
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

/// The pipeline and material bound and the facing set, so that none is set twice.
struct SurfaceState<'a> {
    pipelines: SurfacePipelines<'a>,
    buffers: BoundBuffers<'a>,
    push: Push,
    /// Whether what is drawn is seen in a mirror.
    mirrored: bool,
    /// The number of the pipeline.
    bound: Option<usize>,
    material: Option<u32>,
    facing: Option<(bool, bool)>,
}

impl SurfaceState<'_> {
    fn set(&mut self, r: &Recorder, frame: &Frame, batch: u32) {
        let batch = &frame.scene.batches[batch as usize];
        let (point, material) = (vk::PipelineBindPoint::GRAPHICS, batch.material as usize);
        let pipeline = self.pipelines.of(frame.scene.texture_sets[material]);
        if self.bound.replace(pipeline.number) != Some(pipeline.number) {
            r.bind(point, pipeline, &self.buffers, self.push);
            // What was bound for another layout is not bound for this one.
            self.material = None;
        }
        if pipeline.uses().material && self.material.replace(batch.material) != Some(batch.material) {
            r.bind_set(point, pipeline, SET_MATERIAL, frame.scene.material_sets[material]);
        }
        let facing = (batch.mirrored != self.mirrored, batch.double_sided);
        if self.facing.replace(facing) != Some(facing) {
            set_facing(r, facing.0, facing.1);
        }
    }
}

/// Sets which faces are front, the other ones where what is drawn is `mirrored`, and whether the others are left out.
fn set_facing(r: &Recorder, mirrored: bool, double_sided: bool) {
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
            Draws::Indirect { drawables, orders, .. } => {
                !orders[list].multi_draws(drawables, kind).is_empty()
            }
        }
    }
}
