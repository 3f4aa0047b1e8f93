//! Materials, textures and the images they need (glTF 2.0, sections 3.8 and 3.9).

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use gltf::json;
use json::extensions::texture::TextureTransform;
use json::validation::Checked;
use serde::Deserialize;

use super::super::image::{Content, Encoded, make_all};
use super::super::source::SourceFiles;
use super::super::{AlphaMode, Image, Material, Sampler, TextureRef, TextureSlot, Wrap};
use super::choice::Choice;
use super::document::Document;
use super::extensions;
use super::left_out::LeftOut;
use super::uri::{self, Target};
use crate::{Error, Result};

/// The number n of the TEXCOORD_n that becomes each of the two sets of [`super::super::Vertex::uv`]; `None` where a
/// material reads fewer.
pub(super) type TexCoords = [Option<u32>; 2];

/// The materials that primitives use.
pub(super) struct Materials {
    /// Materials in the document's order; the default one comes last where it is needed.
    pub list: Vec<Material>,
    /// By place in the document: the place in `list`.
    places: BTreeMap<usize, u32>,
    /// The TEXCOORD_n that each material reads.
    pub tex_coords: Vec<TexCoords>,
    /// What [`TextureRef::image`] counts: images of the document, the first readable of which is meant, and how it is read.
    images: Vec<(Choice, Content)>,
}

impl Materials {
    /// Reads the materials in use, `None` for the default one; images are only noted.
    pub fn read(
        document: &Document,
        used: impl Iterator<Item = Option<json::Index<json::Material>>>,
        left_out: &mut LeftOut,
    ) -> Result<Self> {
        let used: BTreeSet<Option<usize>> =
            used.map(|material| material.map(|index| index.value())).collect();
        let mut reader = Reader { document, images: Vec::new(), image_of: BTreeMap::new() };
        let (mut list, mut tex_coords, mut places) = (Vec::new(), Vec::new(), BTreeMap::new());
        for &i in used.iter().flatten() {
            let (material, read) = reader
                .read(json::Index::new(i as u32), left_out)
                .map_err(|message| document.error(format!("materials[{i}] {message}")))?;
            places.insert(i, list.len() as u32);
            list.push(material);
            tex_coords.push(read);
        }
        if used.contains(&None) || list.is_empty() {
            list.push(Material::plain("default"));
            tex_coords.push([None; 2]);
        }
        Ok(Self { list, places, tex_coords, images: reader.images })
    }

    /// The place in `list` of the material that a primitive names, or of the default one.
    pub fn place(&self, material: Option<json::Index<json::Material>>) -> u32 {
        material.map_or(self.list.len() as u32 - 1, |material| self.places[&material.value()])
    }

    /// Reads the images that materials use, in the document's order, and decodes them on all cores.
    pub fn load_images(&self, document: &Document, files: &mut SourceFiles) -> Result<Vec<Image>> {
        let used: BTreeSet<usize> = self.images.iter().flat_map(|(choice, _)| choice.images()).collect();
        let sources: BTreeMap<usize, Result<Source>> =
            used.into_iter().map(|image| (image, Source::read(document, files, image))).collect();
        make_all(&self.images, |(choice, content)| {
            choice.first_readable(&document.path, |image| match &sources[&image] {
                Ok(source) => source.decode(*content),
                Err(error) => Err(error.clone()),
            })
        })
    }
}

/// An encoded image.
struct Source<'a> {
    name: String,
    file: PathBuf,
    bytes: Cow<'a, [u8]>,
}

impl<'a> Source<'a> {
    fn read(document: &'a Document, files: &mut SourceFiles, index: usize) -> Result<Self> {
        let fail = |message: &str| document.error(format!("images[{index}] {message}"));
        let image = document.get(json::Index::<json::Image>::new(index as u32)).map_err(|e| fail(&e))?;
        let name = image.name.clone().unwrap_or_else(|| format!("images[{index}]"));
        let inside = |bytes| Self { name: name.clone(), file: document.path.clone(), bytes };
        match (&image.uri, image.buffer_view) {
            (_, Some(view)) => Ok(inside(Cow::Borrowed(document.view(view).map_err(|e| fail(&e))?.0))),
            (None, None) => Err(fail("has neither a uri nor a bufferView")),
            (Some(uri), None) => match uri::resolve(uri).map_err(|e| fail(&e))? {
                Target::Data(bytes) => Ok(inside(Cow::Owned(bytes))),
                Target::File(file) => {
                    let path = uri::beside(&document.path, &file);
                    let bytes = files.read(&path).map_err(|e| used_by(e, document, index))?;
                    let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
                    Ok(Self { name, file: path, bytes: Cow::Owned(bytes) })
                }
            },
        }
    }

    fn decode(&self, content: Content) -> Result<Image> {
        let encoded = Encoded { name: &self.name, file: &self.file, bytes: &self.bytes };
        let pixels = encoded.decode(content)?;
        Ok(Image::with_mips(&self.name, pixels.size, pixels.texels, content))
    }
}

