//! KTX 2: the first level of a two-dimensional image, in device formats or Basis Universal.

use std::io::Read;

use ::ktx2::{Format, Reader, SupercompressionScheme};
use basisu::{DecodeFlags, TargetFormat, Transcoder};
use image_dds::ImageFormat;

use super::surface::{self, Layout, Packed};
use super::{Content, Decoded, MOST_BYTES, Pixels, check_size};

/// Decodes a KTX 2 file. Whether its colours are sRGB is for `content` to say, as glTF has it.
pub(super) fn decode(bytes: &[u8], content: Content) -> Result<Decoded, String> {
    let reader = Reader::new(bytes).map_err(|e| format!("has a broken KTX2 header: {e}"))?;
    let header = reader.header();
    if header.pixel_depth > 0 || header.layer_count > 1 || header.face_count != 1 || header.pixel_height == 0
    {
        return Err("is a cube map, volume, array or line; one two-dimensional picture is read".into());
    }
    let size = [header.pixel_width, header.pixel_height];
    check_size(size, 4)?;
    let mut decoded = match header.format {
        Some(format) => decode_format(&reader, format, size, content)?,
        None => decode_basis(&reader, size, content)?,
    };
    swizzle(&mut decoded.pixels, value(&reader, "KTXswizzle").unwrap_or("rgba"));
    turn(&mut decoded.pixels, value(&reader, "KTXorientation").unwrap_or("rd"));
    Ok(decoded)
}

fn decode_format(
    reader: &Reader<&[u8]>,
    format: Format,
    size: [u32; 2],
    content: Content,
) -> Result<Decoded, String> {
    let layout = layout(format).ok_or(format!("is KTX2 of format {format:?}, which is not read"))?;
    let needed = layout.bytes(size);
    if needed > MOST_BYTES {
        return Err(format!(
            "holds {} MiB of texels; at most {} MiB are read",
            needed >> 20,
            MOST_BYTES >> 20
        ));
    }
    let level = reader.levels().next().ok_or("has no levels")?.data;
    let broken = |e: &dyn std::fmt::Display| format!("cannot be decompressed: {e}");
    // No more is decompressed than is needed: a small file may hold a great many zeros.
    let mut texels = Vec::new();
    match reader.header().supercompression_scheme {
        None => return surface::decode(layout, size, level, content),
        Some(SupercompressionScheme::Zstandard) => {
            let stream = ruzstd::StreamingDecoder::new(level).map_err(|e| broken(&e))?;
            stream.take(needed).read_to_end(&mut texels).map_err(|e| broken(&e))?;
        }
        Some(SupercompressionScheme::ZLIB) => {
            let stream = flate2::read::ZlibDecoder::new(level);
            stream.take(needed).read_to_end(&mut texels).map_err(|e| broken(&e))?;
        }
        Some(other) => return Err(format!("is supercompressed by {other:?}, which is not read")),
    }
    surface::decode(layout, size, &texels, content)
}

/// Formats that are read; whether colour is sRGB is not theirs to say.
fn layout(format: Format) -> Option<Layout> {
    use ImageFormat as F;
    let rgb = |red: u32, blue: u32| Layout::Packed(Packed { bytes: 3, masks: [red, 0xff00, blue, 0] });
    Some(Layout::Format(match format {
        Format::R8G8B8_UNORM | Format::R8G8B8_SRGB => return Some(rgb(0xff, 0xff_0000)),
        Format::B8G8R8_UNORM | Format::B8G8R8_SRGB => return Some(rgb(0xff_0000, 0xff)),
        Format::BC6H_SFLOAT_BLOCK => return Some(Layout::SignedBc6h),
        Format::R8_UNORM | Format::R8_SRGB => F::R8Unorm,
        Format::R8G8_UNORM | Format::R8G8_SRGB => F::Rg8Unorm,
        Format::R8G8B8A8_UNORM | Format::R8G8B8A8_SRGB => F::Rgba8Unorm,
        Format::B8G8R8A8_UNORM | Format::B8G8R8A8_SRGB => F::Bgra8Unorm,
        Format::R8_SNORM => F::R8Snorm,
        Format::R8G8_SNORM => F::Rg8Snorm,
        Format::R8G8B8A8_SNORM => F::Rgba8Snorm,
        Format::R16_UNORM => F::R16Unorm,
        Format::R16G16_UNORM => F::Rg16Unorm,
        Format::R16G16B16A16_UNORM => F::Rgba16Unorm,
        Format::R16_SFLOAT => F::R16Float,
        Format::R16G16_SFLOAT => F::Rg16Float,
        Format::R16G16B16A16_SFLOAT => F::Rgba16Float,
        Format::R32_SFLOAT => F::R32Float,
        Format::R32G32_SFLOAT => F::Rg32Float,
        Format::R32G32B32_SFLOAT => F::Rgb32Float,
        Format::R32G32B32A32_SFLOAT => F::Rgba32Float,
        Format::BC1_RGB_UNORM_BLOCK | Format::BC1_RGB_SRGB_BLOCK => F::BC1RgbaUnorm,
        Format::BC1_RGBA_UNORM_BLOCK | Format::BC1_RGBA_SRGB_BLOCK => F::BC1RgbaUnorm,
        Format::BC2_UNORM_BLOCK | Format::BC2_SRGB_BLOCK => F::BC2RgbaUnorm,
        Format::BC3_UNORM_BLOCK | Format::BC3_SRGB_BLOCK => F::BC3RgbaUnorm,
        Format::BC4_UNORM_BLOCK => F::BC4RUnorm,
        Format::BC4_SNORM_BLOCK => F::BC4RSnorm,
        Format::BC5_UNORM_BLOCK => F::BC5RgUnorm,
        Format::BC5_SNORM_BLOCK => F::BC5RgSnorm,
        Format::BC6H_UFLOAT_BLOCK => F::BC6hRgbUfloat,
        Format::BC7_UNORM_BLOCK | Format::BC7_SRGB_BLOCK => F::BC7RgbaUnorm,
        _ => return None,
    }))
}

