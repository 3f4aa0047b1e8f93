//! Texels as devices store them, block-compressed or packed, to 8-bit RGBA.

use std::sync::atomic::{AtomicBool, Ordering};

use image_dds::{ImageFormat, Surface};
use rayon::prelude::*;

use super::super::mips;
use super::{Content, Decoded, Pixels, check_size};

/// Rows decoded at once: whole blocks, few enough that their floats take little memory.
const STRIP_ROWS: usize = 64;

/// How texels are stored, row by row without gaps.
#[derive(Debug, Clone, Copy)]
pub(super) enum Layout {
    /// A format that devices know.
    Format(ImageFormat),
    /// Blocks of BC6H that hold negative numbers, which `image_dds` reads as if they did not.
    SignedBc6h,
    /// Bits of little-endian words.
    Packed(Packed),
}

/// Where the channels lie in a word.
#[derive(Debug, Clone, Copy)]
pub(super) struct Packed {
    /// Size in bytes of a word, 1 to 4.
    pub bytes: usize,
    /// Masks of red, green, blue and alpha; a channel without bits is full.
    pub masks: [u32; 4],
}

/// What the numbers of a format mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Numbers {
    /// 0..1, rounded to 8 bits by the decoder.
    Unorm,
    /// Signed normalised integers, -1..1.
    Snorm,
    /// Linear floating-point numbers, unbounded.
    Float,
}

impl Layout {
    /// Texels along a block's side, and its bytes.
    fn block(self) -> (usize, usize) {
        match self {
            Self::Packed(packed) => (1, packed.bytes),
            Self::SignedBc6h => (4, 16),
            Self::Format(format) => {
                let bytes = |side: u32| {
                    let zeros = [0; 16 * 16];
                    surface(format, [side; 2], &zeros).get(0, 0, 0).expect("no texel is larger").len()
                };
                (if bytes(4) == bytes(1) { 4 } else { 1 }, bytes(1))
            }
        }
    }

    /// Size in bytes of an image of `size` (width, height).
    pub fn bytes(self, size: [u32; 2]) -> u64 {
        let (side, bytes) = self.block();
        size.iter().map(|&s| u64::from(s).div_ceil(side as u64)).product::<u64>() * bytes as u64
    }

    fn numbers(self) -> Numbers {
        use ImageFormat as F;
        match self {
            Self::Packed(_) => Numbers::Unorm,
            Self::SignedBc6h => Numbers::Float,
            Self::Format(format) => match format {
                F::R8Snorm | F::Rg8Snorm | F::Rgba8Snorm => Numbers::Snorm,
                F::R16Snorm | F::Rg16Snorm | F::Rgba16Snorm => Numbers::Snorm,
                F::BC4RSnorm | F::BC5RgSnorm => Numbers::Snorm,
                F::R16Float | F::Rg16Float | F::Rgba16Float | F::BC6hRgbUfloat | F::BC6hRgbSfloat => {
                    Numbers::Float
                }
                F::R32Float | F::Rg32Float | F::Rgb32Float | F::Rgba32Float => Numbers::Float,
                _ => Numbers::Unorm,
            },
        }
    }

    fn channels(self) -> usize {
        use ImageFormat as F;
        let Self::Format(format) = self else { return 4 };
        match format {
            F::R8Unorm | F::R8Snorm | F::R16Unorm | F::R16Snorm | F::R16Float | F::R32Float => 1,
            F::BC4RUnorm | F::BC4RSnorm => 1,
            F::Rg8Unorm | F::Rg8Snorm | F::Rg16Unorm | F::Rg16Snorm | F::Rg16Float | F::Rg32Float => 2,
            F::BC5RgUnorm | F::BC5RgSnorm => 2,
            _ => 4,
        }
    }
}

fn surface(format: ImageFormat, [width, height]: [u32; 2], data: &[u8]) -> Surface<&[u8]> {
    Surface { width, height, depth: 1, layers: 1, mipmaps: 1, image_format: format, data }
}

/// Decodes an image of `size` (width, height), strip by strip on all cores; what follows in `data` is left.
pub(super) fn decode(
    layout: Layout,
    size: [u32; 2],
    data: &[u8],
    content: Content,
) -> Result<Decoded, String> {
    check_size(size, 4)?;
    let needed = layout.bytes(size);
    if (data.len() as u64) < needed {
        return Err(format!("is truncated: {} bytes of texels of {needed}", data.len()));
    }
    let [width, height] = size.map(|s| s as usize);
    let (side, _) = layout.block();
    let strip_bytes = needed as usize / height.div_ceil(side) * (STRIP_ROWS / side);
    let mut texels = vec![0; 4 * width * height];
    let clipped = AtomicBool::new(false);
    let strips = data[..needed as usize].par_chunks(strip_bytes);
    strips.zip(texels.par_chunks_mut(4 * width * STRIP_ROWS)).try_for_each(|(data, out)| {
        let rows = (out.len() / (4 * width)) as u32;
        let strip = Strip { layout, size: [size[0], rows], data, content };
        clipped.fetch_or(strip.decode(out)?, Ordering::Relaxed);
        Ok::<_, String>(())
    })?;
    let has_alpha = texels.as_chunks::<4>().0.iter().any(|texel| texel[3] < 255);
    Ok(Decoded { pixels: Pixels { size, has_alpha, texels }, clipped: clipped.into_inner() })
}

