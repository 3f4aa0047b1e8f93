//! Images: decoding on all cores, into mip chains.
//!
//! What an image file is, is told by its first bytes: exporters rename files and mistake their media types.

pub(super) mod dds;
mod ktx2;
mod surface;

use std::io::Cursor;
use std::path::Path;

use ::image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits, guess_format};
use rayon::prelude::*;

use super::{Image, mips};
use crate::{Error, Result};

/// Most bytes of a decoded image, as the file has it or as RGBA: 16384x16384 texels of four bytes. It bounds what a small
/// broken file makes the program allocate.
const MOST_BYTES: u64 = 1 << 30;

/// The kinds of files that are read, for messages.
const KINDS: &str = "PNG, JPEG, WebP, TGA, BMP, DDS and KTX2";

/// What the texels of an image mean, which decides how its mips are averaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Content {
    /// sRGB colour and linear alpha.
    Color {
        /// 8-bit alpha cut-off of the masked material that reads it: its mips keep the share of texels above.
        cutoff: Option<u8>,
    },
    /// Linear numbers, of which none is a direction.
    Data,
    /// A tangent-space normal: its mips stay unit vectors.
    Normal,
}

impl Image {
    /// Builds the mip chain of row-major RGBA texels, `size` (width, height) of them.
    ///
    /// # Panics
    /// If there are not `4 * width * height` bytes, or none.
    pub fn with_mips(name: impl Into<String>, size: [u32; 2], texels: Vec<u8>, content: Content) -> Self {
        let [width, height] = size;
        assert_eq!(texels.len(), 4 * width as usize * height as usize, "RGBA texels");
        assert!(!texels.is_empty(), "an image has texels");
        let srgb = matches!(content, Content::Color { .. });
        Self { name: name.into(), width, height, srgb, mips: mips::chain(size, texels, content) }
    }
}

/// An image file as it lies in memory.
#[derive(Debug, Clone, Copy)]
pub(super) struct Encoded<'a> {
    /// Name of the image in messages and in [`Image::name`].
    pub name: &'a str,
    /// The file to blame if it is broken.
    pub file: &'a Path,
    /// Content of the file, in one of [`KINDS`].
    pub bytes: &'a [u8],
}

impl Encoded<'_> {
    /// Decodes the first level to RGBA texels of `content`: one channel becomes equal RGB, two of a normal map get the third,
    /// numbers of other widths are rounded to 8 bits.
    pub fn decode(&self, content: Content) -> Result<Pixels> {
        let fail = |what: String| Error::file(self.file, format!("image {}: {what}", self.name));
        let Decoded { pixels, clipped } = decode(self.bytes, content).map_err(fail)?;
        if clipped {
            let file = self.file.display();
            tracing::warn!("{file}: image {}: what is outside 0..1 is clipped to it", self.name);
        }
        Ok(pixels)
    }
}

/// A decoded image.
pub(super) struct Pixels {
    /// Width and height, texels.
    pub size: [u32; 2],
    /// The file had an alpha channel; of formats that always have one, whether anything is not opaque.
    pub has_alpha: bool,
    /// Texels, row-major RGBA.
    pub texels: Vec<u8>,
}

/// A decoded image, and whether it held numbers that 8 bits cannot hold.
struct Decoded {
    pixels: Pixels,
    clipped: bool,
}

impl From<Pixels> for Decoded {
    fn from(pixels: Pixels) -> Self {
        Self { pixels, clipped: false }
    }
}

fn decode(bytes: &[u8], content: Content) -> Result<Decoded, String> {
    if bytes.starts_with(b"DDS ") {
        return dds::decode(bytes, content);
    }
    if bytes.starts_with(&::ktx2::MAGIC) {
        return ktx2::decode(bytes, content);
    }
    match guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::WebP | ImageFormat::Bmp)) => {
            decode_plain(bytes, format)
        }
        Ok(format) => Err(format!("is {format:?}; {KINDS} are read")),
        Err(_) if looks_like_tga(bytes) => decode_plain(bytes, ImageFormat::Tga),
        Err(_) => Err(format!("is none of {KINDS}")),
    }
}

