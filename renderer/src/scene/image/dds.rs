//! DirectDraw surfaces: the first level of a two-dimensional one.

use image_dds::ImageFormat;
use image_dds::ddsfile::{Caps2, Dds, DxgiFormat, FourCC, MiscFlag, PixelFormatFlags};

use super::surface::{self, Layout, Packed};
use super::{Content, Decoded};

/// Decodes a DDS file. Whether its colours are sRGB is for `content` to say: older files cannot, and newer ones often say
/// nothing true.
pub(super) fn decode(bytes: &[u8], content: Content) -> Result<Decoded, String> {
    let dds = Dds::read(bytes).map_err(|e| format!("has a broken DDS header: {e}"))?;
    let many = dds
        .header10
        .as_ref()
        .is_some_and(|h| h.array_size > 1 || h.misc_flag.contains(MiscFlag::TEXTURECUBE));
    if many || dds.header.caps2.intersects(Caps2::CUBEMAP | Caps2::VOLUME) {
        return Err("is a cube map, volume or array; one two-dimensional picture is read".into());
    }
    surface::decode(layout(&dds)?, [dds.get_width(), dds.get_height()], &dds.data, content)
}

fn layout(dds: &Dds) -> Result<Layout, String> {
    let format = &dds.header.spf;
    if format.fourcc.is_none() {
        return packed(dds).map(Layout::Packed);
    }
    match (dds.header10.as_ref().map(|h| h.dxgi_format), image_dds::dds_image_format(dds)) {
        (Some(DxgiFormat::BC6H_SF16), _) => Ok(Layout::SignedBc6h),
        (Some(DxgiFormat::B8G8R8X8_UNorm | DxgiFormat::B8G8R8X8_UNorm_sRGB), _) => {
            Ok(Layout::Packed(Packed { bytes: 4, masks: [0xff_0000, 0xff00, 0xff, 0] }))
        }
        (_, Ok(format)) => Ok(Layout::Format(format)),
        (Some(dxgi), Err(_)) => typeless(dxgi)
            .map(Layout::Format)
            .ok_or(format!("is a DDS of format {dxgi:?}, which is not read")),
        (None, Err(_)) => match format.fourcc {
            Some(FourCC(FourCC::ATI1)) => Ok(Layout::Format(ImageFormat::BC4RUnorm)),
            ref code => Err(format!("is a DDS of format {code:?}, which is not read")),
        },
    }
}

/// What is meant by formats that leave it open.
fn typeless(format: DxgiFormat) -> Option<ImageFormat> {
    Some(match format {
        DxgiFormat::BC1_Typeless => ImageFormat::BC1RgbaUnorm,
        DxgiFormat::BC2_Typeless => ImageFormat::BC2RgbaUnorm,
        DxgiFormat::BC3_Typeless => ImageFormat::BC3RgbaUnorm,
        DxgiFormat::BC4_Typeless => ImageFormat::BC4RUnorm,
        DxgiFormat::BC5_Typeless => ImageFormat::BC5RgUnorm,
        DxgiFormat::BC6H_Typeless => ImageFormat::BC6hRgbUfloat,
        DxgiFormat::BC7_Typeless => ImageFormat::BC7RgbaUnorm,
        DxgiFormat::R8G8B8A8_Typeless => ImageFormat::Rgba8Unorm,
        DxgiFormat::B8G8R8A8_Typeless => ImageFormat::Bgra8Unorm,
        _ => return None,
    })
}

/// Uncompressed texels by their masks; luminance has none and takes what alpha leaves.
fn packed(dds: &Dds) -> Result<Packed, String> {
    let format = &dds.header.spf;
    let bits = format.rgb_bit_count.unwrap_or(8);
    if !matches!(bits, 8 | 16 | 24 | 32) {
        return Err(format!("is a DDS of {bits} bits a texel; 8, 16, 24 and 32 are read"));
    }
    let alpha = format.a_bit_mask.unwrap_or(0);
    let luminance = !alpha & (u32::MAX >> (32 - bits));
    let [red, green, blue] = match format.flags.contains(PixelFormatFlags::LUMINANCE) {
        true => [luminance; 3],
        false => [format.r_bit_mask, format.g_bit_mask, format.b_bit_mask].map(|mask| mask.unwrap_or(0)),
    };
    if red | green | blue | alpha == 0 {
        return Err("is a DDS without a pixel format".into());
    }
    Ok(Packed { bytes: bits as usize / 8, masks: [red, green, blue, alpha] })
}