/// Basis Universal: ETC1S, UASTC and what came after them.
fn decode_basis(reader: &Reader<&[u8]>, size: [u32; 2], content: Content) -> Result<Decoded, String> {
    let level = reader.levels().next().ok_or("has no levels")?;
    // What the transcoder allocates to decompress a level; no block is larger than 16 bytes, nor covers less than 4x4 texels.
    let most = 16 * size.iter().map(|&s| u64::from(s).div_ceil(4)).product::<u64>();
    if level.uncompressed_byte_length > most {
        return Err("has a broken KTX2 header: its first level is too long".into());
    }
    let broken = |e: basisu::Error| format!("holds broken Basis Universal data: {e:?}");
    let transcoder = Transcoder::new(reader.data()).map_err(broken)?;
    let transcode = |target| transcoder.transcode(0, target, DecodeFlags::NONE).map_err(broken);
    if !transcoder.supports(TargetFormat::Rgba32) {
        check_size(size, 8)?;
        let halves = transcode(TargetFormat::RgbaHalf)?;
        return surface::decode(Layout::Format(ImageFormat::Rgba16Float), size, &halves, content);
    }
    let mut texels = transcode(TargetFormat::Rgba32)?;
    if content == Content::Normal && second_in_alpha(reader) {
        texels.as_chunks_mut::<4>().0.iter_mut().for_each(|t| *t = surface::upright([t[0], t[3]]));
    }
    let has_alpha = texels.as_chunks::<4>().0.iter().any(|texel| texel[3] < 255);
    Ok(Pixels { size, has_alpha, texels }.into())
}

/// Whether two channels are stored, the second as alpha (KTX 2.0, sections 3.10.1 and 3.10.2: RRR with GGG, or RRRG).
fn second_in_alpha(reader: &Reader<&[u8]>) -> bool {
    const UASTC_RRRG: u8 = 5;
    const ETC1S_GGG: u8 = 4;
    let samples = reader.basic_dfd().map_or(&[][..], |dfd| &dfd.sample_information);
    match samples {
        [one] => one.channel_type == UASTC_RRRG,
        [_, second] => second.channel_type == ETC1S_GGG,
        _ => false,
    }
}

/// A text of the file's key and value data.
fn value<'a>(reader: &'a Reader<&[u8]>, key: &str) -> Option<&'a str> {
    let (_, value) = reader.key_value_data().find(|(name, _)| *name == key)?;
    std::str::from_utf8(value).ok().map(|text| text.trim_end_matches('\0'))
}

/// Exchanges channels: a letter for each, or 0 and 1.
fn swizzle(pixels: &mut Pixels, letters: &str) {
    let Ok(letters) = <[u8; 4]>::try_from(letters.as_bytes()) else { return };
    if letters == *b"rgba" {
        return;
    }
    for texel in pixels.texels.as_chunks_mut::<4>().0 {
        let [r, g, b, a] = *texel;
        *texel = letters.map(|letter| match letter {
            b'r' => r,
            b'g' => g,
            b'b' => b,
            b'a' => a,
            b'0' => 0,
            _ => 255,
        });
    }
    pixels.has_alpha = pixels.texels.as_chunks::<4>().0.iter().any(|texel| texel[3] < 255);
}

