//! From chunks to a scene: primitives, instances, the materials and images that are in use.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;
use rayon::prelude::*;
use sha2::{Digest, Sha256};

use super::maths::Place;
use super::mesh::{Chunk, Mesh};
use super::palette::{Look, Surface};
use super::patterns::Pattern;
use super::texture::PatternImages;
use crate::scene::{
    AlphaMode, Bounds, Image, Instance, Material, Primitive, Sampler, Scene, TextureRef, TextureSlot, Vertex,
    Wrap,
};

/// Raise it whenever a generator or a texture changes, so that results of different scenes are told apart.
const GENERATOR_VERSION: u32 = 1;

/// Collects chunks and their placements.
#[derive(Default)]
pub(super) struct Builder {
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
    primitives: Vec<(Surface, Primitive)>,
    instances: Vec<Instance>,
}

/// A chunk that has become primitives and can be placed many times.
pub(super) struct Model(std::ops::Range<u32>);

impl Builder {
    /// Stores the chunk's triangles once.
    pub(super) fn model(&mut self, chunk: Chunk) -> Model {
        let first = self.primitives.len() as u32;
        for (surface, mesh) in chunk.into_parts() {
            self.primitive(surface, &mesh);
        }
        Model(first..self.primitives.len() as u32)
    }

    /// Draws a model at `place`.
    pub(super) fn place(&mut self, model: &Model, place: &Place) {
        let world_from_object = place.matrix().as_dmat4();
        self.instances.extend(model.0.clone().map(|primitive| Instance { primitive, world_from_object }));
    }

    /// Draws a model at a point, turned about the vertical by `turns`.
    pub(super) fn put(&mut self, model: &Model, [x, y, z]: [f32; 3], turns: f64) {
        self.place(model, &Place::at(x, y, z).turned(turns));
    }

    /// Stores and draws a chunk that occurs once.
    pub(super) fn add(&mut self, chunk: Chunk, place: &Place) {
        let model = self.model(chunk);
        self.place(&model, place);
    }

    fn primitive(&mut self, surface: Surface, mesh: &Mesh) {
        let points = || mesh.vertices.iter().map(|vertex| Vec3::from(vertex.position));
        let primitive = Primitive {
            first_index: self.indices.len() as u32,
            index_count: mesh.indices.len() as u32,
            vertex_offset: self.vertices.len() as u32,
            vertex_count: mesh.vertices.len() as u32,
            material: 0,
            bounds: Bounds {
                min: points().fold(Vec3::INFINITY, Vec3::min),
                max: points().fold(Vec3::NEG_INFINITY, Vec3::max),
            },
        };
        self.vertices.extend_from_slice(&mesh.vertices);
        self.indices.extend_from_slice(&mesh.indices);
        self.primitives.push((surface, primitive));
    }

    /// Hex SHA-256 over the scene's name, the generator's version and the placed geometry, little-endian.
    fn digest(&self, name: &str) -> String {
        let mut hash = Sha256::new();
        hash.update(format!("manylight {name} {GENERATOR_VERSION}\n"));
        hash.update(bytemuck::cast_slice::<_, u8>(&self.vertices));
        hash.update(bytemuck::cast_slice::<_, u8>(&self.indices));
        for instance in &self.instances {
            hash.update(instance.primitive.to_le_bytes());
            hash.update(bytemuck::bytes_of(&instance.world_from_object.as_mat4()));
        }
        hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// The finished scene.
    pub(super) fn finish(self, name: &str) -> Scene {
        let sha256 = self.digest(name);
        let surfaces: BTreeSet<Surface> = self.primitives.iter().map(|(surface, _)| *surface).collect();
        let surfaces: Vec<Surface> = surfaces.into_iter().collect();
        let (images, sets) = bake_patterns(&surfaces);
        let primitives = self
            .primitives
            .into_iter()
            .map(|(surface, primitive)| Primitive {
                material: surfaces.partition_point(|other| *other < surface) as u32,
                ..primitive
            })
            .collect();
        Scene {
            name: name.to_owned(),
            sha256,
            vertices: self.vertices,
            indices: self.indices,
            primitives,
            instances: self.instances,
            materials: surfaces.iter().map(|surface| material(*surface, &sets)).collect(),
            images,
            lights: Vec::new(),
            warnings: Vec::new(),
        }
    }
}

/// Where a pattern's images lie in the scene.
#[derive(Clone, Copy)]
struct ImageSet {
    base_color: u32,
    surface: u32,
    normal: u32,
    emissive: Option<u32>,
}

fn bake_patterns(surfaces: &[Surface]) -> (Vec<Image>, BTreeMap<Pattern, ImageSet>) {
    let patterns: BTreeSet<Pattern> = surfaces.iter().map(|surface| surface.look().pattern).collect();
    let patterns: Vec<Pattern> = patterns.into_iter().collect();
    let baked: Vec<PatternImages> = patterns.par_iter().map(|pattern| pattern.bake()).collect();
    let mut images = Vec::new();
    let mut push = |image: Image| {
        images.push(image);
        images.len() as u32 - 1
    };
    let sets = patterns
        .into_iter()
        .zip(baked)
        .map(|(pattern, set)| {
            let set = ImageSet {
                base_color: push(set.base_color),
                surface: push(set.surface),
                normal: push(set.normal),
                emissive: set.emissive.map(&mut push),
            };
            (pattern, set)
        })
        .collect();
    (images, sets)
}

fn material(surface: Surface, sets: &BTreeMap<Pattern, ImageSet>) -> Material {
    let look: Look = surface.look();
    let set = sets[&look.pattern];
    let texture = |image: u32| {
        let scale = 1.0 / look.tile;
        Some(TextureRef {
            image,
            sampler: Sampler { wrap: [Wrap::Repeat; 2], nearest: false },
            uv_set: 0,
            uv_transform: [[scale, 0.0, 0.0], [0.0, scale, 0.0]],
        })
    };
    let mut textures = [None; 5];
    textures[TextureSlot::BaseColor as usize] = texture(set.base_color);
    textures[TextureSlot::MetallicRoughness as usize] = texture(set.surface);
    textures[TextureSlot::Normal as usize] = texture(set.normal);
    textures[TextureSlot::Occlusion as usize] = texture(set.surface);
    textures[TextureSlot::Emissive as usize] = set.emissive.filter(|_| look.emissive > 0.0).and_then(texture);
    let [r, g, b] = look.color;
    Material {
        name: format!("{surface:?}").to_lowercase(),
        base_color: [r, g, b, 1.0],
        metallic: look.metal_rough[0],
        roughness: look.metal_rough[1],
        emissive: [look.emissive; 3],
        normal_scale: 1.0,
        occlusion_strength: 1.0,
        alpha_mode: look.alpha,
        // Low, so that cut-outs keep their coverage in the averaged alpha of the coarse mips.
        alpha_cutoff: if look.alpha == AlphaMode::Mask { 0.35 } else { 0.5 },
        double_sided: look.double_sided,
        unlit: false,
        textures,
    }
}