fn decode_plain(bytes: &[u8], format: ImageFormat) -> Result<Decoded, String> {
    let broken = |e: ::image::ImageError| format!("cannot be decoded: {}", one_line(&e));
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(broken)?;
    let size = <[u32; 2]>::from(decoder.dimensions());
    check_size(size, decoder.color_type().bytes_per_pixel().into())?;
    let image = DynamicImage::from_decoder(decoder).map_err(broken)?;
    let has_alpha = image.color().has_alpha();
    Ok(Pixels { size, has_alpha, texels: into_rgba8(image) }.into())
}

/// Refuses, before anything of that size is allocated, what is empty or over [`MOST_BYTES`].
fn check_size([width, height]: [u32; 2], bytes_per_texel: u64) -> Result<(), String> {
    if width == 0 || height == 0 {
        return Err("has no texels".into());
    }
    let bytes = u128::from(width) * u128::from(height) * u128::from(bytes_per_texel.max(4));
    if bytes > MOST_BYTES.into() {
        let (mebibytes, most) = (bytes >> 20, MOST_BYTES >> 20);
        return Err(format!(
            "is {width}x{height} texels, {mebibytes} MiB decoded; at most {most} MiB are: scale it down"
        ));
    }
    Ok(())
}

/// TGA files begin with no signature: whether the header is one (Truevision TGA 2.0, section 'TGA file header').
fn looks_like_tga(bytes: &[u8]) -> bool {
    let Some(&[_, palette, kind, .., depth, _]) = bytes.first_chunk::<18>() else { return false };
    let palette_fits = match kind {
        1 | 9 => palette == 1,
        2 | 3 | 10 | 11 => palette <= 1,
        _ => false,
    };
    palette_fits && matches!(depth, 8 | 15 | 16 | 24 | 32)
}

fn into_rgba8(image: DynamicImage) -> Vec<u8> {
    match image {
        DynamicImage::ImageRgba8(image) => image.into_raw(),
        other => other.into_rgba8().into_raw(),
    }
}

fn one_line(error: &dyn std::error::Error) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Makes images from `jobs` on all cores; the order is kept, and of several errors the first is reported.
pub(super) fn make_all<J: Sync>(
    jobs: &[J],
    make: impl Fn(&J) -> Result<Image> + Send + Sync,
) -> Result<Vec<Image>> {
    // The largest images come anywhere: one job at a time keeps all cores busy to the end.
    let made: Vec<_> = jobs.par_iter().with_max_len(1).map(make).collect();
    made.into_iter().collect()
}

#[cfg(test)]
pub(super) mod tests {
    use ::image::{ImageBuffer, Luma, LumaA, Rgb, Rgba};

    use super::*;