fn used_by(error: Error, document: &Document, index: usize) -> Error {
    match error {
        Error::File { path, message } => Error::File {
            path,
            message: format!("{message} (images[{index}] of {})", document.path.display()),
        },
        other => other,
    }
}

/// A texture as the document's material refers to it.
struct Use<'a> {
    slot: TextureSlot,
    texture: json::Index<json::Texture>,
    /// The number n of the TEXCOORD_n that places it.
    tex_coord: u32,
    transform: Option<Cow<'a, TextureTransform>>,
}

impl<'a> Use<'a> {
    fn new(slot: TextureSlot, info: &'a json::texture::Info) -> Self {
        let transform = info.extensions.as_ref().and_then(|e| e.texture_transform.as_ref());
        Self { slot, texture: info.index, tex_coord: info.tex_coord, transform: transform.map(Cow::Borrowed) }
    }
}

struct Reader<'a> {
    document: &'a Document,
    images: Vec<(Choice, Content)>,
    /// By images of the document and kind of content.
    image_of: BTreeMap<(Choice, u8), u32>,
}

impl Reader<'_> {
    fn read(
        &mut self,
        index: json::Index<json::Material>,
        left_out: &mut LeftOut,
    ) -> Result<(Material, TexCoords), String> {
        let value = self.document.value(index)?;
        let mut json = json::Material::deserialize(value).map_err(|e| format!("is not valid: {e}"))?;
        extensions::note_material(value, left_out);
        take_specular_glossiness(&mut json, value.get("pbrMetallicRoughness").is_some(), left_out);
        let name = json.name.clone().unwrap_or_else(|| format!("material {}", index.value()));
        self.material(name, &json, left_out)
    }

    fn material(
        &mut self,
        name: String,
        json: &json::Material,
        left_out: &mut LeftOut,
    ) -> Result<(Material, TexCoords), String> {
        let Checked::Valid(alpha_mode) = json.alpha_mode else {
            return Err("has an unknown alphaMode".into());
        };
        let strength = json.extensions.as_ref().and_then(|e| e.emissive_strength.as_ref());
        let strength = strength.map_or(1.0, |e| e.emissive_strength.0);
        let pbr = &json.pbr_metallic_roughness;
        let mut material = Material {
            name,
            base_color: pbr.base_color_factor.0,
            metallic: pbr.metallic_factor.0,
            roughness: pbr.roughness_factor.0,
            emissive: json.emissive_factor.0.map(|factor| factor * strength),
            normal_scale: json.normal_texture.as_ref().map_or(1.0, |t| t.scale),
            occlusion_strength: json.occlusion_texture.as_ref().map_or(1.0, |t| t.strength.0),
            alpha_mode: match alpha_mode {
                json::material::AlphaMode::Opaque => AlphaMode::Opaque,
                json::material::AlphaMode::Mask => AlphaMode::Mask,
                json::material::AlphaMode::Blend => AlphaMode::Blend,
            },
            alpha_cutoff: json.alpha_cutoff.unwrap_or_default().0,
            double_sided: json.double_sided,
            unlit: json.extensions.as_ref().is_some_and(|e| e.unlit.is_some()),
            textures: [None; 5],
        };
        let uses = texture_uses(json)?;
        let tex_coords = tex_coords(&uses)?;
        for texture in &uses {
            let reference = self.texture(texture, &tex_coords, content(&material, texture.slot), left_out)?;
            material.textures[texture.slot as usize] = reference;
        }
        Ok((material, tex_coords))
    }

    fn texture(
        &mut self,
        texture: &Use,
        tex_coords: &TexCoords,
        content: Content,
        left_out: &mut LeftOut,
    ) -> Result<Option<TextureRef>, String> {
        let json = self.document.get(texture.texture)?;
        let Some(choice) = Choice::of(self.document, texture.texture.value(), &json, left_out)? else {
            return Ok(None);
        };
        let sampler = match json.sampler {
            Some(sampler) => read_sampler(&self.document.get(sampler)?),
            None => Sampler { wrap: [Wrap::Repeat; 2], nearest: false },
        };
        Ok(Some(TextureRef {
            image: self.image(choice, content),
            sampler,
            uv_set: u32::from(tex_coords[0] != Some(texture.tex_coord)),
            uv_transform: texture.transform.as_deref().map_or(TextureRef::IDENTITY, matrix),
        }))
    }

    /// The place of an image with a content; colour and data are two images.
    fn image(&mut self, choice: Choice, content: Content) -> u32 {
        let kind = match content {
            Content::Color { .. } => 0,
            Content::Data => 1,
            Content::Normal => 2,
        };
        let place = *self.image_of.entry((choice.clone(), kind)).or_insert(self.images.len() as u32);
        match self.images.get_mut(place as usize) {
            None => self.images.push((choice, content)),
            // Opaque materials may share it: they read no alpha.
            Some((_, held)) => *held = (*held).max(content),
        }
        place
    }
}