/// Some rows of an image.
struct Strip<'a> {
    layout: Layout,
    size: [u32; 2],
    data: &'a [u8],
    content: Content,
}

impl Strip<'_> {
    /// Writes RGBA; true where something was clipped.
    fn decode(&self, out: &mut [u8]) -> Result<bool, String> {
        let clipped = match (self.layout, self.layout.numbers()) {
            (Layout::Packed(packed), _) => {
                packed.decode(self.data, out);
                false
            }
            (Layout::Format(format), Numbers::Unorm) => {
                let decoded = surface(format, self.size, self.data).decode_rgba8();
                out.copy_from_slice(&decoded.map_err(|e| format!("cannot be decoded: {e}"))?.data);
                false
            }
            (Layout::Format(format), numbers) => {
                let decoded = surface(format, self.size, self.data).decode_rgbaf32();
                let decoded = decoded.map_err(|e| format!("cannot be decoded: {e}"))?.data;
                self.to_codes(&decoded, numbers, out)
            }
            (Layout::SignedBc6h, numbers) => self.to_codes(&self.signed_bc6h(), numbers, out),
        };
        complete(out, self.layout.channels(), self.content);
        Ok(clipped)
    }

    /// RGBA of blocks of BC6H with negative numbers.
    fn signed_bc6h(&self) -> Vec<f32> {
        let [width, height] = self.size.map(|s| s as usize);
        let mut texels = vec![1.0; 4 * width * height];
        for (number, block) in self.data.chunks_exact(16).enumerate() {
            let mut rgb = [0.0; 4 * 4 * 3];
            bcdec_rs::bc6h_float(block, &mut rgb, 4 * 3, true);
            let (left, top) = (number % width.div_ceil(4) * 4, number / width.div_ceil(4) * 4);
            for (y, row) in rgb.chunks_exact(12).enumerate().filter(|(y, _)| top + y < height) {
                for (x, texel) in row.chunks_exact(3).enumerate().filter(|(x, _)| left + x < width) {
                    texels[4 * ((top + y) * width + left + x)..][..3].copy_from_slice(texel);
                }
            }
        }
        texels
    }

    fn to_codes(&self, values: &[f32], numbers: Numbers, out: &mut [u8]) -> bool {
        let direction = numbers == Numbers::Snorm && self.content == Content::Normal;
        let color = numbers == Numbers::Float && matches!(self.content, Content::Color { .. });
        let mut clipped = false;
        for (place, (&value, code)) in values.iter().zip(out).enumerate() {
            let value = if direction && place % 4 < 3 { 0.5 * value + 0.5 } else { value };
            clipped |= !(0.0..=1.0).contains(&value);
            let value = value.clamp(0.0, 1.0);
            *code =
                if color && place % 4 < 3 { mips::srgb_code(value) } else { (255.0 * value).round() as u8 };
        }
        clipped
    }
}

impl Packed {
    fn decode(&self, data: &[u8], out: &mut [u8]) {
        for (word, texel) in data.chunks_exact(self.bytes).zip(out.as_chunks_mut::<4>().0) {
            let word = word.iter().rev().fold(0, |word, &byte| word << 8 | u32::from(byte));
            *texel = self.masks.map(|mask| {
                let most = u64::from(mask >> mask.trailing_zeros().min(31));
                let value = u64::from((word & mask) >> mask.trailing_zeros().min(31));
                if mask == 0 { 255 } else { ((value * 255 + most / 2) / most) as u8 }
            });
        }
    }
}

/// Fills in the channels that a format lacks.
fn complete(texels: &mut [u8], channels: usize, content: Content) {
    let texels = texels.as_chunks_mut::<4>().0.iter_mut();
    match (channels, content) {
        (1, _) => texels.for_each(|texel| *texel = [texel[0], texel[0], texel[0], 255]),
        (2, Content::Normal) => texels.for_each(|texel| *texel = upright([texel[0], texel[1]])),
        (2, _) => texels.for_each(|texel| *texel = [texel[0], texel[1], 0, 255]),
        _ => {}
    }
}

