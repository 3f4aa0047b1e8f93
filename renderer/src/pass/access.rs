//! What a pass reads and writes, and the barriers that follow from it.

use ash::vk;

/// How a pass uses a resource.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// Buffer read by a compute shader.
    ComputeRead,
    /// Storage buffer written (and perhaps read) by a compute shader.
    ComputeWrite,
    /// Depth image sampled by a compute shader.
    ComputeSample,
    /// Buffer read by a vertex shader.
    VertexRead,
    /// Buffer read by a fragment shader.
    FragmentRead,
    /// Colour image sampled by a fragment shader.
    FragmentSample,
    /// Depth image sampled by a fragment shader, which may be tested as well.
    FragmentSampleDepth,
    /// Storage buffer written (and perhaps read) by a fragment shader.
    FragmentWrite,
    /// Dispatch sizes or draw commands read by the device.
    Indirect,
    /// Source of a copy or resolve.
    TransferRead,
    /// Destination of a copy, fill or resolve.
    TransferWrite,
    /// Written as a colour attachment.
    Color,
    /// Depth attachment, tested and written.
    Depth,
    /// Depth attachment, tested only.
    DepthTest,
    /// Mapped memory read by the host once the frame has ended.
    HostRead,
}

/// A buffer read by a shader as what it is bound as: storage, texels or uniform.
const READ: vk::AccessFlags2 = vk::AccessFlags2::from_raw(
    vk::AccessFlags2::SHADER_STORAGE_READ.as_raw()
        | vk::AccessFlags2::SHADER_SAMPLED_READ.as_raw()
        | vk::AccessFlags2::UNIFORM_READ.as_raw(),
);

impl Use {
    fn stage(self) -> vk::PipelineStageFlags2 {
        use vk::PipelineStageFlags2 as S;
        match self {
            Self::ComputeRead | Self::ComputeWrite | Self::ComputeSample => S::COMPUTE_SHADER,
            Self::VertexRead => S::VERTEX_SHADER,
            Self::FragmentRead | Self::FragmentWrite | Self::FragmentSample | Self::FragmentSampleDepth => {
                S::FRAGMENT_SHADER
            }
            Self::Indirect => S::DRAW_INDIRECT,
            Self::TransferRead | Self::TransferWrite => S::ALL_TRANSFER,
            Self::Color => S::COLOR_ATTACHMENT_OUTPUT,
            Self::Depth | Self::DepthTest => S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS,
            Self::HostRead => S::HOST,
        }
    }

    fn access(self) -> vk::AccessFlags2 {
        use vk::AccessFlags2 as A;
        match self {
            Self::ComputeRead | Self::VertexRead | Self::FragmentRead => READ,
            Self::ComputeWrite | Self::FragmentWrite => READ | A::SHADER_STORAGE_WRITE,
            Self::ComputeSample | Self::FragmentSample | Self::FragmentSampleDepth => A::SHADER_SAMPLED_READ,
            Self::Indirect => A::INDIRECT_COMMAND_READ,
            Self::TransferRead => A::TRANSFER_READ,
            Self::TransferWrite => A::TRANSFER_WRITE,
            Self::Color => A::COLOR_ATTACHMENT_READ | A::COLOR_ATTACHMENT_WRITE,
            Self::Depth => A::DEPTH_STENCIL_ATTACHMENT_READ | A::DEPTH_STENCIL_ATTACHMENT_WRITE,
            Self::DepthTest => A::DEPTH_STENCIL_ATTACHMENT_READ,
            Self::HostRead => A::HOST_READ,
        }
    }

    fn writes(self) -> bool {
        matches!(
            self,
            Self::ComputeWrite | Self::FragmentWrite | Self::TransferWrite | Self::Color | Self::Depth
        )
    }

    /// The layout an image must have; buffers have none.
    fn layout(self) -> vk::ImageLayout {
        match self {
            Self::Color => vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
            Self::Depth => vk::ImageLayout::DEPTH_ATTACHMENT_OPTIMAL,
            Self::DepthTest | Self::ComputeSample | Self::FragmentSampleDepth => {
                vk::ImageLayout::DEPTH_READ_ONLY_OPTIMAL
            }
            Self::FragmentSample => vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
            Self::TransferRead => vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            Self::TransferWrite => vk::ImageLayout::TRANSFER_DST_OPTIMAL,
            _ => vk::ImageLayout::UNDEFINED,
        }
    }
}

/// One resource with the use that is made of it.
#[derive(Debug, Clone, Copy)]
pub struct Access {
    resource: Resource,
    usage: Use,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Resource {
    Buffer(vk::Buffer),
    Image(vk::Image, vk::ImageAspectFlags),
}

impl Access {
    /// Use of a whole buffer.
    pub fn buffer(buffer: vk::Buffer, usage: Use) -> Self {
        Self { resource: Resource::Buffer(buffer), usage }
    }

