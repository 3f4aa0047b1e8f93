//! Scenes as data: vertices, instances, materials, images and lights, with no word of Vulkan.
//!
//! Units are metres, right-handed, +Y up, counter-clockwise front faces. Every loader ([`gltf`], [`obj`])
//! and generator ([`procedural`]) ends in one [`Scene`].

mod check;
pub mod describe;
pub mod gltf;
pub mod image;
mod mesh;
mod mips;
pub mod obj;
pub mod procedural;
mod source;
mod tangents;

use std::path::Path;

use bytemuck::{Pod, Zeroable};
use glam::{DMat4, DVec3, Vec3};

use crate::lights::Spot;
use crate::{Error, Result};

/// One vertex, as the GPU reads it (60 bytes, scalar layout).
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    /// Position in object space, metres.
    pub position: [f32; 3],
    /// Unit normal in object space.
    pub normal: [f32; 3],
    /// Object-space unit tangent and, in w, the sign of the bitangent (glTF convention).
    pub tangent: [f32; 4],
    /// Two texture coordinate sets; [`TextureRef::uv_set`] picks one.
    pub uv: [[f32; 2]; 2],
    /// Linear vertex colour and alpha, 8-bit unorm.
    pub color: [u8; 4],
}

/// Axis-aligned bounds, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Lowest corner of the box.
    pub min: Vec3,
    /// Highest corner of the box.
    pub max: Vec3,
}

/// A range of indices drawn with one material.
#[derive(Debug, Clone, PartialEq)]
pub struct Primitive {
    /// First of its indices in [`Scene::indices`].
    pub first_index: u32,
    /// Number of indices; they make triangles, so it is a multiple of three.
    pub index_count: u32,
    /// What is added to every index to find its vertex.
    pub vertex_offset: u32,
    /// Number of vertices from `vertex_offset` on that the primitive owns.
    pub vertex_count: u32,
    /// Index into [`Scene::materials`].
    pub material: u32,
    /// Bounds of the primitive in object space.
    pub bounds: Bounds,
}

/// A primitive placed in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instance {
    /// Index into [`Scene::primitives`].
    pub primitive: u32,
    /// Affine transform; may mirror (negative determinant). In f64: a place far from the world's origin must not move by
    /// the rounding of f32.
    pub world_from_object: DMat4,
}

/// What a material's alpha means (glTF 2.0, section 3.9.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AlphaMode {
    /// Alpha is ignored.
    Opaque,
    /// A fragment below the cut-off is discarded.
    Mask,
    /// Blended over what lies behind.
    Blend,
}

/// Place of a texture among the five of a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextureSlot {
    /// Base colour and alpha, sRGB.
    BaseColor = 0,
    /// Linear: roughness in G, metalness in B.
    MetallicRoughness = 1,
    /// Tangent-space normal, linear.
    Normal = 2,
    /// Occlusion in R, linear.
    Occlusion = 3,
    /// Radiance, sRGB.
    Emissive = 4,
}

/// Metallic-roughness material (glTF 2.0, section 3.9).
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the source, for messages and debug labels.
    pub name: String,
    /// Linear base colour and alpha.
    pub base_color: [f32; 4],
    /// 0 dielectric to 1 metal.
    pub metallic: f32,
    /// Perceptual roughness of the surface, 0 to 1.
    pub roughness: f32,
    /// Linear radiance, emissive strength multiplied in.
    pub emissive: [f32; 3],
    /// Scale of the normal map's x and y.
    pub normal_scale: f32,
    /// 0 no occlusion to 1 full.
    pub occlusion_strength: f32,
    /// Whether the material is opaque, masked or blended.
    pub alpha_mode: AlphaMode,
    /// Below this alpha a masked fragment is discarded.
    pub alpha_cutoff: f32,
    /// Drawn without back-face culling, with the normal turned to the viewer.
    pub double_sided: bool,
    /// Radiates its base colour and is not lit (KHR_materials_unlit).
    pub unlit: bool,
    /// Textures by [`TextureSlot`].
    pub textures: [Option<TextureRef>; 5],
}

/// A texture as a material uses it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureRef {
    /// Index into [`Scene::images`].
    pub image: u32,
    /// How texels are filtered, and coordinates wrapped.
    pub sampler: Sampler,
    /// Index into [`Vertex::uv`], 0 or 1.
    pub uv_set: u32,
    /// Rows of the affine map applied to the coordinates: u' = row0 . (u, v, 1), v' = row1 . (u, v, 1).
    pub uv_transform: [[f32; 3]; 2],
}

/// Filter and wrap modes of one texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// How coordinates beyond 0..1 are read, horizontally and vertically.
    pub wrap: [Wrap; 2],
    /// Nearest instead of (anisotropic, mip-mapped) linear filtering.
    pub nearest: bool,
}

/// What a texture shows outside of coordinates 0..1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The image is repeated.
    Repeat,
    /// Tiles, every other one mirrored.
    Mirror,
    /// The edge of the image goes on.
    Clamp,
}

/// A decoded image with its whole mip chain, RGBA 8-bit.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// File name or name in the source.
    pub name: String,
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// RGB is sRGB-encoded (else linear); alpha is always linear. Mips are averaged in linear light.
    pub srgb: bool,
    /// `mips[0]` is the full image, each next one half (rounded down, at least 1) down to 1x1; row-major RGBA.
    pub mips: Vec<Vec<u8>>,
}

