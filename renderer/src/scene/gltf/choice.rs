//! The images that a texture can be read from: extensions name one in another format beside the plain one.

use std::path::Path;

use gltf::json;

use super::super::Image;
use super::document::Document;
use super::left_out::LeftOut;
use crate::Result;

/// Extensions of textures that name an image, the preferred first.
const EXTENSIONS: [&str; 3] = ["KHR_texture_basisu", "MSFT_texture_dds", "EXT_texture_webp"];

/// Images of the document that are one picture: the first readable of them is drawn.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Choice(Vec<usize>);

impl Choice {
    /// The images of `textures[index]`; with none in a format that is read the texture is left out, with a warning.
    pub fn of(
        document: &Document,
        index: usize,
        texture: &json::Texture,
        left_out: &mut LeftOut,
    ) -> Result<Option<Self>, String> {
        let others = texture.extensions.as_ref().map(|extensions| &extensions.others);
        let source = |name: &&str| others.and_then(|others| others.get(*name)?.get("source")?.as_u64());
        let mut images: Vec<_> = EXTENSIONS.iter().filter_map(source).map(|image| image as usize).collect();
        // The JSON types have this for a source that is absent.
        if texture.source.value() != u32::MAX as usize {
            document.value(texture.source)?;
            images.push(texture.source.value());
        }
        if images.is_empty() {
            let names: Vec<_> = others.into_iter().flatten().map(|(name, _)| name.as_str()).collect();
            let by = if names.is_empty() { String::new() } else { format!(" but by {}", names.join(", ")) };
            left_out.note(format!("textures[{index}] has no image{by}, and is left out"));
        }
        Ok(Some(Self(images)).filter(|choice| !choice.0.is_empty()))
    }

    /// All images of the choice, in order.
    pub fn images(&self) -> impl Iterator<Item = usize> {
        self.0.iter().copied()
    }

    /// What `read` makes of the first that it can read; of several errors the first is reported, as a warning where another
    /// image stands in.
    pub fn first_readable(&self, file: &Path, read: impl Fn(usize) -> Result<Image>) -> Result<Image> {
        let mut first_error = None;
        for image in self.images() {
            match (read(image), &first_error) {
                (Ok(image), None) => return Ok(image),
                (Ok(image), Some(error)) => {
                    tracing::warn!("{}: {error}; {} is drawn instead", file.display(), image.name);
                    return Ok(image);
                }
                (Err(error), _) => first_error = first_error.or(Some(error)),
            }
        }
        Err(first_error.expect("a choice is among some"))
    }
}