#[cfg(test)]
pub(in crate::scene) mod tests {
    use super::*;

    const COLOR: Content = Content::Color { cutoff: None };

    /// A DDS file of 4x4 texels: `format` is its pixel format from the flags on, `dxgi` the format of a DX10 header.
    fn file(format: [u32; 7], dxgi: Option<u32>, data: &[u8]) -> Vec<u8> {
        let mut words = [0_u32; 31];
        // Sizes of the structs; caps, height, width and pixel format are there.
        (words[0], words[1], words[2], words[3], words[18]) = (124, 0x1007, 4, 4, 32);
        words[19..26].copy_from_slice(&format);
        words[26] = 0x1000;
        let header = [*b"DDS "].into_iter().chain(words.map(u32::to_le_bytes)).flatten();
        let dx10 = dxgi.map(|format| [format, 3, 0, 1, 0].map(u32::to_le_bytes));
        header.chain(dx10.into_iter().flatten().flatten()).chain(data.iter().copied()).collect()
    }

    fn fourcc(code: &[u8; 4], data: &[u8]) -> Vec<u8> {
        file([4, u32::from_le_bytes(*code), 0, 0, 0, 0, 0], None, data)
    }

    fn dx10(format: u32, data: &[u8]) -> Vec<u8> {
        file([4, u32::from_le_bytes(*b"DX10"), 0, 0, 0, 0, 0], Some(format), data)
    }

    fn first(bytes: &[u8], content: Content) -> [u8; 4] {
        let pixels = decode(bytes, content).map_err(|e| panic!("{e}")).ok().unwrap().pixels;
        assert_eq!(pixels.size, [4, 4]);
        pixels.texels.as_chunks::<4>().0[0]
    }

    /// One BC7 block in mode 6, of one colour with odd channels.
    fn bc7([r, g, b, a]: [u8; 4]) -> [u8; 16] {
        let channels = [r, r, g, g, b, b, a, a].into_iter().rev();
        let ends = channels.fold(0_u128, |bits, channel| bits << 7 | u128::from(channel >> 1));
        (3 << 63 | ends << 7 | 1 << 6).to_le_bytes()
    }

    /// A BC7 file of 4x4 texels of one colour with odd channels.
    pub fn solid(texel: [u8; 4]) -> Vec<u8> {
        dx10(99, &bc7(texel))
    }

    /// One BC6H block with 10-bit ends and no differences, of one colour.
    fn bc6h(rgb: [u128; 3]) -> [u8; 16] {
        let ends = rgb.iter().chain(&rgb).rev().fold(0, |bits, end| bits << 10 | end);
        (ends << 5 | 3).to_le_bytes()
    }

    #[test]
    fn every_block_format_is_decoded() {
        // Orange of 5, 6 and 5 bits; then an even alpha.
        let bc1 = [0x00, 0xfc, 0x00, 0xfc, 0, 0, 0, 0];
        let orange = [255, 130, 0, 255];
        let bc3 = [&[128, 128, 0, 0, 0, 0, 0, 0][..], &bc1].concat();
        let bc2 = [&[0x88; 8][..], &bc1].concat();
        let cases = [
            (fourcc(b"DXT1", &bc1), orange),
            (fourcc(b"DXT3", &bc2), [255, 130, 0, 136]),
            (fourcc(b"DXT5", &bc3), [255, 130, 0, 128]),
            (fourcc(b"ATI1", &[90, 90, 0, 0, 0, 0, 0, 0]), [90, 90, 90, 255]),
            (fourcc(b"BC4U", &[90, 90, 0, 0, 0, 0, 0, 0]), [90, 90, 90, 255]),
            (fourcc(b"ATI2", &[90, 90, 0, 0, 0, 0, 0, 0, 7, 7, 0, 0, 0, 0, 0, 0]), [90, 7, 0, 255]),
            (dx10(71, &bc1), orange),
            (dx10(72, &bc1), orange),
            (dx10(70, &bc1), orange),
            (dx10(77, &bc3), [255, 130, 0, 128]),
            (dx10(98, &bc7([201, 41, 31, 255])), [201, 41, 31, 255]),
            (dx10(99, &bc7([201, 41, 31, 129])), [201, 41, 31, 129]),
        ];
        for (bytes, texel) in cases {
            assert_eq!(first(&bytes, Content::Data), texel);
            let pixels = decode(&bytes, Content::Data).ok().unwrap().pixels;
            assert_eq!(pixels.has_alpha, texel[3] < 255);
        }
    }

