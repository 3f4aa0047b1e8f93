//! The layer on a real device (lavapipe where there is no other), with the validation layers on.

mod compute;
mod graphics;
mod light_geometry;

use super::*;
use crate::scene;
use std::sync::Arc;

/// Runs `test` on a device whose validation must stay silent until it is closed.
fn validated() -> DeviceOptions {
    DeviceOptions { validate: true, ..DeviceOptions::default() }
}

fn silently(test: impl FnOnce(&Arc<Context>)) {
    let context = Context::new(&validated()).unwrap();
    let log = context.validation_log();
    test(&context);
    drop(context);
    assert_eq!(log.messages(), Vec::<String>::new());
}

fn shaders(files: &[(&str, &str)]) -> ShaderLibrary {
    let own = |&(name, text): &(&str, &str)| (name.to_owned(), text.to_owned());
    ShaderLibrary::new(None, files.iter().map(own).collect()).unwrap().with_cache(None)
}

/// A descriptor set with its layouts, for one shader stage.
struct Bindings {
    context: Arc<Context>,
    pool: vk::DescriptorPool,
    set_layout: vk::DescriptorSetLayout,
    layout: vk::PipelineLayout,
    set: vk::DescriptorSet,
}

impl Bindings {
    fn new(context: &Arc<Context>, kinds: &[vk::DescriptorType]) -> Self {
        let device = &context.device;
        let binding = |(index, &kind): (usize, &vk::DescriptorType)| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(index as u32)
                .descriptor_type(kind)
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE)
        };
        let bindings: Vec<_> = kinds.iter().enumerate().map(binding).collect();
        let size = |&ty| vk::DescriptorPoolSize { ty, descriptor_count: 1 };
        let sizes: Vec<_> = kinds.iter().map(size).collect();
        let pool_info = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        unsafe {
            let set_info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let set_layout = device.create_descriptor_set_layout(&set_info, None).unwrap();
            let layouts = [set_layout];
            let layout_info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts);
            let layout = device.create_pipeline_layout(&layout_info, None).unwrap();
            let pool = device.create_descriptor_pool(&pool_info, None).unwrap();
            let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
            let set = device.allocate_descriptor_sets(&info).unwrap()[0];
            Self { context: context.clone(), pool, set_layout, layout, set }
        }
    }

    fn buffer(&self, binding: u32, buffer: &Buffer) {
        let info = [vk::DescriptorBufferInfo::default().buffer(buffer.handle).range(vk::WHOLE_SIZE)];
        self.write(binding, |write| {
            write.descriptor_type(vk::DescriptorType::STORAGE_BUFFER).buffer_info(&info)
        });
    }

    fn image(&self, binding: u32, image: &Image, sampler: vk::Sampler) {
        let layout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        let info =
            [vk::DescriptorImageInfo::default().image_view(image.view).image_layout(layout).sampler(sampler)];
        self.write(binding, |write| {
            write.descriptor_type(vk::DescriptorType::COMBINED_IMAGE_SAMPLER).image_info(&info)
        });
    }

    fn write<'a>(
        &self,
        binding: u32,
        fill: impl FnOnce(vk::WriteDescriptorSet<'a>) -> vk::WriteDescriptorSet<'a>,
    ) {
        let write = fill(vk::WriteDescriptorSet::default().dst_set(self.set).dst_binding(binding));
        unsafe { self.context.device.update_descriptor_sets(&[write], &[]) };
    }

    fn dispatch(&self, pipeline: &Pipeline, groups: u32) {
        self.dispatch_grid(pipeline, [groups, 1, 1]);
    }

    fn dispatch_grid(&self, pipeline: &Pipeline, [x, y, z]: [u32; 3]) {
        let device = &self.context.device;
        let compute = vk::PipelineBindPoint::COMPUTE;
        self.context
            .submit_and_wait(|cmd| unsafe {
                self.context.begin_label(cmd, c"test");
                device.cmd_bind_pipeline(cmd, compute, pipeline.handle);
                device.cmd_bind_descriptor_sets(cmd, compute, self.layout, 0, &[self.set], &[]);
                device.cmd_dispatch(cmd, x, y, z);
                self.context.end_label(cmd);
                to_host(&self.context, cmd);
            })
            .unwrap();
    }
}

