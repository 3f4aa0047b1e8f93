//! Compressed buffer views (EXT_meshopt_compression and KHR_meshopt_compression), decoded by meshoptimizer.

use meshopt::ffi;
use serde::Deserialize;

/// The names under which a buffer view says how it is compressed.
pub(super) const EXTENSIONS: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Bytes that one compressed byte can become at most: two bits stand for a column of 256 elements.
const MAX_EXPANSION: usize = 1024;

/// What the extension says of a buffer view.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Compressed {
    /// Index of a buffer of the document.
    pub buffer: u32,
    #[serde(default)]
    pub byte_offset: u64,
    pub byte_length: u64,
    byte_stride: usize,
    count: usize,
    mode: Mode,
    #[serde(default)]
    filter: Filter,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Filter {
    #[default]
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

impl Compressed {
    /// Decodes `bytes` to `count` elements of `byteStride` bytes.
    pub fn decode(&self, bytes: &[u8]) -> Result<Vec<u8>, String> {
        let (count, stride) = (self.count, self.byte_stride);
        self.check_stride()?;
        let size = count.checked_mul(stride).filter(|&size| size / MAX_EXPANSION <= bytes.len());
        let mut decoded = vec![0; size.ok_or("has more elements than its bytes can hold")?];
        let (target, source, length) = (decoded.as_mut_ptr().cast(), bytes.as_ptr(), bytes.len());
        // SAFETY: `target` holds `count * stride` bytes and `source` `length`; strides are as the decoders ask, and
        // they check what they read.
        let failed = unsafe {
            match self.mode {
                Mode::Attributes => ffi::meshopt_decodeVertexBuffer(target, count, stride, source, length),
                Mode::Triangles => ffi::meshopt_decodeIndexBuffer(target, count, stride, source, length),
                Mode::Indices => ffi::meshopt_decodeIndexSequence(target, count, stride, source, length),
            }
        };
        if failed != 0 {
            return Err("holds broken meshopt data".into());
        }
        // SAFETY: as above; filters change the elements in place.
        unsafe {
            match self.filter {
                Filter::None => {}
                Filter::Octahedral => ffi::meshopt_decodeFilterOct(target, count, stride),
                Filter::Quaternion => ffi::meshopt_decodeFilterQuat(target, count, stride),
                Filter::Exponential => ffi::meshopt_decodeFilterExp(target, count, stride),
                Filter::Color => ffi::meshopt_decodeFilterColor(target, count, stride),
            }
        }
        Ok(decoded)
    }

    /// What the decoders take for granted.
    fn check_stride(&self) -> Result<(), String> {
        let stride = self.byte_stride;
        let elements = match self.mode {
            Mode::Attributes => stride.is_multiple_of(4) && (4..=256).contains(&stride),
            Mode::Triangles => [2, 4].contains(&stride) && self.count.is_multiple_of(3),
            Mode::Indices => [2, 4].contains(&stride),
        };
        let filtered = match self.filter {
            Filter::None => true,
            Filter::Octahedral | Filter::Color => [4, 8].contains(&stride),
            Filter::Quaternion => stride == 8,
            Filter::Exponential => stride.is_multiple_of(4),
        };
        if elements && filtered && (self.mode == Mode::Attributes || self.filter == Filter::None) {
            return Ok(());
        }
        let (mode, filter, count) = (self.mode, self.filter, self.count);
        Err(format!("cannot have {count} elements of {stride} bytes in mode {mode:?} with filter {filter:?}"))
    }
}
