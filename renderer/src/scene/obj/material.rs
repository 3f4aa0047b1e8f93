//! MTL materials as metallic-roughness ones.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::super::image::{Content, Encoded, Pixels, make_all};
use super::super::source::SourceFiles;
use super::super::{AlphaMode, Image, Material, TextureRef, TextureSlot};
use super::mtl::Definition;
use super::texture_line::TextureLine;
use crate::{Error, Result};

/// How an image is made from files.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Recipe {
    /// One image file.
    Plain(PathBuf, Content),
    /// `map_Kd`, with the alpha of `map_d`.
    Masked(PathBuf, PathBuf, Content),
    /// White, with the alpha of `map_d`.
    Mask(PathBuf, Content),
    /// `map_Bump`: a normal map, or heights if it is grey.
    Bump(PathBuf),
}

/// The materials that faces use.
#[derive(Default)]
pub(super) struct Materials {
    pub list: Vec<Material>,
    recipes: Vec<Recipe>,
    /// By file: who asks for it.
    users: BTreeMap<PathBuf, String>,
}

impl Materials {
    /// Adds a defined material, or the default one, and tells its place; images are only noted.
    pub fn add(&mut self, definition: Option<&Definition>) -> u32 {
        let material = definition.map_or_else(default, |definition| self.convert(definition));
        self.list.push(material);
        (self.list.len() - 1) as u32
    }

    /// Reads each file once, in order of name, and makes the images on all cores.
    pub fn load_images(&self, files: &mut SourceFiles) -> Result<Vec<Image>> {
        let mut sources = BTreeMap::new();
        for (path, user) in &self.users {
            let bytes = files.read(path).map_err(|error| match error {
                Error::File { path, message } => Error::File { path, message: format!("{message} ({user})") },
                other => other,
            })?;
            sources.insert(path.as_path(), bytes);
        }
        make_all(&self.recipes, |recipe| recipe.make(&sources))
    }

    fn convert(&mut self, mtl: &Definition) -> Material {
        let (color, mask) = (mtl.color_map.as_ref(), mtl.mask_map.as_ref());
        let (glow, bump) = (mtl.emissive_map.as_ref(), mtl.normal_map.as_ref().or(mtl.bump_map.as_ref()));
        let [r, g, b] = mtl.diffuse.unwrap_or(if color.is_some() { [1.0; 3] } else { [0.8; 3] });
        let unlit = if glow.is_some() { [1.0; 3] } else { [0.0; 3] };
        let mut material = Material {
            base_color: [r, g, b, mtl.alpha],
            metallic: mtl.metallic.unwrap_or(0.0).clamp(0.0, 1.0),
            roughness: mtl.roughness.unwrap_or_else(|| mtl.exponent.map_or(1.0, roughness)).clamp(0.0, 1.0),
            emissive: mtl.emissive.unwrap_or(unlit),
            normal_scale: bump.map_or(1.0, |bump| bump.bump),
            alpha_mode: match (mask, mtl.alpha < 1.0) {
                (_, true) => AlphaMode::Blend,
                (Some(_), false) => AlphaMode::Mask,
                (None, false) => AlphaMode::Opaque,
            },
            double_sided: true,
            ..Material::plain(&mtl.name)
        };
        let mut asking = Asking { materials: self, mtl: &mtl.file, name: &mtl.name };
        let base = Content::Color { cutoff: material.texture_cutoff() };
        let glowing = |path| Recipe::Plain(path, Content::Color { cutoff: None });
        let bumpy = |path| match mtl.normal_map {
            Some(_) => Recipe::Plain(path, Content::Normal),
            None => Recipe::Bump(path),
        };
        let textures = [
            (TextureSlot::BaseColor, asking.base_color(color, mask, base)),
            (TextureSlot::Emissive, asking.texture(glow, glowing)),
            (TextureSlot::Normal, asking.texture(bump, bumpy)),
        ];
        for (slot, texture) in textures {
            material.textures[slot as usize] = texture;
        }
        material
    }

    /// The place of an image; equal ones are made once.
    fn image(&mut self, recipe: Recipe) -> u32 {
        let known = self.recipes.iter().position(|known| *known == recipe);
        known.unwrap_or_else(|| {
            self.recipes.push(recipe);
            self.recipes.len() - 1
        }) as u32
    }
}

/// What faces without a material have.
fn default() -> Material {
    let plain = Material::plain("default");
    Material { metallic: 0.0, base_color: [0.8, 0.8, 0.8, 1.0], double_sided: true, ..plain }
}

/// A material of an MTL file asking for textures.
struct Asking<'a> {
    materials: &'a mut Materials,
    mtl: &'a Path,
    name: &'a str,
}