/// A point or spot light that a scene brings along (KHR_lights_punctual).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneLight {
    /// Place of the light in the world, metres.
    pub position: Vec3,
    /// Linear colour, as in the file.
    pub color: [f32; 3],
    /// Luminous intensity as in the file (candela).
    pub intensity: f32,
    /// The file's cut-off distance, if any.
    pub range: Option<f32>,
    /// The cone that it shines into, if it is a spot.
    pub spot: Option<Spot>,
}

impl SceneLight {
    /// Whether all numbers of the light are finite.
    pub(crate) fn is_finite(&self) -> bool {
        let numbers = [self.intensity, self.range.unwrap_or_default()];
        let cone =
            self.spot.map_or([0.0; 5], |Spot { direction: [x, y, z], inner, outer }| [x, y, z, inner, outer]);
        self.position.is_finite() && self.color.iter().chain(&numbers).chain(&cone).all(|x| x.is_finite())
    }
}

/// Everything that can be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Built-in name or file stem.
    pub name: String,
    /// Hex SHA-256 over the source bytes (all files read, in order), or over generator name and version.
    pub sha256: String,
    /// Vertices of all primitives.
    pub vertices: Vec<Vertex>,
    /// All primitives' indices, relative to [`Primitive::vertex_offset`].
    pub indices: Vec<u32>,
    /// Index ranges with a material each.
    pub primitives: Vec<Primitive>,
    /// What is drawn, in source order.
    pub instances: Vec<Instance>,
    /// Materials, at least one (a default is made where the source has none).
    pub materials: Vec<Material>,
    /// Decoded images; one used both as colour and as data appears twice.
    pub images: Vec<Image>,
    /// Point lights of the source.
    pub lights: Vec<SceneLight>,
    /// What of the source is not drawn, or not as the source has it: a line a kind.
    pub warnings: Vec<String>,
}

/// Reads a scene file: glTF 2.0 (.gltf, .glb) or Wavefront OBJ (.obj), told apart by extension. Odd lines of OBJ and
/// MTL are warnings.
///
/// # Errors
/// One line that names the file and what is wrong with it: unreadable, corrupt, not supported, empty.
pub fn load(path: &Path) -> Result<Scene> {
    read(path, false)
}

/// Loads a scene as [`load`] does, but the first odd line of an OBJ or MTL file is an error.
///
/// # Errors
/// As [`load`].
pub fn load_strictly(path: &Path) -> Result<Scene> {
    read(path, true)
}

fn read(path: &Path, strict: bool) -> Result<Scene> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let scene = match extension.as_str() {
        "gltf" | "glb" => gltf::load(path),
        "obj" => obj::load(path, strict),
        _ => Err(Error::file(path, "is not a scene: give a .gltf, .glb or .obj file")),
    }?;
    for warning in &scene.warnings {
        tracing::warn!("{}: {warning}", path.display());
    }
    scene.check().map_err(|message| Error::file(path, message))?;
    Ok(scene)
}

/// The name of a scene read from `path`.
fn file_stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

impl Material {
    /// What glTF gives a primitive without a material (glTF 2.0, section 3.9.7): white, rough metal.
    pub fn plain(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            base_color: [1.0; 4],
            metallic: 1.0,
            roughness: 1.0,
            emissive: [0.0; 3],
            normal_scale: 1.0,
            occlusion_strength: 1.0,
            alpha_mode: AlphaMode::Opaque,
            alpha_cutoff: 0.5,
            double_sided: false,
            unlit: false,
            textures: [None; 5],
        }
    }

    /// The alpha, 0 to 255, from which on a texel of a masked material's base colour texture is kept
    /// (vertex colours aside); `None` where alpha masks nothing.
    fn texture_cutoff(&self) -> Option<u8> {
        let masked = self.alpha_mode == AlphaMode::Mask && self.base_color[3] > 0.0;
        masked.then(|| (self.alpha_cutoff / self.base_color[3] * 255.0).ceil().clamp(1.0, 255.0) as u8)
    }
}

impl TextureRef {
    /// The rows of the map that leaves coordinates as they are.
    pub const IDENTITY: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
}

impl Scene {
    /// A scene without content.
    fn empty(name: String) -> Self {
        Self {
            name,
            sha256: String::new(),
            vertices: Vec::new(),
            indices: Vec::new(),
            primitives: Vec::new(),
            instances: Vec::new(),
            materials: Vec::new(),
            images: Vec::new(),
            lights: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Triangles drawn, instances counted each time.
    pub fn triangle_count(&self) -> u64 {
        self.instances.iter().map(|i| u64::from(self.primitives[i.primitive as usize].index_count) / 3).sum()
    }

    /// World-space bounds of all instances; `None` for an empty scene.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let boxes = self.instances.iter().map(|instance| self.bounds_of(instance));
        boxes.reduce(|(low, high), (lower, higher)| (low.min(lower), high.max(higher)))
    }

    /// World-space bounds of the box around an instance's primitive.
    pub fn bounds_of(&self, instance: &Instance) -> (DVec3, DVec3) {
        let bounds = self.primitives[instance.primitive as usize].bounds;
        let corner = |corner: u32| {
            let pick = |axis: usize| {
                if corner >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] }
            };
            instance.world_from_object.transform_point3(Vec3::new(pick(0), pick(1), pick(2)).as_dvec3())
        };
        let first = corner(0);
        (1..8).map(corner).fold((first, first), |(low, high), at| (low.min(at), high.max(at)))
    }
}