/// Gives a material of specular and glossiness (KHR_materials_pbrSpecularGlossiness) that has no `fallback` the
/// metallic-roughness values that come closest to its diffuse colour and its gloss: a dielectric. Its specular colour
/// and gloss map are left out.
fn take_specular_glossiness(json: &mut json::Material, fallback: bool, left_out: &mut LeftOut) {
    let Some(gloss) = json.extensions.as_mut().and_then(|e| e.pbr_specular_glossiness.take()) else { return };
    if fallback {
        return left_out
            .add("materials of specular and glossiness, drawn by their metallic-roughness values", 1);
    }
    left_out.add(
        "materials of specular and glossiness, drawn with their diffuse colour and gloss factor alone",
        1,
    );
    let pbr = &mut json.pbr_metallic_roughness;
    pbr.base_color_factor.0 = gloss.diffuse_factor.0;
    pbr.base_color_texture = gloss.diffuse_texture;
    pbr.metallic_factor.0 = 0.0;
    pbr.roughness_factor.0 = 1.0 - gloss.glossiness_factor.0;
}

/// What a texture of `material` holds.
fn content(material: &Material, slot: TextureSlot) -> Content {
    match slot {
        TextureSlot::BaseColor => Content::Color { cutoff: material.texture_cutoff() },
        TextureSlot::Emissive => Content::Color { cutoff: None },
        TextureSlot::Normal => Content::Normal,
        TextureSlot::MetallicRoughness | TextureSlot::Occlusion => Content::Data,
    }
}

fn texture_uses(json: &json::Material) -> Result<Vec<Use<'_>>, String> {
    let pbr = &json.pbr_metallic_roughness;
    let mut uses: Vec<Use> = Vec::new();
    uses.extend(pbr.base_color_texture.as_ref().map(|info| Use::new(TextureSlot::BaseColor, info)));
    let metallic_roughness = pbr.metallic_roughness_texture.as_ref();
    uses.extend(metallic_roughness.map(|info| Use::new(TextureSlot::MetallicRoughness, info)));
    uses.extend(json.emissive_texture.as_ref().map(|info| Use::new(TextureSlot::Emissive, info)));
    if let Some(normal) = &json.normal_texture {
        let transform = other_transform(normal.extensions.as_ref().map(|e| &e.others))?;
        uses.push(Use {
            slot: TextureSlot::Normal,
            texture: normal.index,
            tex_coord: normal.tex_coord,
            transform,
        });
    }
    if let Some(occlusion) = &json.occlusion_texture {
        let transform = other_transform(occlusion.extensions.as_ref().map(|e| &e.others))?;
        let (slot, texture, tex_coord) = (TextureSlot::Occlusion, occlusion.index, occlusion.tex_coord);
        uses.push(Use { slot, texture, tex_coord, transform });
    }
    for texture in &mut uses {
        let replaced = texture.transform.as_ref().and_then(|transform| transform.tex_coord);
        texture.tex_coord = replaced.unwrap_or(texture.tex_coord);
    }
    Ok(uses)
}

/// KHR_texture_transform where the crate has no field for it.
fn other_transform<'a>(
    extensions: Option<&serde_json::Map<String, serde_json::Value>>,
) -> Result<Option<Cow<'a, TextureTransform>>, String> {
    let transform = extensions.and_then(|others| others.get("KHR_texture_transform"));
    let parsed = transform.map(|json| serde_json::from_value(json.clone())).transpose();
    parsed.map(|t| t.map(Cow::Owned)).map_err(|e| format!("has a broken KHR_texture_transform: {e}"))
}

/// The distinct TEXCOORD_n in use, ascending.
fn tex_coords(uses: &[Use]) -> Result<TexCoords, String> {
    let mut used: Vec<_> = uses.iter().map(|texture| texture.tex_coord).collect();
    used.sort_unstable();
    used.dedup();
    if used.len() > 2 {
        let names: Vec<_> = used.iter().map(|number| format!("TEXCOORD_{number}")).collect();
        return Err(format!("reads {}; at most two sets of texture coordinates work", names.join(", ")));
    }
    Ok([used.first().copied(), used.get(1).copied()])
}

fn read_sampler(json: &json::texture::Sampler) -> Sampler {
    let wrap = |mode| match mode {
        Checked::Valid(json::texture::WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(json::texture::WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(json::texture::WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    };
    let nearest = json.mag_filter == Some(Checked::Valid(json::texture::MagFilter::Nearest));
    Sampler { wrap: [wrap(json.wrap_s), wrap(json.wrap_t)], nearest }
}

/// Translation * rotation * scale, as the extension's text multiplies them.
fn matrix(transform: &TextureTransform) -> [[f32; 3]; 2] {
    let (sin, cos) = transform.rotation.0.sin_cos();
    let [u_scale, v_scale] = transform.scale.0;
    let [u_offset, v_offset] = transform.offset.0;
    [[cos * u_scale, sin * v_scale, u_offset], [-sin * u_scale, cos * v_scale, v_offset]]
}
