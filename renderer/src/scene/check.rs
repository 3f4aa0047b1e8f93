//! The promises of a [`Scene`] that its users rely on, checked in one place.

use super::{Image, Material, Primitive, Scene};
use crate::{Error, Result};

impl Scene {
    /// Checks that every index and range lies within what it points into, that every number is finite and
    /// that there is something to draw.
    ///
    /// # Errors
    /// [`Error::Input`] naming the scene and the first thing wrong.
    pub fn validate(&self) -> Result<()> {
        self.check().map_err(|message| Error::input(format!("scene {}: {message}", self.name)))
    }

    /// [`Scene::validate`] with a message that does not name the scene.
    pub(super) fn check(&self) -> Result<(), String> {
        for (i, image) in self.images.iter().enumerate() {
            check_image(image).map_err(|m| format!("image {i} ({}) {m}", image.name))?;
        }
        for (i, material) in self.materials.iter().enumerate() {
            self.check_material(material).map_err(|m| format!("material {i} ({}) {m}", material.name))?;
        }
        for (i, primitive) in self.primitives.iter().enumerate() {
            self.check_primitive(primitive).map_err(|m| format!("primitive {i} {m}"))?;
        }
        for (i, instance) in self.instances.iter().enumerate() {
            if instance.primitive as usize >= self.primitives.len() {
                return Err(format!(
                    "instance {i} draws primitive {}, which is not there",
                    instance.primitive
                ));
            }
            if !instance.world_from_object.as_mat4().is_finite() {
                return Err(format!("instance {i} has a transform that is not finite"));
            }
        }
        if let Some(light) = self.lights.iter().position(|light| !light.is_finite()) {
            return Err(format!("light {light} has a number that is not finite"));
        }
        if self.triangle_count() == 0 {
            let why: String = self.warnings.iter().map(|warning| format!("; {warning}")).collect();
            return Err(format!("has no triangle to draw{why}"));
        }
        match self.bounds() {
            Some((min, max)) if min.as_vec3().is_finite() && max.as_vec3().is_finite() => Ok(()),
            _ => Err("reaches beyond what 32-bit floating point holds".into()),
        }
    }

    fn check_material(&self, material: &Material) -> Result<(), String> {
        let scalars = [
            material.metallic,
            material.roughness,
            material.normal_scale,
            material.occlusion_strength,
            material.alpha_cutoff,
        ];
        if !finite(&material.base_color) || !finite(&material.emissive) || !finite(&scalars) {
            return Err("has a number that is not finite".into());
        }
        for texture in material.textures.iter().flatten() {
            if texture.image as usize >= self.images.len() {
                return Err(format!("uses image {}, which is not there", texture.image));
            }
            if texture.uv_set > 1 {
                return Err(format!("uses texture coordinate set {}; there are two", texture.uv_set));
            }
            if !finite(texture.uv_transform.as_flattened()) {
                return Err("has a texture transform that is not finite".into());
            }
        }
        Ok(())
    }

    fn check_primitive(&self, primitive: &Primitive) -> Result<(), String> {
        let indices = range(&self.indices, primitive.first_index, primitive.index_count)
            .ok_or("has indices beyond the end of the index array")?;
        let vertices = range(&self.vertices, primitive.vertex_offset, primitive.vertex_count)
            .ok_or("has vertices beyond the end of the vertex array")?;
        if !primitive.index_count.is_multiple_of(3) {
            return Err(format!("has {} indices, which do not make whole triangles", primitive.index_count));
        }
        if let Some(index) = indices.iter().max().filter(|&&i| i >= primitive.vertex_count) {
            return Err(format!("uses vertex {index} of {}", primitive.vertex_count));
        }
        if primitive.material as usize >= self.materials.len() {
            return Err(format!("uses material {}, which is not there", primitive.material));
        }
        match vertices.iter().position(|v| !finite(&v.position)) {
            Some(vertex) => Err(format!("has a position that is not finite, at vertex {vertex}")),
            None => Ok(()),
        }
    }
}

fn finite(values: &[f32]) -> bool {
    values.iter().all(|v| v.is_finite())
}

fn range<T>(all: &[T], first: u32, count: u32) -> Option<&[T]> {
    all.get(first as usize..first as usize + count as usize)
}

fn check_image(image: &Image) -> Result<(), String> {
    if image.width == 0 || image.height == 0 {
        return Err("has no texels".into());
    }
    let levels = image.width.max(image.height).ilog2() as usize + 1;
    if image.mips.len() != levels {
        return Err(format!("has {} mip levels instead of {levels}", image.mips.len()));
    }
    let size =
        |level: usize| (image.width >> level).max(1) as usize * (image.height >> level).max(1) as usize;
    match image.mips.iter().enumerate().position(|(level, mip)| mip.len() != 4 * size(level)) {
        Some(level) => Err(format!("has a mip level {level} of the wrong size")),
        None => Ok(()),
    }
}
