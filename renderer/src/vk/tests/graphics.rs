//! Graphics pipelines.

use super::*;

const TRIANGLE: &str = "#version 460
layout(location = 0) in vec2 position;
void main() { gl_Position = vec4(position, 0.5, 1.0); }
";
const WHITE: &str = "#version 460
layout(location = 0) out vec4 color;
void main() { color = vec4(1.0, 1.0, 1.0, 0.5) * (gl_SampleID >= 0 ? 1.0 : 0.0); }
";
const TWO_TARGETS: &str = "#version 460
layout(location = 0) out vec4 color;
layout(location = 1) out uint number;
void main() { color = vec4(1.0, 0.0, 1.0, 1.0); number = 0x01020304u; }
";
const SIDE: u32 = 8;

/// Draws a white triangle over the lower left half of the frame (+Y up), counter-clockwise as given here.
fn draw(context: &Arc<Context>, desc: GraphicsDesc<'_>, corners: [[f32; 2]; 3]) -> Vec<[u8; 4]> {
    let desc = GraphicsDesc { color_formats: &[vk::Format::R8G8B8A8_UNORM], ..desc };
    draw_into(context, desc, WHITE, corners).remove(0)
}

/// Draws a triangle into an image of each of `desc`'s formats, whose texels have four bytes.
fn draw_into(
    context: &Arc<Context>,
    desc: GraphicsDesc<'_>,
    fragment: &str,
    corners: [[f32; 2]; 3],
) -> Vec<Vec<[u8; 4]>> {
    let library = shaders(&[("a.vert", TRIANGLE), ("a.frag", fragment)]);
    let vertex = library.compile("a.vert", &[]).unwrap();
    let fragment = library.compile("a.frag", &[]).unwrap();
    let bindings = [vk::VertexInputBindingDescription { stride: 8, ..Default::default() }];
    let attributes =
        [vk::VertexInputAttributeDescription { format: vk::Format::R32G32_SFLOAT, ..Default::default() }];
    let (vertex, fragment) = (vertex.as_slice(), Some(fragment.as_slice()));
    let desc = GraphicsDesc { vertex, fragment, bindings: &bindings, attributes: &attributes, ..desc };
    let set = Bindings::new(context, &[]);
    let pipeline = graphics_pipeline(context, set.layout, &desc, "triangle").unwrap();
    let vertices =
        Buffer::with_data(context, "corners", vk::BufferUsageFlags::VERTEX_BUFFER, &corners).unwrap();
    let targets: Vec<_> =
        desc.color_formats.iter().map(|&format| Target::new(context, format, desc.samples)).collect();
    context
        .submit_and_wait(|cmd| unsafe {
            let device = &context.device;
            let attachments: Vec<_> = targets.iter().map(|target| target.attach(context, cmd)).collect();
            let extent = vk::Extent2D { width: SIDE, height: SIDE };
            let area = vk::Rect2D { extent, ..Default::default() };
            let rendering =
                vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&attachments);
            device.cmd_begin_rendering(cmd, &rendering);
            device.cmd_bind_pipeline(cmd, vk::PipelineBindPoint::GRAPHICS, pipeline.handle);
            let side = SIDE as f32;
            let (y, height, max_depth) = (side, -side, 1.0);
            let flipped = vk::Viewport { y, width: side, height, max_depth, ..Default::default() };
            device.cmd_set_viewport(cmd, 0, &[flipped]);
            device.cmd_set_scissor(cmd, 0, &[area]);
            if desc.dynamic_facing {
                device.cmd_set_cull_mode(cmd, vk::CullModeFlags::BACK);
                device.cmd_set_front_face(cmd, vk::FrontFace::CLOCKWISE);
            }
            device.cmd_bind_vertex_buffers(cmd, 0, &[vertices.handle], &[0]);
            device.cmd_draw(cmd, 3, 1, 0, 0);
            device.cmd_end_rendering(cmd);
            targets.iter().for_each(|target| target.copy_out(context, cmd));
            to_host(context, cmd);
        })
        .unwrap();
    targets.iter().map(|target| target.pixels.read(0, (SIDE * SIDE) as usize)).collect()
}

const ATTACHMENT: vk::ImageLayout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;

/// An image that is drawn into, what it is resolved to where it has several samples, and where the host reads it.
struct Target {
    drawn: Image,
    resolved: Option<Image>,
    pixels: Buffer,
}

impl Target {
    fn new(context: &Arc<Context>, format: vk::Format, samples: vk::SampleCountFlags) -> Self {
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
        let desc = ImageDesc { width: SIDE, height: SIDE, format, usage, ..Default::default() };
        let image = |name, samples| Image::new(context, name, ImageDesc { samples, ..desc }).unwrap();
        let one = vk::SampleCountFlags::TYPE_1;
        let (size, transfer) = (u64::from(SIDE * SIDE * 4), vk::BufferUsageFlags::TRANSFER_DST);
        Self {
            drawn: image("drawn", samples),
            resolved: (samples != one).then(|| image("resolved", one)),
            pixels: Buffer::new(context, "pixels", size, transfer, Memory::Readback).unwrap(),
        }
    }

