//! What is declared of a buffer.

use super::{BufferName, ClusteringSizes};
use crate::gpu_types::StructInfo;
use crate::measure::Purpose;
use ash::vk;
use std::fmt::Write as _;

/// Who makes a buffer, and who writes it when.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// A frame in flight; the host writes it before the frame.
    Frame,
    /// The scene; written between frames.
    Scene,
    /// All clusterings of a session; the device writes it in the frame.
    Session,
    /// An engine; the device writes it in the frame.
    Engine,
    /// A clustering; the device writes it in the frame.
    Clustering,
    /// A clustering, once for each frame in flight; the host writes it before the frame.
    ClusteringFrame,
}

/// A way for shaders to read a buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum BufferView {
    /// Storage buffer: read and written in any order.
    Storage,
    /// Texel view, read with an index of each thread's own: llvmpipe fetches a texel for all lanes at once, where it
    /// takes storage buffers lane by lane and word by word.
    Texels,
    /// Uniform buffer, read alike by all threads: llvmpipe reads a word once for all lanes, also where the flow of
    /// control has parted.
    Uniform,
}

impl BufferView {
    /// All ways, in the order of their bindings.
    pub const ALL: [Self; 3] = [Self::Storage, Self::Texels, Self::Uniform];
    /// How many ways of viewing a buffer there are.
    pub const COUNT: u32 = Self::ALL.len() as u32;

    /// Type of descriptor that a set holds for the view.
    pub fn descriptor(self) -> vk::DescriptorType {
        match self {
            Self::Storage => vk::DescriptorType::STORAGE_BUFFER,
            Self::Texels => vk::DescriptorType::UNIFORM_TEXEL_BUFFER,
            Self::Uniform => vk::DescriptorType::UNIFORM_BUFFER,
        }
    }
}

/// What an array that is read as texels has for elements.
#[derive(Debug, Clone, Copy)]
pub enum Element {
    /// A `uint`.
    Word,
    /// A `uint` of 16 bits.
    Half,
    /// Four `uint`s of 8 bits: a `uvec4`.
    Bytes,
    /// Two `uint`s: a `uvec2`.
    Pair,
    /// A struct that fills its texels of four words.
    Struct(StructInfo),
}

/// A view of a buffer as an array of texels.
#[derive(Debug, Clone, Copy)]
pub struct Texels {
    /// The view is `<stem>_texels`, an element is `read_<stem>(index)`.
    pub stem: &'static str,
    /// What one read of the view gives.
    pub element: Element,
}

impl Texels {
    /// The format of a texel.
    pub fn format(&self) -> vk::Format {
        match &self.element {
            Element::Word => vk::Format::R32_UINT,
            Element::Half => vk::Format::R16_UINT,
            Element::Bytes => vk::Format::R8G8B8A8_UINT,
            Element::Pair => vk::Format::R32G32_UINT,
            Element::Struct(info) if !info.is_float() => vk::Format::R32G32B32A32_UINT,
            Element::Struct(_) => vk::Format::R32G32B32A32_SFLOAT,
        }
    }

    /// The function that reads an element.
    fn reader(&self) -> String {
        let (name, view) = (format!("read_{}", self.stem), format!("{}_texels", self.stem));
        let (kind, parts) = match &self.element {
            Element::Word | Element::Half => ("uint", "x"),
            Element::Bytes => ("uvec4", "xyzw"),
            Element::Pair => ("uvec2", "xy"),
            Element::Struct(info) => return info.reader(&name, &view),
        };
        format!("{kind} {name}(uint index) {{ return texelFetch({view}, int(index)).{parts}; }}\n")
    }
}

/// What is declared of a buffer.
#[derive(Debug, Clone, Copy)]
pub struct BufferInfo {
    /// In messages, debug names and growth events; that of its member in GLSL, where it has one.
    pub name: &'static str,
    /// Who makes and writes the buffer.
    pub owner: Owner,
    /// GLSL members of the storage buffer.
    pub storage: Option<&'static str>,
    /// How the buffer is viewed as texels; `None` where it is not.
    pub texels: Option<Texels>,
    /// GLSL member of the uniform buffer.
    pub uniform: Option<&'static str>,
    /// What the buffer is for.
    pub purpose: Purpose,
    /// Size in bytes, where a clustering's sizes decide; 0 where the way at hand leaves the buffer empty.
    pub size: Option<fn(&ClusteringSizes) -> u64>,
}

/// A buffer, of which nothing more is known yet; it serves the building of lists unless it says otherwise.
pub(super) const fn buffer(name: &'static str, owner: Owner) -> BufferInfo {
    BufferInfo {
        name,
        owner,
        storage: None,
        texels: None,
        uniform: None,
        purpose: Purpose::Building,
        size: None,
    }
}

/// Size in bytes of `count` values.
pub(super) const fn bytes<T>(count: u64) -> u64 {
    size_of::<T>() as u64 * count
}

impl BufferInfo {
    pub(super) const fn storage(mut self, members: &'static str) -> Self {
        self.storage = Some(members);
        self
    }

    pub(super) const fn texels(mut self, stem: &'static str, element: Element) -> Self {
        self.texels = Some(Texels { stem, element });
        self
    }

    pub(super) const fn uniform(mut self, member: &'static str) -> Self {
        self.uniform = Some(member);
        self
    }

    pub(super) const fn serving(mut self, purpose: Purpose) -> Self {
        self.purpose = purpose;
        self
    }

    pub(super) const fn sized(mut self, size: fn(&ClusteringSizes) -> u64) -> Self {
        self.size = Some(size);
        self
    }

    /// Whether the buffer stays as it is while a frame runs, so that no pass waits for it.
    pub fn is_constant(&self) -> bool {
        matches!(self.owner, Owner::Frame | Owner::Scene | Owner::ClusteringFrame)
    }

    /// What the buffer may be used for besides its views: copied, filled and dispatched from, unless it is constant.
    pub fn usage(&self) -> vk::BufferUsageFlags {
        use vk::BufferUsageFlags as U;
        let views = [
            (self.storage.is_some(), U::STORAGE_BUFFER),
            (self.texels.is_some(), U::UNIFORM_TEXEL_BUFFER),
            (self.uniform.is_some(), U::UNIFORM_BUFFER),
            (!self.is_constant(), U::TRANSFER_SRC | U::TRANSFER_DST | U::INDIRECT_BUFFER),
        ];
        views.into_iter().filter(|view| view.0).fold(U::empty(), |usage, view| usage | view.1)
    }
}

impl BufferName {
    /// Declarations of the buffer in GLSL, one for each view.
    pub(super) fn glsl(self) -> String {
        let info = self.info();
        let layout = |view| format!("layout(set = SET_BUFFERS, binding = {}", self.binding(view));
        let mut text = String::new();
        if let Some(members) = info.storage {
            let access = if info.is_constant() { "readonly " } else { "" };
            let layout = layout(BufferView::Storage);
            let _ = writeln!(text, "{layout}, scalar) {access}buffer {self:?}Buffer {{ {members}; }};");
        }
        if let Some(texels) = &info.texels {
            let sign = if texels.format() == vk::Format::R32G32B32A32_SFLOAT { "" } else { "u" };
            let _ = writeln!(
                text,
                "{}) uniform {sign}textureBuffer {}_texels;",
                layout(BufferView::Texels),
                texels.stem
            );
            text.push_str(&texels.reader());
        }
        if let Some(member) = info.uniform {
            let _ = writeln!(
                text,
                "{}, scalar) uniform {self:?}Uniform {{ {member}; }};",
                layout(BufferView::Uniform)
            );
        }
        text
    }
}