    /// `image` as a file in `format`.
    pub fn encode(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image.into().write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    /// A PNG of `size` filled with one texel.
    pub fn png(size: [u32; 2], texel: [u8; 4]) -> Vec<u8> {
        encode(ImageBuffer::from_pixel(size[0], size[1], Rgba(texel)), ImageFormat::Png)
    }

    fn decode(bytes: &[u8]) -> Result<Pixels> {
        Encoded { name: "test", file: Path::new("test.gltf"), bytes }.decode(Content::Data)
    }

    fn message(bytes: &[u8]) -> String {
        decode(bytes).err().unwrap().to_string()
    }

    #[test]
    fn every_png_and_jpeg_layout_becomes_rgba8() {
        let format = ImageFormat::Png;
        let grey = ImageBuffer::from_pixel(2, 1, Luma([7_u8]));
        let grey_alpha = ImageBuffer::from_pixel(2, 1, LumaA([7_u8, 9]));
        let rgb16 = ImageBuffer::from_pixel(2, 1, Rgb([0x0707_u16, 0x4040, 0xffff]));
        let cases = [
            (encode(DynamicImage::ImageLuma8(grey), format), [7, 7, 7, 255], false),
            (encode(DynamicImage::ImageLumaA8(grey_alpha), format), [7, 7, 7, 9], true),
            (encode(DynamicImage::ImageRgb16(rgb16), format), [7, 0x40, 255, 255], false),
            (png([2, 1], [1, 2, 3, 4]), [1, 2, 3, 4], true),
        ];
        for (bytes, texel, has_alpha) in cases {
            let pixels = decode(&bytes).unwrap();
            assert_eq!((pixels.size, pixels.has_alpha), ([2, 1], has_alpha));
            assert_eq!(pixels.texels, texel.repeat(2));
        }
        let jpeg = ImageBuffer::from_pixel(16, 16, Rgb([200_u8, 100, 50]));
        let pixels = decode(&encode(DynamicImage::ImageRgb8(jpeg), ImageFormat::Jpeg)).unwrap();
        let close = pixels.texels[..3].iter().zip([200_u8, 100, 50]).all(|(a, b)| a.abs_diff(b) < 4);
        assert!(close && pixels.texels[3] == 255);
    }

    #[test]
    fn the_kind_is_told_by_content() {
        let rgba = ImageBuffer::from_fn(3, 2, |x, y| Rgba([x as u8, y as u8, 9, 200]));
        for format in [ImageFormat::Png, ImageFormat::WebP, ImageFormat::Tga, ImageFormat::Bmp] {
            let pixels = decode(&encode(rgba.clone(), format)).unwrap();
            assert_eq!((pixels.size, pixels.has_alpha), ([3, 2], true), "{format:?}");
            assert_eq!(pixels.texels, *rgba.as_raw(), "{format:?}");
        }
        assert_eq!(
            message(b"GIF89a"),
            "test.gltf: image test: is Gif; PNG, JPEG, WebP, TGA, BMP, DDS and KTX2 are read"
        );
    }

    #[test]
    fn broken_files_are_named() {
        let mut bytes = png([8, 8], [1, 2, 3, 4]);
        bytes.truncate(bytes.len() / 2);
        let text = message(&bytes);
        assert!(text.starts_with("test.gltf: image test: cannot be decoded"), "{text}");
        for bytes in [&b"what"[..], b"", b"a text that is longer than the header of a TGA file"] {
            let none = "test.gltf: image test: is none of PNG, JPEG, WebP, TGA, BMP, DDS and KTX2";
            assert_eq!(message(bytes), none);
        }
    }

    /// A PNG of 8-bit RGBA that ends where its texels begin.
    fn png_header(side: u32) -> Vec<u8> {
        let header = [&b"IHDR"[..], &side.to_be_bytes(), &side.to_be_bytes(), &[8, 6, 0, 0, 0]].concat();
        let mut sum = flate2::Crc::new();
        sum.update(&header);
        [b"\x89PNG\r\n\x1a\n\0\0\0\x0d", &header[..], &sum.sum().to_be_bytes(), b"\0\0\0\x10IDAT"].concat()
    }

    #[test]
    fn the_limit_on_memory_is_ours_and_named() {
        // 549 MiB, more than the decoder's own limit.
        let text = message(&png_header(12_000));
        assert!(!text.contains("imit"), "{text}");
        assert_eq!(
            message(&png_header(40_000)),
            "test.gltf: image test: is 40000x40000 texels, 6103 MiB decoded; at most 1024 MiB are: scale it down"
        );
        assert_eq!(check_size([16384, 16384], 4), Ok(()));
        assert!(check_size([16384, 16384], 8).is_err() && check_size([u32::MAX; 2], 16).is_err());
        assert_eq!(check_size([0, 5], 4), Err("has no texels".into()));
    }

    #[test]
    fn the_first_of_several_errors_is_reported() {
        let jobs: Vec<_> = (0..100).collect();
        let error = make_all(&jobs, |&i| match i {
            0..40 => Ok(Image::with_mips("", [1, 1], vec![0; 4], Content::Data)),
            _ => Err(Error::input(format!("image {i}"))),
        });
        assert_eq!(error.unwrap_err().to_string(), "image 40");
    }
}