    fn attach(&self, context: &Context, cmd: vk::CommandBuffer) -> vk::RenderingAttachmentInfo<'static> {
        for image in [&self.drawn].into_iter().chain(&self.resolved) {
            change(context, cmd, image, vk::ImageLayout::UNDEFINED, ATTACHMENT);
        }
        let attachment = vk::RenderingAttachmentInfo::default()
            .image_view(self.drawn.view)
            .image_layout(ATTACHMENT)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE);
        match &self.resolved {
            Some(resolved) => attachment
                .resolve_mode(vk::ResolveModeFlags::AVERAGE)
                .resolve_image_view(resolved.view)
                .resolve_image_layout(ATTACHMENT),
            None => attachment,
        }
    }

    fn copy_out(&self, context: &Context, cmd: vk::CommandBuffer) {
        let (source, readable) =
            (vk::ImageLayout::TRANSFER_SRC_OPTIMAL, self.resolved.as_ref().unwrap_or(&self.drawn));
        change(context, cmd, readable, ATTACHMENT, source);
        let region = vk::BufferImageCopy::default()
            .image_subresource(vk::ImageSubresourceLayers {
                aspect_mask: vk::ImageAspectFlags::COLOR,
                layer_count: 1,
                ..Default::default()
            })
            .image_extent(vk::Extent3D { width: SIDE, height: SIDE, depth: 1 });
        let (image, to) = (readable.handle, self.pixels.handle);
        unsafe { context.device.cmd_copy_image_to_buffer(cmd, image, source, to, &[region]) };
    }
}

fn change(
    context: &Context,
    cmd: vk::CommandBuffer,
    image: &Image,
    old: vk::ImageLayout,
    new: vk::ImageLayout,
) {
    texture::Layouts { old, new }.change(context, cmd, std::slice::from_ref(image));
}

/// Whether a pixel is what is expected, to a step of 1/255: devices round 127.5 to either side.
fn nearly(pixel: [u8; 4], expected: [u8; 4]) -> bool {
    pixel.iter().zip(expected).all(|(&got, expected)| got.abs_diff(expected) <= 1)
}

const LOWER_LEFT: [[f32; 2]; 3] = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]];

fn reversed(mut corners: [[f32; 2]; 3]) -> [[f32; 2]; 3] {
    corners.reverse();
    corners
}

#[test]
fn counter_clockwise_is_front_and_up_is_up() {
    silently(|context| {
        let pixels = draw(context, GraphicsDesc::default(), LOWER_LEFT);
        let at = |x: u32, y: u32| pixels[(y * SIDE + x) as usize];
        assert!(nearly(at(0, SIDE - 1), [255, 255, 255, 128]), "lower left");
        assert_eq!(at(SIDE - 1, 0), [0; 4], "upper right");
        let background = vec![[0; 4]; pixels.len()];
        assert_eq!(draw(context, GraphicsDesc::default(), reversed(LOWER_LEFT)), background);
        let mirrored = GraphicsDesc { dynamic_facing: true, ..Default::default() };
        assert_eq!(draw(context, mirrored, reversed(LOWER_LEFT)), pixels);
        let both = GraphicsDesc { cull_mode: vk::CullModeFlags::NONE, ..Default::default() };
        assert_eq!(draw(context, both, reversed(LOWER_LEFT)), pixels);
    });
}

#[test]
fn one_pass_draws_into_two_targets_of_unlike_formats() {
    silently(|context| {
        let formats = [vk::Format::R8G8B8A8_UNORM, vk::Format::R32_UINT];
        let desc = GraphicsDesc { color_formats: &formats, ..Default::default() };
        let drawn = draw_into(context, desc, TWO_TARGETS, LOWER_LEFT);
        let corners = [(SIDE - 1) * SIDE, SIDE - 1].map(|at| [0, 1].map(|target| drawn[target][at as usize]));
        assert_eq!(corners[0], [[255, 0, 255, 255], 0x01020304u32.to_le_bytes()], "lower left");
        assert_eq!(corners[1], [[0; 4]; 2], "upper right");
    });
}

#[test]
fn blending_is_by_alpha_over_what_is_there_or_adds_to_it() {
    silently(|context| {
        let pixels = draw(context, GraphicsDesc { blend: Blend::Over, ..Default::default() }, LOWER_LEFT);
        let blended = pixels[((SIDE - 1) * SIDE) as usize];
        assert!(nearly(blended, [128, 128, 128, 128]), "{blended:?}");
        let pixels = draw(context, GraphicsDesc { blend: Blend::Add, ..Default::default() }, LOWER_LEFT);
        let added = pixels[((SIDE - 1) * SIDE) as usize];
        assert_eq!(added, [255, 255, 255, 0], "colour is added as it is, and alpha remains");
    });
}

#[test]
fn four_samples_shaded_each_smooth_the_edge() {
    silently(|context| {
        assert!(context.limits.sample_counts.contains(&4), "required of every device");
        let sample_shading = context.limits.sample_rate_shading;
        let desc =
            GraphicsDesc { samples: vk::SampleCountFlags::TYPE_4, sample_shading, ..Default::default() };
        let pixels = draw(context, desc, LOWER_LEFT);
        let edge = pixels.iter().filter(|p| p[0] != 0 && p[0] != 255).count();
        assert!(edge >= SIDE as usize / 2, "{pixels:?}");
    });
}