/// Turns an image whose columns run to the left (`l`) or whose rows run up (`u`).
fn turn(pixels: &mut Pixels, orientation: &str) {
    let row = 4 * pixels.size[0] as usize;
    if orientation.starts_with('l') {
        pixels.texels.chunks_exact_mut(row).for_each(|row| row.as_chunks_mut::<4>().0.reverse());
    }
    if orientation.as_bytes().get(1) == Some(&b'u') {
        pixels.texels = pixels.texels.chunks_exact(row).rev().flatten().copied().collect();
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use ::ktx2::{Header, Index, LevelIndex, dfd};
    use base64::Engine;

    use super::*;

    const COLOR: Content = Content::Color { cutoff: None };
    /// 8x4 texels, the left half (200, 40, 30), the right half (20, 60, 220) with alpha 128, by the encoder of Basis
    /// Universal 2.10.
    const ETC1S: &str = "q0tUWCAyMLsNChoKAAAAAAEAAAAIAAAABAAAAAAAAAAAAAAAAQAAAAEAAAABAAAAaAAAADwAAACkAAAAJAAAAMgAAAAAAAAAkgAAAAAAAABaAQ\
        AAAAAAAAIAAAAAAAAAAAAAAAAAAAA8AAAAAAAAAAIAOACjAQIAAwMAAAgIAAAAAAAAAAA/AAAAAAAAAAAA/////0AAPw8AAAAAAAAAAP////8fAAAAS1RYd3JpdGV\
        yAEJhc2lzIFVuaXZlcnNhbCAyLjEwAAAEAAMAMQAAAA0AAAAsAAAAAAAAAAAAAAAAAAAAAQAAAAEAAAABAAAAHsCUAAAAAAAAskIEAkwEAAAAAAAgCw54AHEDBAA\
        AACCTkh8gABEAAgAAACCq+JBOAVRVVVUFAAAAqKqqqgIAwUQAAAAAAADyX40AmAAQAAAAAECUAJgAIAAAAACB4gBgAgAAAAAAAAEEAHYI";
    /// The image of [`ETC1S`] as UASTC in a Zstandard frame.
    const UASTC: &str = "q0tUWCAyMLsNChoKAAAAAAEAAAAIAAAABAAAAAAAAAAAAAAAAQAAAAEAAAACAAAAaAAAACwAAACUAAAAJAAAAAAAAAAAAAAAAAAAAAAAAAC4AA\
        AAAAAAACkAAAAAAAAAIAAAAAAAAAAsAAAAAAAAAAIAKACmAQIAAwMAABAAAAAAAAAAAAB/AwAAAAAAAAAA/////x8AAABLVFh3cml0ZXIAQmFzaXMgVW5pdmVyc2F\
        sIDIuMTAAACi1L/0gIAEBABcZxeN/0McAAAAAAAAAAACXgocbsDDLAwAAAAAAAAAA";

    fn bytes(base64: &str) -> Vec<u8> {
        base64::engine::general_purpose::STANDARD.decode(base64).unwrap()
    }

    /// A KTX 2 file of 2x2 texels.
    fn file(
        format: Format,
        scheme: Option<SupercompressionScheme>,
        level: &[u8],
        pairs: &[(&str, &str)],
    ) -> Vec<u8> {
        let (descriptor, type_size) = dfd::Basic::from_format(format).unwrap();
        let descriptor = dfd::Block::Basic(descriptor).to_vec();
        let pair = |&(key, value): &(&str, &str)| {
            let mut bytes = [key.as_bytes(), b"\0", value.as_bytes(), b"\0"].concat();
            let length = bytes.len() as u32;
            bytes.resize(bytes.len().next_multiple_of(4), 0);
            [&length.to_le_bytes()[..], &bytes].concat()
        };
        let pairs: Vec<u8> = pairs.iter().flat_map(pair).collect();
        let dfd_start = Header::LENGTH + LevelIndex::LENGTH;
        let kvd_start = dfd_start + 4 + descriptor.len();
        let level_start = kvd_start + pairs.len();
        let header = Header {
            format: Some(format),
            type_size,
            pixel_width: 2,
            pixel_height: 2,
            pixel_depth: 0,
            layer_count: 0,
            face_count: 1,
            level_count: 1,
            supercompression_scheme: scheme,
            index: Index {
                dfd_byte_offset: dfd_start as u32,
                dfd_byte_length: 4 + descriptor.len() as u32,
                kvd_byte_offset: kvd_start as u32,
                kvd_byte_length: pairs.len() as u32,
                sgd_byte_offset: 0,
                sgd_byte_length: 0,
            },
        };
        let place = [level_start as u64, level.len() as u64, 16].map(u64::to_le_bytes).concat();
        let length = (4 + descriptor.len() as u32).to_le_bytes();
        [&header.as_bytes()[..], &place, &length, &descriptor, &pairs, level].concat()
    }

    fn texels(bytes: &[u8]) -> Vec<u8> {
        decode(bytes, COLOR).map_err(|e| panic!("{e}")).ok().unwrap().pixels.texels
    }

    #[test]
    fn basis_universal_is_transcoded() {
        // As the reference transcoder has them.
        let cases = [
            (ETC1S, [198, 41, 25, 255], [20, 61, 218, 128]),
            (UASTC, [200, 40, 30, 255], [20, 60, 220, 128]),
        ];
        for (base64, left, right) in cases {
            let pixels = decode(&bytes(base64), COLOR).ok().unwrap().pixels;
            assert_eq!((pixels.size, pixels.has_alpha), ([8, 4], true));
            for (i, texel) in pixels.texels.as_chunks::<4>().0.iter().enumerate() {
                assert_eq!(*texel, if i % 8 < 4 { left } else { right }, "texel {i}");
            }
        }
    }

    #[test]
    fn two_channels_of_basis_universal_are_a_normal() {
        let mut rrrg = bytes(UASTC);
        // The channel of the one sample: behind the block's 8 bytes of header and 16 of layout.
        let channel = Header::LENGTH + LevelIndex::LENGTH + 4 + 24 + 3;
        assert_eq!(rrrg[channel], 3);
        rrrg[channel] = 5;
        let pixels = decode(&rrrg, Content::Normal).ok().unwrap().pixels;
        assert_eq!(pixels.texels[4 * 4..4 * 5], surface::upright([20, 128]));
    }

    #[test]
    fn device_formats_are_decoded() {
        let (rgb, rgba) = ([1, 2, 3].repeat(4), [1, 2, 3, 4].repeat(4));
        assert_eq!(texels(&file(Format::R8G8B8_SRGB, None, &rgb, &[]))[..4], [1, 2, 3, 255]);
        assert_eq!(texels(&file(Format::R8G8B8A8_UNORM, None, &rgba, &[])), rgba);
        assert_eq!(texels(&file(Format::B8G8R8A8_SRGB, None, &rgba, &[]))[..4], [3, 2, 1, 4]);
        let bc1 = [0x00, 0xf8, 0x00, 0xf8, 0, 0, 0, 0];
        assert_eq!(texels(&file(Format::BC1_RGB_SRGB_BLOCK, None, &bc1, &[]))[..4], [255, 0, 0, 255]);
        let refused = decode(&file(Format::ASTC_4x4_SRGB_BLOCK, None, &[0; 16], &[]), COLOR).err().unwrap();
        assert!(refused.ends_with("which is not read"), "{refused}");
    }

    #[test]
    fn supercompressed_levels_are_decompressed_to_what_is_needed() {
        let rgba: Vec<u8> = (0..16).collect();
        // A frame of one raw block.
        let frame = [&[0x28, 0xb5, 0x2f, 0xfd, 0x20, 16, 16 << 3 | 1, 0, 0][..], &rgba].concat();
        let zstandard = file(Format::R8G8B8A8_UNORM, Some(SupercompressionScheme::Zstandard), &frame, &[]);
        assert_eq!(texels(&zstandard), rgba);
        let mut stream = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
        stream.write_all(&[&rgba[..], &[0; 1 << 16]].concat()).unwrap();
        let zlib =
            file(Format::R8G8B8A8_UNORM, Some(SupercompressionScheme::ZLIB), &stream.finish().unwrap(), &[]);
        assert_eq!(texels(&zlib), rgba);
    }

    #[test]
    fn swizzle_and_orientation_are_applied() {
        let rgba: Vec<u8> = (0..16).collect();
        let with = |pair| texels(&file(Format::R8G8B8A8_UNORM, None, &rgba, &[pair]));
        assert_eq!(with(("KTXswizzle", "bg01"))[..4], [2, 1, 0, 255]);
        assert_eq!(with(("KTXorientation", "ru")), [&rgba[8..], &rgba[..8]].concat());
        assert_eq!(with(("KTXorientation", "ld"))[..8], [4, 5, 6, 7, 0, 1, 2, 3]);
        assert_eq!(with(("KTXwriter", "none")), rgba);
    }

    #[test]
    fn mutated_files_are_refused_or_decoded_but_never_panic() {
        for base64 in [ETC1S, UASTC] {
            let whole = bytes(base64);
            let mut seed = 1_u32;
            for _ in 0..3000 {
                let mut mutated = whole.clone();
                for _ in 0..1 + seed % 3 {
                    seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    let place = (seed >> 8) as usize % mutated.len();
                    mutated[place] = (seed >> 24) as u8;
                }
                // Sizes stay small, for time's sake.
                mutated[22..28].copy_from_slice(&whole[22..28]);
                let _ = decode(&mutated, COLOR);
            }
        }
    }
}
