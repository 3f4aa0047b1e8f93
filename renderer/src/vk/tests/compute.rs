//! Compute pipelines and sampled textures.

use super::*;

const DOUBLE: &str = "#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint FACTOR = 1;
layout(scalar, binding = 0) buffer Values { uint values[]; };
void main() {
    if (gl_GlobalInvocationID.x < values.length()) {
        values[gl_GlobalInvocationID.x] *= FACTOR;
    }
}
";

#[test]
fn a_compute_pipeline_doubles_its_values() {
    silently(|context| {
        let words = shaders(&[("double.comp", DOUBLE)]).compile("double.comp", &[]).unwrap();
        let bindings = Bindings::new(context, &[vk::DescriptorType::STORAGE_BUFFER]);
        let pipeline =
            compute_pipeline(context, bindings.layout, &words, "double", &[(0, 32), (1, 2)]).unwrap();
        let values: Vec<u32> = (0..1000).collect();
        let size = 4 * values.len() as u64;
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let buffer = Buffer::new(context, "values", size, usage, Memory::Readback).unwrap();
        buffer.write(0, &values);
        bindings.buffer(0, &buffer);
        bindings.dispatch(&pipeline, 1000_u32.div_ceil(32));
        assert_eq!(buffer.read::<u32>(0, values.len()), values.iter().map(|v| v * 2).collect::<Vec<_>>());
    });
}

const SAMPLE: &str = "#version 460
#extension GL_EXT_scalar_block_layout : require
layout(local_size_x = 1) in;
layout(binding = 0) uniform sampler2D image;
layout(scalar, binding = 1) buffer Texels { vec4 texels[]; };
void main() {
    uint next = 0;
    for (int mip = 0; mip < textureQueryLevels(image); ++mip) {
        ivec2 size = textureSize(image, mip);
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                texels[next++] = textureLod(image, (vec2(x, y) + 0.5) / size, mip);
            }
        }
    }
}
";

/// An image of 7 by 5 texels with three mips, every byte of all its levels different from its neighbours.
fn image(name: &str, srgb: bool, seed: usize) -> scene::Image {
    let level = |texels: usize| (0..texels * 4).map(|i| ((i + texels) * 37 + seed) as u8).collect();
    scene::Image { name: name.into(), width: 7, height: 5, srgb, mips: [35, 6, 1].map(level).to_vec() }
}

/// The byte whose sRGB code is nearest to a linear value: devices decode sRGB to within half a code.
fn srgb_code(linear: f32) -> f32 {
    let encoded = if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round()
}

#[test]
fn of_a_texture_too_large_for_the_device_smaller_levels_arrive() {
    silently(|context| {
        let most = texture::Most { bytes: 64, side: 6 };
        let textures = texture::upload_in_chunks(context, &[image("large", true, 3)], most).unwrap();
        let vk::Extent2D { width, height } = textures[0].extent;
        assert_eq!((width, height, textures[0].mip_levels), (3, 2, 2));
    });
}

#[test]
fn all_mips_of_all_textures_arrive_also_in_many_small_chunks() {
    silently(|context| {
        let images = [image("colour", true, 3), image("data", false, 11)];
        let words = shaders(&[("sample.comp", SAMPLE)]).compile("sample.comp", &[]).unwrap();
        let kinds = [vk::DescriptorType::COMBINED_IMAGE_SAMPLER, vk::DescriptorType::STORAGE_BUFFER];
        let samplers = SamplerCache::new(context).unwrap();
        let nearest = samplers.get(scene::Sampler { wrap: [scene::Wrap::Clamp; 2], nearest: true });
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let texels = Buffer::new(context, "texels", 42 * 16, usage, Memory::Readback).unwrap();
        for capacity in [buffer::STAGING_BYTES, 64] {
            let most = texture::Most { bytes: capacity, side: 7 };
            let textures = texture::upload_in_chunks(context, &images, most).unwrap();
            for (image, texture) in images.iter().zip(&textures) {
                let bindings = Bindings::new(context, &kinds);
                let pipeline = compute_pipeline(context, bindings.layout, &words, "sample", &[]).unwrap();
                bindings.image(0, texture, nearest);
                bindings.buffer(1, &texels);
                bindings.dispatch(&pipeline, 1);
                let bytes = image.mips.concat();
                for (index, (&byte, got)) in bytes.iter().zip(texels.read::<f32>(0, 42 * 4)).enumerate() {
                    let colour = image.srgb && index % 4 != 3;
                    let code = if colour { srgb_code(got) } else { (255.0 * got).round() };
                    assert_eq!(code, f32::from(byte), "{} byte {index}, sampled as {got}", image.name);
                }
            }
        }
    });
}