    #[test]
    fn halves_in_blocks_are_linear_light() {
        // 1, 0 and 0.5.
        let unsigned = dx10(95, &bc6h([495, 0, 462]));
        assert_eq!(first(&unsigned, COLOR), [255, 0, 188, 255]);
        assert_eq!(first(&unsigned, Content::Data), [255, 0, 128, 255]);
        // 0.993, -0.4 and 0.
        let signed = dx10(96, &bc6h([247, 1024 - 100, 0]));
        assert_eq!(first(&signed, Content::Data), [253, 0, 0, 255]);
        assert!(
            decode(&signed, COLOR).ok().unwrap().clipped && !decode(&unsigned, COLOR).ok().unwrap().clipped
        );
    }

    #[test]
    fn uncompressed_texels_follow_their_masks() {
        let masks =
            |flags, bits, r, g, b, a, data: &[u8]| file([flags, 0, bits, r, g, b, a], None, &data.repeat(16));
        let cases = [
            (masks(0x41, 32, 0xff_0000, 0xff00, 0xff, 0xff00_0000, &[1, 2, 3, 4]), [3, 2, 1, 4]),
            (masks(0x41, 32, 0xff, 0xff00, 0xff_0000, 0xff00_0000, &[1, 2, 3, 4]), [1, 2, 3, 4]),
            (masks(0x40, 32, 0xff_0000, 0xff00, 0xff, 0, &[1, 2, 3, 0]), [3, 2, 1, 255]),
            (masks(0x40, 24, 0xff_0000, 0xff00, 0xff, 0, &[1, 2, 3]), [3, 2, 1, 255]),
            (masks(0x40, 16, 0xf800, 0x7e0, 0x1f, 0, &[0x00, 0xf8]), [255, 0, 0, 255]),
            (masks(0x2_0000, 8, 0xff, 0, 0, 0, &[7]), [7, 7, 7, 255]),
            (masks(0x2_0001, 16, 0xff, 0, 0, 0xff00, &[7, 9]), [7, 7, 7, 9]),
            (masks(2, 8, 0, 0, 0, 0xff, &[9]), [255, 255, 255, 9]),
            (dx10(28, &[1, 2, 3, 4].repeat(16)), [1, 2, 3, 4]),
            (dx10(29, &[1, 2, 3, 4].repeat(16)), [1, 2, 3, 4]),
            (dx10(87, &[1, 2, 3, 4].repeat(16)), [3, 2, 1, 4]),
            (dx10(88, &[1, 2, 3, 4].repeat(16)), [3, 2, 1, 255]),
        ];
        for (i, (bytes, texel)) in cases.into_iter().enumerate() {
            assert_eq!(first(&bytes, Content::Data), texel, "case {i}");
        }
    }

    #[test]
    fn what_is_not_one_picture_or_not_whole_is_refused() {
        let refused = |bytes: &[u8]| decode(bytes, COLOR).err().unwrap();
        let mut cube = fourcc(b"DXT1", &[0; 48]);
        cube[4 + 4 * 27 + 1] = 0xfe;
        assert!(refused(&cube).starts_with("is a cube map"));
        assert_eq!(refused(&fourcc(b"DXT1", &[0; 7])), "is truncated: 7 bytes of texels of 8");
        assert!(refused(&fourcc(b"WHAT", &[0; 64])).ends_with("which is not read"));
        assert!(refused(&dx10(101, &[0; 64])).ends_with("which is not read"));
        assert!(refused(b"DDS ").starts_with("has a broken DDS header"));
        let mut huge = fourcc(b"DXT1", &[0; 8]);
        huge[12..20].copy_from_slice(&[0, 0, 1, 0, 0, 0, 1, 0]);
        assert!(refused(&huge).starts_with("is 65536x65536 texels"));
    }
}
