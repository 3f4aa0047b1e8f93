//! Accessors: typed, strided, sparse, normalised (glTF 2.0, section 3.6.2; KHR_mesh_quantization).

use std::ops::Range;

use gltf::json;
use json::accessor::ComponentType;
use json::validation::Checked;

use super::document::{Document, slice};

/// An accessor without a buffer view is all zeros, whatever its count: no memory backs it, so it is limited.
const MAX_ZEROS: u64 = 1 << 22;

/// A range-checked accessor.
pub(super) struct Accessor<'a> {
    /// Index of the accessor in the file.
    index: usize,
    /// Number of elements.
    pub count: usize,
    /// Components of an element.
    pub lanes: usize,
    component: ComponentType,
    normalized: bool,
    /// `None`: all zeros.
    base: Option<Elements<'a>>,
    sparse: Option<Sparse<'a>>,
}

/// Elements in memory; element i starts at `i * stride`, and all lie within `bytes`.
#[derive(Clone, Copy)]
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
}

/// Elements that replace others.
struct Sparse<'a> {
    /// Below the accessor's count.
    indices: Vec<u32>,
    values: Elements<'a>,
}

impl<'a> Accessor<'a> {
    /// The accessor at `index`, with all it refers to checked.
    pub fn new(document: &'a Document, index: json::Index<json::Accessor>) -> Result<Self, String> {
        let accessor = document.get(index)?;
        Self::checked(document, &accessor, index.value())
            .map_err(|message| format!("accessors[{}] {message}", index.value()))
    }

    fn checked(document: &'a Document, json: &json::Accessor, index: usize) -> Result<Self, String> {
        let Checked::Valid(component) = json.component_type else {
            return Err("has an unknown component type".into());
        };
        let Checked::Valid(dimensions) = json.type_ else { return Err("has an unknown type".into()) };
        let lanes = dimensions.multiplicity();
        let size = component.0.size() * lanes;
        let base = match json.buffer_view {
            None if json.count.0 > MAX_ZEROS => {
                return Err("has too many elements without a buffer view".into());
            }
            None => None,
            Some(view) => {
                let (bytes, stride) = document.view(view)?;
                let offset = json.byte_offset.unwrap_or_default().0;
                Some(elements(bytes, offset, json.count.0, size, stride)?)
            }
        };
        let count = json.count.0 as usize;
        let sparse = json.sparse.as_ref().map(|sparse| Sparse::checked(document, sparse, size, count));
        let sparse = sparse.transpose().map_err(|message| format!("(sparse) {message}"))?;
        Ok(Self { index, count, lanes, component: component.0, normalized: json.normalized, base, sparse })
    }

    /// An error unless elements have `lanes` components.
    pub fn expect_lanes(&self, lanes: usize) -> Result<(), String> {
        if self.lanes == lanes {
            return Ok(());
        }
        Err(format!("accessors[{}] has {} components an element instead of {lanes}", self.index, self.lanes))
    }

    /// An error unless there are `count` elements.
    pub fn expect_count(&self, count: usize) -> Result<(), String> {
        if self.count == count {
            return Ok(());
        }
        Err(format!("accessors[{}] has {} elements; POSITION has {count}", self.index, self.count))
    }

    /// Calls `put` with each element of `range`, counted from its start, as floats; again with a sparse value
    /// where there is one. `N` is the number of lanes.
    pub fn floats<const N: usize>(&self, range: Range<usize>, put: impl FnMut(usize, [f32; N])) {
        self.convert(range, self.normalized, put);
    }

    /// [`Accessor::floats`] that takes integers as fractions of their range even where the file does not say so.
    pub fn normalized_floats<const N: usize>(&self, range: Range<usize>, put: impl FnMut(usize, [f32; N])) {
        self.convert(range, true, put);
    }