impl Drop for Bindings {
    fn drop(&mut self) {
        unsafe {
            self.context.device.destroy_descriptor_pool(self.pool, None);
            self.context.device.destroy_pipeline_layout(self.layout, None);
            self.context.device.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}

/// Makes all writes visible to [`Buffer::read`].
fn to_host(context: &Context, cmd: vk::CommandBuffer) {
    let barrier = [vk::MemoryBarrier2::default()
        .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
        .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
        .dst_stage_mask(vk::PipelineStageFlags2::HOST)
        .dst_access_mask(vk::AccessFlags2::HOST_READ)];
    let dependency = vk::DependencyInfo::default().memory_barriers(&barrier);
    unsafe { context.device.cmd_pipeline_barrier2(cmd, &dependency) };
}

#[test]
fn a_device_opens_and_closes_without_a_validation_message() {
    let context = Context::new(&validated()).unwrap();
    assert!(context.limits.timestamp_valid_bits > 0 && context.limits.sample_counts.contains(&1));
    context.wait_idle().unwrap();
    context.check_validation().unwrap();
    let log = context.validation_log();
    drop(context);
    assert_eq!(log.messages(), Vec::<String>::new());
}

#[test]
fn what_is_left_over_when_the_device_closes_is_in_the_log() {
    let context = Context::new(&validated()).unwrap();
    let leaked = unsafe { context.device.create_fence(&vk::FenceCreateInfo::default(), None) }.unwrap();
    context.name(leaked, "the leaked fence");
    let log = context.validation_log();
    drop(context);
    assert!(log.messages()[0].contains("the leaked fence"), "{:?}", log.messages());
}

#[test]
fn a_missing_barrier_is_a_validation_error() {
    let context = Context::new(&validated()).unwrap();
    let usage = vk::BufferUsageFlags::TRANSFER_DST;
    let buffer = Buffer::new(&context, "raced for", 256, usage, Memory::Device).unwrap();
    context
        .submit_and_wait(|cmd| unsafe {
            context.device.cmd_fill_buffer(cmd, buffer.handle, 0, 256, 1);
            context.device.cmd_fill_buffer(cmd, buffer.handle, 0, 256, 2);
        })
        .unwrap();
    let error = context.check_validation().unwrap_err();
    assert!(matches!(error, Error::Internal(_)));
    let text = error.to_string();
    assert!(text.contains("SYNC-HAZARD-WRITE-AFTER-WRITE") && !text.contains('\n'), "{text}");
}

#[test]
fn a_device_that_is_not_there_is_named_with_those_that_are() {
    let options =
        DeviceOptions { device: Some("Voodoo 2".into()), validate: false, ..DeviceOptions::default() };
    let error = Context::new(&options).err().unwrap();
    let first = list_devices().unwrap()[0].0.name.clone();
    assert!(matches!(error, Error::Input(_)));
    assert!(error.to_string().contains("\"Voodoo 2\"") && error.to_string().contains(&first), "{error}");
    let by_name =
        DeviceOptions { device: Some(first.to_uppercase()), validate: false, ..DeviceOptions::default() };
    assert_eq!(Context::new(&by_name).unwrap().info.name, first);
}

#[test]
fn data_come_back_from_the_device_as_they_went() {
    silently(|context| {
        // Over one staging chunk, and an odd number of bytes past it.
        let data: Vec<u32> = (0..(buffer::STAGING_BYTES / 4) as u32 + 1001).collect();
        let device = Buffer::with_data(context, "there", vk::BufferUsageFlags::TRANSFER_SRC, &data).unwrap();
        let usage = vk::BufferUsageFlags::TRANSFER_DST;
        let back = Buffer::new(context, "and back", device.size, usage, Memory::Readback).unwrap();
        context
            .submit_and_wait(|cmd| unsafe {
                let whole = [vk::BufferCopy::default().size(device.size)];
                context.device.cmd_copy_buffer(cmd, device.handle, back.handle, &whole);
                to_host(context, cmd);
            })
            .unwrap();
        assert!(back.read::<u32>(0, data.len()) == data);
        assert_eq!(back.read::<u32>(8, 2), [2, 3]);
    });
}

#[test]
fn an_empty_buffer_is_allowed_and_one_over_the_limits_is_refused_in_one_line() {
    silently(|context| {
        let storage = vk::BufferUsageFlags::STORAGE_BUFFER;
        assert_eq!(Buffer::with_data::<u32>(context, "nothing", storage, &[]).unwrap().size, 16);
        let size = context.limits.max_storage_buffer_range + 1;
        let error = Buffer::new(context, "light indices", size, storage, Memory::Device).err().unwrap();
        assert!(matches!(error, Error::Device(_)));
        assert!(
            error.to_string().starts_with("light indices: ") && error.to_string().contains(&size.to_string())
        );

        let uniform = vk::BufferUsageFlags::UNIFORM_BUFFER;
        let size = context.limits.max_uniform_buffer_range + 1;
        Buffer::new(context, "materials", size, uniform, Memory::Device).expect("bound part by part");

        let side = context.limits.max_image_dimension_2d + 1;
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT;
        let format = vk::Format::R8G8B8A8_UNORM;
        let desc = ImageDesc { width: side, height: 1, format, usage, ..Default::default() };
        let error = Image::new(context, "frame", desc).err().unwrap().to_string();
        assert!(error.starts_with("frame: ") && error.contains(&side.to_string()), "{error}");
        let error = Image::new(context, "frame", ImageDesc { width: 0, ..desc }).err().unwrap().to_string();
        assert!(error.contains("0x1"), "{error}");
    });
}

#[test]
#[should_panic(expected = "too short: 8 bytes at 12 of 16")]
fn a_write_past_the_end_is_refused() {
    let context = Context::new(&DeviceOptions::default()).unwrap();
    let usage = vk::BufferUsageFlags::TRANSFER_SRC;
    Buffer::new(&context, "too short", 16, usage, Memory::Upload).unwrap().write(12, &[0u32; 2]);
}