/// The unit normal with these x and y, the viewer's side up.
pub(super) fn upright(xy: [u8; 2]) -> [u8; 4] {
    let [x, y] = xy.map(|code| f32::from(code) / 127.5 - 1.0);
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    [xy[0], xy[1], (z * 127.5 + 127.5).round() as u8, 255]
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLOR: Content = Content::Color { cutoff: None };

    fn texels(layout: Layout, size: [u32; 2], data: &[u8], content: Content) -> Vec<u8> {
        decode(layout, size, data, content).ok().unwrap().pixels.texels
    }

    /// A block of one endpoint colour: RGB565 red.
    const RED_BC1: [u8; 8] = [0x00, 0xf8, 0x00, 0xf8, 0, 0, 0, 0];

    #[test]
    fn sizes_count_whole_blocks() {
        use ImageFormat as F;
        let formats =
            [(F::BC1RgbaUnorm, 32), (F::BC7RgbaUnorm, 64), (F::Rgba8Unorm, 84), (F::Rgba32Float, 336)];
        for (format, bytes) in formats {
            assert_eq!(
                Layout::Format(format).bytes([7, 3]) * 2,
                bytes * if bytes < 80 { 1 } else { 2 },
                "{format:?}"
            );
        }
    }

    #[test]
    fn strips_meet_without_a_seam_and_cut_blocks_are_cut() {
        // 6x131 texels: two blocks across, 33 down; every block row is red or green by turns.
        let green = [0xe0, 0x07, 0xe0, 0x07, 0, 0, 0, 0];
        let data: Vec<u8> =
            (0..33).flat_map(|row| [if row % 2 == 0 { RED_BC1 } else { green }; 2].concat()).collect();
        let decoded = texels(Layout::Format(ImageFormat::BC1RgbaUnorm), [6, 131], &data, COLOR);
        for (i, texel) in decoded.as_chunks::<4>().0.iter().enumerate() {
            let red = i / 6 / 4 % 2 == 0;
            assert_eq!(*texel, if red { [255, 0, 0, 255] } else { [0, 255, 0, 255] }, "row {}", i / 6);
        }
    }

    #[test]
    fn two_channels_of_a_normal_map_get_the_third() {
        // x = 0.6, y = 0: z is 0.8.
        let block = |code: u8| [code, code, 0, 0, 0, 0, 0, 0];
        let bc5 = [block(204), block(128)].concat();
        let decoded = texels(Layout::Format(ImageFormat::BC5RgUnorm), [4, 4], &bc5, Content::Normal);
        assert_eq!(decoded[..4], [204, 128, 229, 255]);
        let signed = [block(76), block(0)].concat();
        let decoded = texels(Layout::Format(ImageFormat::BC5RgSnorm), [4, 4], &signed, Content::Normal);
        assert_eq!(decoded[..4], [204, 128, 229, 255]);
        let decoded = texels(Layout::Format(ImageFormat::BC5RgUnorm), [4, 4], &bc5, Content::Data);
        assert_eq!(decoded[..4], [204, 128, 0, 255]);
    }

    #[test]
    fn one_channel_is_grey() {
        let decoded = texels(
            Layout::Format(ImageFormat::BC4RUnorm),
            [4, 4],
            &[90, 90, 0, 0, 0, 0, 0, 0],
            Content::Data,
        );
        assert_eq!(decoded[..4], [90, 90, 90, 255]);
        assert_eq!(texels(Layout::Format(ImageFormat::R8Unorm), [1, 1], &[7], COLOR), [7, 7, 7, 255]);
    }

    #[test]
    fn linear_floats_become_srgb_colour_or_plain_numbers() {
        let half = |v: f32| half::f16::from_f32(v).to_le_bytes();
        let data = [half(0.5), half(4.0), half(0.0), half(0.5)].concat();
        let layout = Layout::Format(ImageFormat::Rgba16Float);
        let decoded = decode(layout, [1, 1], &data, COLOR).ok().unwrap();
        assert_eq!((decoded.pixels.texels, decoded.clipped), (vec![188, 255, 0, 128], true));
        assert_eq!(texels(layout, [1, 1], &data, Content::Data), [128, 255, 0, 128]);
    }

    #[test]
    fn bits_are_scaled_to_bytes() {
        let r5g6b5 = Layout::Packed(Packed { bytes: 2, masks: [0xf800, 0x07e0, 0x001f, 0] });
        let word = |r: u16, g: u16, b: u16| (r << 11 | g << 5 | b).to_le_bytes();
        let data = [word(31, 0, 16), word(0, 63, 0)].concat();
        assert_eq!(texels(r5g6b5, [2, 1], &data, COLOR), [255, 0, 132, 255, 0, 255, 0, 255]);
        let bgra = Layout::Packed(Packed { bytes: 4, masks: [0xff_0000, 0xff00, 0xff, 0xff00_0000] });
        assert_eq!(texels(bgra, [1, 1], &[1, 2, 3, 4], COLOR), [3, 2, 1, 4]);
    }
}
