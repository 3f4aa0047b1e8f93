//! Images: decoding PNG and JPEG on all cores, into mip chains.

use std::io::Cursor;
use std::path::Path;

use ::image::{DynamicImage, ImageFormat, ImageReader};
use rayon::prelude::*;

use super::{Image, mips};
use crate::{Error, Result};

/// What the texels of an image mean, which decides how its mips are averaged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Content {
    /// sRGB colour and linear alpha.
    Color {
        /// 8-bit alpha cut-off of the masked material that reads it: its mips keep the share of texels above.
        cutoff: Option<u8>,
    },
    /// Linear numbers.
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
    /// What it is called in messages and in [`Image::name`].
    pub name: &'a str,
    /// The file to blame if it is broken.
    pub file: &'a Path,
    /// PNG or JPEG.
    pub bytes: &'a [u8],
}

impl Encoded<'_> {
    /// Decodes to RGBA texels: grey becomes equal RGB, 16 bits are rounded to 8.
    pub fn decode(&self) -> Result<Pixels> {
        let fail = |what: String| Error::file(self.file, format!("image {}: {what}", self.name));
        let reader = ImageReader::new(Cursor::new(self.bytes)).with_guessed_format();
        let reader = reader.map_err(|e| fail(e.to_string()))?;
        if !matches!(reader.format(), Some(ImageFormat::Png | ImageFormat::Jpeg)) {
            return Err(fail("neither PNG nor JPEG".into()));
        }
        let image = reader.decode().map_err(|e| fail(format!("cannot be decoded: {}", one_line(&e))))?;
        let has_alpha = image.color().has_alpha();
        let size = [image.width(), image.height()];
        if size.contains(&0) {
            return Err(fail("has no texels".into()));
        }
        Ok(Pixels { size, has_alpha, texels: into_rgba8(image) })
    }
}

/// A decoded image.
pub(super) struct Pixels {
    /// Width, height.
    pub size: [u32; 2],
    /// The file had an alpha channel.
    pub has_alpha: bool,
    /// Row-major RGBA.
    pub texels: Vec<u8>,
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
        Encoded { name: "test", file: Path::new("test.gltf"), bytes }.decode()
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
    fn broken_files_are_named() {
        let mut bytes = png([8, 8], [1, 2, 3, 4]);
        bytes.truncate(bytes.len() / 2);
        let message = decode(&bytes).err().unwrap().to_string();
        assert!(message.starts_with("test.gltf: image test: cannot be decoded"), "{message}");
        let message = decode(b"GIF89a").err().unwrap().to_string();
        assert_eq!(message, "test.gltf: image test: neither PNG nor JPEG");
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