    /// A whole image with one mip level, all its layers.
    pub fn image(image: vk::Image, aspect: vk::ImageAspectFlags, usage: Use) -> Self {
        Self { resource: Resource::Image(image, aspect), usage }
    }
}

/// What has happened to a resource since the frame began.
#[derive(Debug, Clone, Copy)]
struct History {
    resource: Resource,
    layout: vk::ImageLayout,
    /// The last write, which later accesses must wait for.
    write_stage: vk::PipelineStageFlags2,
    write_access: vk::AccessFlags2,
    /// Where that write has been made visible.
    visible_stages: vk::PipelineStageFlags2,
    visible_access: vk::AccessFlags2,
    /// Readers since that write, which the next write must wait for.
    read_stages: vk::PipelineStageFlags2,
}

impl History {
    /// Starts anew with a write, or with the change of layout that a read asks for, which is a write that its own
    /// barrier has made visible to that read.
    fn overwrite(&mut self, usage: Use) {
        use vk::{AccessFlags2 as A, PipelineStageFlags2 as S};
        self.write_stage = usage.stage();
        self.read_stages = S::NONE;
        self.layout = usage.layout();
        (self.write_access, self.visible_stages, self.visible_access) = if usage.writes() {
            (usage.access(), S::NONE, A::NONE)
        } else {
            (A::NONE, usage.stage(), usage.access())
        };
    }
}

/// Derives the barriers of one frame. Keeps its memory from frame to frame.
#[derive(Debug, Default)]
pub(super) struct Tracker {
    histories: Vec<History>,
    buffer_barriers: Vec<vk::BufferMemoryBarrier2<'static>>,
    image_barriers: Vec<vk::ImageMemoryBarrier2<'static>>,
}

impl Tracker {
    /// Forgets everything: a full barrier covers all earlier work, and images start undefined.
    pub(super) fn begin_frame(&mut self) {
        self.histories.clear();
    }

    /// Records the barriers that `accesses` need after all that was recorded before.
    pub(super) fn synchronise(
        &mut self,
        device: &ash::Device,
        commands: vk::CommandBuffer,
        accesses: impl IntoIterator<Item = Access>,
    ) {
        self.buffer_barriers.clear();
        self.image_barriers.clear();
        for access in accesses {
            self.add(&access);
        }
        if self.buffer_barriers.is_empty() && self.image_barriers.is_empty() {
            return;
        }
        let dependency = vk::DependencyInfo::default()
            .buffer_memory_barriers(&self.buffer_barriers)
            .image_memory_barriers(&self.image_barriers);
        unsafe { device.cmd_pipeline_barrier2(commands, &dependency) };
    }

    fn add(&mut self, access: &Access) {
        let usage = access.usage;
        let (stage, mask) = (usage.stage(), usage.access());
        let history = self.history(access.resource);
        let relayout = matches!(access.resource, Resource::Image(..)) && history.layout != usage.layout();
        let old_layout = history.layout;
        let (src_stage, src_access) = if usage.writes() || relayout {
            let src = (history.write_stage | history.read_stages, history.write_access);
            history.overwrite(usage);
            src
        } else {
            let seen = history.visible_stages.contains(stage) && history.visible_access.contains(mask);
            history.read_stages |= stage;
            if seen || history.write_stage.is_empty() {
                return;
            }
            history.visible_stages |= stage;
            history.visible_access |= mask;
            (history.write_stage, history.write_access)
        };
        if src_stage.is_empty() {
            return;
        }
        match access.resource {
            Resource::Buffer(buffer) => self.buffer_barriers.push(
                vk::BufferMemoryBarrier2::default()
                    .src_stage_mask(src_stage)
                    .src_access_mask(src_access)
                    .dst_stage_mask(stage)
                    .dst_access_mask(mask)
                    .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .buffer(buffer)
                    .size(vk::WHOLE_SIZE),
            ),
            Resource::Image(image, aspect) => self.image_barriers.push(
                vk::ImageMemoryBarrier2::default()
                    .src_stage_mask(src_stage)
                    .src_access_mask(src_access)
                    .dst_stage_mask(stage)
                    .dst_access_mask(mask)
                    .old_layout(old_layout)
                    .new_layout(usage.layout())
                    .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                    .image(image)
                    .subresource_range(
                        vk::ImageSubresourceRange::default()
                            .aspect_mask(aspect)
                            .level_count(1)
                            .layer_count(vk::REMAINING_ARRAY_LAYERS),
                    ),
            ),
        }
    }

    fn history(&mut self, resource: Resource) -> &mut History {
        // An image's first change of layout must wait for the frame before, whose work the full barrier has ended:
        // a barrier that waits for no stage would not be ordered after that one.
        let read_stages = match resource {
            Resource::Buffer(_) => vk::PipelineStageFlags2::NONE,
            Resource::Image(..) => vk::PipelineStageFlags2::ALL_COMMANDS,
        };
        let found = self.histories.iter().position(|history| history.resource == resource);
        let index = found.unwrap_or_else(|| {
            self.histories.push(History {
                resource,
                layout: vk::ImageLayout::UNDEFINED,
                write_stage: vk::PipelineStageFlags2::NONE,
                write_access: vk::AccessFlags2::NONE,
                visible_stages: vk::PipelineStageFlags2::NONE,
                visible_access: vk::AccessFlags2::NONE,
                read_stages,
            });
            self.histories.len() - 1
        });
        &mut self.histories[index]
    }
}
