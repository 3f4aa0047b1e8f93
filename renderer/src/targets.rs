//! What views are rendered into: depth, and colour targets that are declared once by name. Their images, the formats of the
//! pipelines that draw into them, resolving and reading back follow from the names.
//!
//! ```text
//! passes name targets ──draw──> drawn (all samples) ──resolve (MSAA)──> resolved ──copy──> host
//! ```

use crate::vk::texel_bytes;
use ash::vk;

/// Format of every view's depth.
pub const DEPTH_FORMAT: vk::Format = vk::Format::D32_SFLOAT;

/// What a colour target is.
#[derive(Debug, Clone, Copy)]
pub struct TargetInfo {
    /// Name of the target's images.
    pub name: &'static str,
    /// Format of the target's texels.
    pub format: vk::Format,
    /// What the target's images are used for, more than being drawn into and resolved.
    pub usage: vk::ImageUsageFlags,
    /// Whether MSAA's samples are averaged into an image with one sample a pixel.
    pub resolved: bool,
}

/// Declares the names and what they name.
macro_rules! targets {
    ($($(#[$doc:meta])* $name:ident = $info:expr;)+) => {
        /// A colour target of every view.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        #[repr(u32)]
        pub enum TargetName { $($(#[$doc])* $name),+ }

        impl TargetName {
            /// All colour targets.
            pub const ALL: [Self; TARGET_COUNT] = [$(Self::$name),+];
        }

        /// How many colour targets there are.
        pub const TARGET_COUNT: usize = [$(stringify!($name)),+].len();

        static TARGETS: [TargetInfo; TARGET_COUNT] = [$($info),+];
    };
}

/// A target of a G-buffer, which shaders read sample by sample.
const fn kept(name: &'static str, format: vk::Format) -> TargetInfo {
    TargetInfo { name, format, usage: vk::ImageUsageFlags::SAMPLED, resolved: false }
}

targets! {
    /// Radiance towards the camera, linear, without an upper bound; alpha is how much of the pixel surfaces cover.
    Radiance = TargetInfo {
        name: "radiance",
        format: vk::Format::R16G16B16A16_SFLOAT,
        usage: vk::ImageUsageFlags::TRANSFER_SRC,
        resolved: true,
    };
    /// Of a G-buffer: base colour, and metalness in alpha.
    BaseColor = kept("base_color", vk::Format::R8G8B8A8_SRGB);
    /// Of a G-buffer: the shading normal in the world, a point of the octahedron.
    Normal = kept("normal", vk::Format::R16G16_SNORM);
    /// Of a G-buffer: perceptual roughness; 0 says that no light is evaluated.
    Roughness = kept("roughness", vk::Format::R16_UNORM);
    /// Of a G-buffer: the index of the model that is seen.
    Model = kept("model", vk::Format::R32_UINT);
}

/// What fills a G-buffer draws into, for methods that ask for the model as well, and for others.
pub fn filled(with_model: bool) -> &'static [TargetName] {
    use TargetName as T;
    match with_model {
        true => &[T::Radiance, T::BaseColor, T::Normal, T::Roughness, T::Model],
        false => &[T::Radiance, T::BaseColor, T::Normal, T::Roughness],
    }
}

/// The part of the include that tells shaders where a view's colour targets are bound: behind its depth, which is binding 0.
pub fn glsl() -> String {
    let binding =
        |name: TargetName| format!("#define TARGET_{} {}\n", name.info().name.to_uppercase(), name.binding());
    TargetName::ALL.map(binding).concat()
}

impl TargetName {
    /// All that is declared of the target.
    pub fn info(self) -> &'static TargetInfo {
        &TARGETS[self as usize]
    }

    /// Where the descriptor set of a view's targets binds it.
    pub fn binding(self) -> u32 {
        self as u32 + 1
    }

    /// Whether shaders sample it.
    pub fn is_sampled(self) -> bool {
        self.info().usage.contains(vk::ImageUsageFlags::SAMPLED)
    }

    /// Bytes of a view's texels, one a pixel, at a width and height.
    pub fn view_bytes(self, [width, height]: [u32; 2]) -> u64 {
        texel_bytes(self.info().format) * u64::from(width) * u64::from(height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gbuffer_takes_ten_bytes_a_sample_and_four_for_models() {
        let bytes =
            |with_model| filled(with_model)[1..].iter().map(|name| name.view_bytes([1, 1])).sum::<u64>();
        assert_eq!((bytes(false), bytes(true)), (10, 14));
    }
}
