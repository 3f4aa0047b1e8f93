//! Which textures materials have: shading is compiled for each set that a scene draws, and samples no others.

use crate::draw_list::SurfaceKind;
use crate::scene::{Material, Scene, TextureSlot};
use std::collections::BTreeSet;

/// Some of a material's five textures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct TextureSet(u32);

impl TextureSet {
    /// The set of no textures.
    pub const NONE: Self = Self(0);
    /// The set of the base colour alone.
    pub const BASE_COLOR: Self = Self(1 << TextureSlot::BaseColor as u32);

    /// The set of the normal map alone.
    pub const NORMAL: Self = Self(1 << TextureSlot::Normal as u32);

    /// Textures of `material` that change how it looks.
    pub fn of(material: &Material) -> Self {
        let slots = material.textures.iter().enumerate().filter(|(_, texture)| texture.is_some());
        let all = slots.fold(0, |bits, (slot, _)| bits | 1 << slot);
        let dark = material.emissive == [0.0; 3];
        Self(if dark { all & !(1 << TextureSlot::Emissive as u32) } else { all })
    }

    /// What is in both sets.
    pub fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// A bit for each [`TextureSlot`].
    pub fn bits(self) -> u32 {
        self.0
    }

    /// Whether a texture is in the set.
    pub fn has(self, slot: TextureSlot) -> bool {
        self.0 >> slot as u32 & 1 != 0
    }
}

/// The sets of what a scene draws, by [`SurfaceKind`].
pub fn drawn_sets(scene: &Scene) -> [BTreeSet<TextureSet>; 3] {
    let mut sets = [const { BTreeSet::new() }; 3];
    for instance in &scene.instances {
        let primitive = &scene.primitives[instance.primitive as usize];
        let material = &scene.materials[primitive.material as usize];
        sets[SurfaceKind::from(material.alpha_mode) as usize].insert(TextureSet::of(material));
    }
    sets
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Sampler, TextureRef, Wrap};

    #[test]
    fn textures_that_change_nothing_are_not_sampled() {
        let sampler = Sampler { wrap: [Wrap::Repeat; 2], nearest: false };
        let texture = TextureRef { image: 0, sampler, uv_set: 0, uv_transform: TextureRef::IDENTITY };
        let mut material = Material::plain("plain");
        assert_eq!(TextureSet::of(&material), TextureSet::NONE);
        material.textures[TextureSlot::BaseColor as usize] = Some(texture);
        material.textures[TextureSlot::Emissive as usize] = Some(texture);
        assert_eq!(TextureSet::of(&material), TextureSet::BASE_COLOR);
        material.emissive = [0.0, 0.1, 0.0];
        let set = TextureSet::of(&material);
        assert!(set.has(TextureSlot::Emissive) && !set.has(TextureSlot::Normal));
        assert_eq!(set.bits(), 0b1_0001);
    }
}
