//! What surfaces are made of to light: what their scene says, or the one white material of a paper.

use crate::texture_sets::TextureSet;
use clap::ValueEnum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What all surfaces of a run are made of. Which lights reach them, and what is cut out or seen through, is the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum MaterialModel {
    /// What the scene says, with all its textures, by Cook and Torrance's reflection.
    Textured,
    /// White Lambert without 1/pi, radiance 0.1 + 0.9 times the sum over lights (Tegelaers section 3.1): nothing of a
    /// material counts but its alpha, and normals are those of the geometry.
    White,
}

impl MaterialModel {
    /// The textures that shading samples of those that a material has. `reads_alpha` tells whether it asks for alpha, which
    /// the base colour's texture has.
    pub(crate) fn sampled(self, textures: TextureSet, reads_alpha: bool) -> TextureSet {
        match self {
            Self::Textured => textures,
            Self::White if reads_alpha => textures.and(TextureSet::BASE_COLOR),
            Self::White => TextureSet::NONE,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Material, Sampler, TextureRef, Wrap};

    #[test]
    fn white_surfaces_sample_nothing_but_alpha() {
        let sampler = Sampler { wrap: [Wrap::Repeat; 2], nearest: false };
        let texture = TextureRef { image: 0, sampler, uv_set: 0, uv_transform: TextureRef::IDENTITY };
        let full = TextureSet::of(&Material { textures: [Some(texture); 5], ..Material::plain("full") });
        for reads_alpha in [false, true] {
            assert_eq!(MaterialModel::Textured.sampled(full, reads_alpha), full);
            assert_eq!(MaterialModel::White.sampled(TextureSet::NONE, reads_alpha), TextureSet::NONE);
        }
        assert_eq!(MaterialModel::White.sampled(full, true), TextureSet::BASE_COLOR);
        assert_eq!(MaterialModel::White.sampled(full, false), TextureSet::NONE);
    }
}