impl Asking<'_> {
    fn texture(
        &mut self,
        line: Option<&TextureLine>,
        recipe: impl FnOnce(PathBuf) -> Recipe,
    ) -> Option<TextureRef> {
        let line = line?;
        let path = self.path(line);
        Some(line.reference(self.materials.image(recipe(path))))
    }

    fn base_color(
        &mut self,
        color: Option<&TextureLine>,
        mask: Option<&TextureLine>,
        content: Content,
    ) -> Option<TextureRef> {
        let recipe = match mask.map(|mask| self.path(mask)) {
            None => return self.texture(color, |path| Recipe::Plain(path, content)),
            Some(mask) => match color.map(|color| self.path(color)) {
                None => Recipe::Mask(mask, content),
                Some(color) if color == mask => Recipe::Plain(color, content),
                Some(color) => Recipe::Masked(color, mask, content),
            },
        };
        let image = self.materials.image(recipe);
        color.or(mask).map(|line| line.reference(image))
    }

    /// Where the file lies: beside the MTL.
    fn path(&mut self, line: &TextureLine) -> PathBuf {
        let path = self.mtl.parent().unwrap_or(Path::new("")).join(&line.file);
        let user = format!("material {} of {}", self.name, self.mtl.display());
        self.materials.users.entry(path.clone()).or_insert(user);
        path
    }
}

/// GGX roughness with the highlight of a Blinn-Phong exponent: Ns = 2/alpha^2 - 2, alpha = roughness^2
/// (Karis, "Specular BRDF Reference", 2013).
fn roughness(exponent: f32) -> f32 {
    (2.0 / (exponent.max(0.0) + 2.0)).sqrt().sqrt()
}

impl Recipe {
    fn make(&self, sources: &BTreeMap<&Path, Vec<u8>>) -> Result<Image> {
        let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let decode = |path: &Path, content| {
            Encoded { name: &name(path), file: path, bytes: &sources[path] }.decode(content)
        };
        let (path, pixels, content) = match self {
            Self::Plain(path, content) => (path, decode(path, *content)?, *content),
            Self::Masked(path, mask, content) => {
                (path, with_alpha(decode(path, *content)?, &decode(mask, Content::Data)?), *content)
            }
            Self::Mask(path, content) => {
                let mask = decode(path, Content::Data)?;
                let texels = vec![255; mask.texels.len()];
                (path, with_alpha(Pixels { size: mask.size, has_alpha: true, texels }, &mask), *content)
            }
            Self::Bump(path) => (path, normals(decode(path, Content::Normal)?), Content::Normal),
        };
        Ok(Image::with_mips(name(path), pixels.size, pixels.texels, content))
    }
}

/// Replaces alpha by that of a mask (by its red where it has none), resampled to the nearest texel.
fn with_alpha(mut image: Pixels, mask: &Pixels) -> Pixels {
    let channel = if mask.has_alpha { 3 } else { 0 };
    let [width, height] = image.size.map(|s| s as usize);
    let [mask_width, mask_height] = mask.size.map(|s| s as usize);
    for (i, texel) in image.texels.as_chunks_mut::<4>().0.iter_mut().enumerate() {
        let (x, y) = (i % width * mask_width / width, i / width * mask_height / height);
        texel[3] = mask.texels[(y * mask_width + x) * 4 + channel];
    }
    image
}

/// A normal map as it is; a grey image as heights, of which the central differences are taken, tiling, with
/// white four texels above black.
fn normals(image: Pixels) -> Pixels {
    const HEIGHT_IN_TEXELS: f32 = 4.0;
    let texels = image.texels.as_chunks::<4>().0;
    if texels.iter().any(|[r, g, b, _]| r != g || g != b) {
        return image;
    }
    let [width, height] = image.size.map(|s| s as usize);
    let at =
        |x: usize, y: usize| f32::from(texels[y % height * width + x % width][0]) / 255.0 * HEIGHT_IN_TEXELS;
    let normal = |i: usize| {
        let (x, y) = (i % width, i / width);
        let slope_x = (at(x + 1, y) - at(x + width - 1, y)) / 2.0;
        // Image rows run down, the tangent space's y up.
        let slope_y = (at(x, y + height - 1) - at(x, y + 1)) / 2.0;
        let [x, y, z] = glam::Vec3::new(-slope_x, -slope_y, 1.0).normalize().to_array();
        let encode = |v: f32| (v * 127.5 + 127.5).round() as u8;
        [encode(x), encode(y), encode(z), 255]
    };
    let texels = (0..texels.len()).flat_map(normal).collect();
    Pixels { texels, ..image }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_become_roughness() {
        assert_eq!(roughness(0.0), 1.0);
        assert!((roughness(1250.0) - 0.2).abs() < 1e-3);
    }

    #[test]
    fn grey_bumps_are_heights() {
        // A ramp that rises to the right: normals lean left (below 128 in red).
        let ramp = [0, 0, 0, 255, 32, 32, 32, 255, 64, 64, 64, 255, 96, 96, 96, 255];
        let bumps = normals(Pixels { size: [4, 1], has_alpha: false, texels: ramp.to_vec() }).texels;
        assert!(bumps[4] < 100 && bumps[5] == 128 && bumps[6] > 200, "{bumps:?}");
        let map = [128, 128, 255, 255].repeat(2);
        assert_eq!(normals(Pixels { size: [2, 1], has_alpha: false, texels: map.clone() }).texels, map);
    }

    #[test]
    fn masks_of_another_size_are_resampled() {
        let image = Pixels { size: [4, 1], has_alpha: false, texels: vec![9; 16] };
        let mask = Pixels { size: [2, 1], has_alpha: false, texels: vec![0, 0, 0, 255, 200, 0, 0, 255] };
        let alphas: Vec<_> = with_alpha(image, &mask).texels.chunks(4).map(|t| t[3]).collect();
        assert_eq!(alphas, [0, 0, 200, 200]);
    }
}