    fn convert<const N: usize>(
        &self,
        range: Range<usize>,
        normalized: bool,
        mut put: impl FnMut(usize, [f32; N]),
    ) {
        let put = &mut put;
        match (self.component, normalized) {
            (ComponentType::F32, _) => self.walk(range, put, f32::from_le_bytes),
            (ComponentType::U32, _) => self.walk(range, put, |b| u32::from_le_bytes(b) as f32),
            (ComponentType::U8, false) => self.walk(range, put, |[b]: [u8; 1]| f32::from(b)),
            (ComponentType::I8, false) => self.walk(range, put, |b| f32::from(i8::from_le_bytes(b))),
            (ComponentType::U16, false) => self.walk(range, put, |b| f32::from(u16::from_le_bytes(b))),
            (ComponentType::I16, false) => self.walk(range, put, |b| f32::from(i16::from_le_bytes(b))),
            // glTF 2.0, section 3.11: the lowest signed value equals the one above it.
            (ComponentType::U8, true) => self.walk(range, put, |[b]: [u8; 1]| f32::from(b) / 255.0),
            (ComponentType::I8, true) => {
                self.walk(range, put, |b| (f32::from(i8::from_le_bytes(b)) / 127.0).max(-1.0));
            }
            (ComponentType::U16, true) => {
                self.walk(range, put, |b| f32::from(u16::from_le_bytes(b)) / 65535.0)
            }
            (ComponentType::I16, true) => {
                self.walk(range, put, |b| (f32::from(i16::from_le_bytes(b)) / 32767.0).max(-1.0));
            }
        }
    }

    /// All elements as vertex indices.
    pub fn indices(&self) -> Result<Vec<u32>, String> {
        self.expect_lanes(1)?;
        let mut indices = vec![0; self.count];
        let put = &mut |i: usize, [value]: [u32; 1]| indices[i] = value;
        match self.component {
            ComponentType::U8 => self.walk(0..self.count, put, |[b]: [u8; 1]| u32::from(b)),
            ComponentType::U16 => self.walk(0..self.count, put, |b| u32::from(u16::from_le_bytes(b))),
            ComponentType::U32 => self.walk(0..self.count, put, u32::from_le_bytes),
            _ => {
                return Err(format!(
                    "accessors[{}] holds indices that are not unsigned integers",
                    self.index
                ));
            }
        }
        Ok(indices)
    }

    fn walk<T: Copy + Default, const N: usize, const SIZE: usize>(
        &self,
        range: Range<usize>,
        put: &mut impl FnMut(usize, [T; N]),
        decode: impl Fn([u8; SIZE]) -> T,
    ) {
        let element = |from: Elements, i: usize| -> [T; N] {
            let (components, _) = from.bytes[i * from.stride..].as_chunks::<SIZE>();
            std::array::from_fn(|lane| decode(components[lane]))
        };
        for i in range.clone() {
            put(i - range.start, self.base.map_or([T::default(); N], |base| element(base, i)));
        }
        let Some(sparse) = &self.sparse else { return };
        for (i, &target) in sparse.indices.iter().enumerate() {
            if range.contains(&(target as usize)) {
                put(target as usize - range.start, element(sparse.values, i));
            }
        }
    }
}

impl<'a> Sparse<'a> {
    fn checked(
        document: &'a Document,
        json: &json::accessor::sparse::Sparse,
        size: usize,
        count: usize,
    ) -> Result<Self, String> {
        let Checked::Valid(component) = json.indices.component_type else {
            return Err("has an unknown index type".into());
        };
        let (bytes, stride) = document.view(json.indices.buffer_view)?;
        let places = elements(bytes, json.indices.byte_offset.0, json.count.0, component.0.size(), stride)?;
        let (bytes, stride) = document.view(json.values.buffer_view)?;
        let values = elements(bytes, json.values.byte_offset.0, json.count.0, size, stride)?;
        let places = Accessor {
            index: 0,
            count: json.count.0 as usize,
            lanes: 1,
            component: component.0,
            normalized: false,
            base: Some(places),
            sparse: None,
        };
        let indices = places.indices()?;
        match indices.iter().find(|&&i| i as usize >= count) {
            Some(index) => Err(format!("replaces element {index} of {count}")),
            None => Ok(Self { indices, values }),
        }
    }
}

/// `count` elements of `size` bytes from `offset`, if they lie within `bytes`.
fn elements(
    bytes: &[u8],
    offset: u64,
    count: u64,
    size: usize,
    stride: Option<usize>,
) -> Result<Elements<'_>, String> {
    let stride = stride.unwrap_or(size);
    let length = match count {
        0 => Some(0),
        _ => (count - 1).checked_mul(stride as u64).and_then(|bytes| bytes.checked_add(size as u64)),
    };
    length
        .and_then(|length| slice(bytes, offset, length))
        .map(|bytes| Elements { bytes, stride })
        .ok_or_else(|| format!("reaches beyond the {} bytes of its buffer view", bytes.len()))
}
