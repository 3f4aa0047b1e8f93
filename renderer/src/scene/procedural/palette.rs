//! The materials of the built-in scenes.

use super::patterns::Pattern;
use crate::scene::AlphaMode;

/// What a mesh is made of; the order is the order of the scene's materials.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Surface {
    /// Road.
    Road,
    /// Pavement, kerbs, steps.
    Pavement,
    /// Limestone facades.
    Limestone,
    /// Plastered facades and back walls.
    Plaster,
    /// Chimneys and party walls.
    Brick,
    /// Mouldings, sills, balconies.
    Trim,
    /// Mansard roofs.
    Slate,
    /// Flat roofs.
    Zinc,
    /// Doors, chairs, tables, crates.
    Wood,
    /// Shutters and shop fronts.
    Joinery,
    /// Lamp posts, table feet, bollards.
    Iron,
    /// Chimney pots, plant pots.
    Terracotta,
    /// Scooters' bodies.
    Enamel,
    /// Tyres and seats.
    Rubber,
    /// Scooters' bright work, door handles.
    Chrome,
    /// Tree trunks.
    Bark,
    /// Dark rooms behind windows.
    Room,
    /// Lit rooms behind windows.
    LitRoom,
    /// Shop signs.
    Sign,
    /// Lamp globes.
    LampGlass,
    /// Balcony panels.
    Railing,
    /// Tree crowns and shrubs.
    Foliage,
    /// Awnings.
    Awning,
    /// Window casements.
    Casement,
    /// Shop windows.
    ShopGlass,
    /// Drinking glasses and bottles.
    Tumbler,
    /// Temple walls.
    TempleWall,
    /// Columns, arches.
    Marble,
    /// Temple floors.
    Mosaic,
    /// Temple paving and stairs.
    Flags,
    /// Temple roofs.
    RoofTiles,
    /// Gilded trim.
    Gold,
    /// Statues, braziers.
    Bronze,
    /// Coals and flames.
    Embers,
    /// The ground around the temple.
    Meadow,
    /// Hanging cloths.
    Banner,
    /// Hanging vines.
    Vines,
    /// Pierced screens.
    Screen,
    /// Leaded windows.
    StainedGlass,
    /// Pools.
    Water,
    /// The hall's floor.
    Chequers,
    /// Red columns.
    Porphyry,
    /// Red drapes.
    Crimson,
    /// Green drapes.
    Teal,
    /// Yellow drapes.
    Ochre,
    /// Thin cloths across the hall.
    Veil,
    /// Vases.
    Glaze,
    /// Blue walls of the city.
    GlazedBrick,
    /// Red walls of the city.
    RedPlaster,
}

/// How a surface looks.
pub(super) struct Look {
    /// Pattern of the textures.
    pub(super) pattern: Pattern,
    /// Metres that one tile of the texture covers; 1 where the coordinates are not metres.
    pub(super) tile: f32,
    /// Multiplies the texture's colour, linear.
    pub(super) color: [f32; 3],
    /// Multiplies the texture's metalness and roughness.
    pub(super) metal_rough: [f32; 2],
    /// Multiplies the emissive texture.
    pub(super) emissive: f32,
    /// Opaque, masked or blended.
    pub(super) alpha: AlphaMode,
    /// Seen from both sides.
    pub(super) double_sided: bool,
}

impl Look {
    const fn new(pattern: Pattern, tile: f32, color: [f32; 3]) -> Self {
        Self {
            pattern,
            tile,
            color,
            metal_rough: [1.0, 1.0],
            emissive: 0.0,
            alpha: AlphaMode::Opaque,
            double_sided: false,
        }
    }

    /// With factors for the pattern's metalness and roughness.
    const fn metal(self, metallic: f32, roughness: f32) -> Self {
        Self { metal_rough: [metallic, roughness], ..self }
    }

    const fn glowing(self, emissive: f32) -> Self {
        Self { emissive, ..self }
    }

    const fn masked(self) -> Self {
        Self { alpha: AlphaMode::Mask, ..self }.thin()
    }

    const fn blended(self) -> Self {
        Self { alpha: AlphaMode::Blend, ..self }
    }

    /// Seen from both sides.
    const fn thin(self) -> Self {
        Self { double_sided: true, ..self }
    }
}

const WHITE: [f32; 3] = [1.0, 1.0, 1.0];

impl Surface {
    /// Colours and textures of the surface.
    pub(super) fn look(self) -> Look {
        match self {
            Self::Road => Look::new(Pattern::Setts, 2.0, WHITE),
            Self::Pavement => Look::new(Pattern::Paving, 2.4, WHITE),
            Self::Limestone => Look::new(Pattern::Ashlar, 3.0, WHITE),
            Self::Plaster => Look::new(Pattern::Plaster, 4.0, WHITE),
            Self::Brick => Look::new(Pattern::Brick, 1.6, WHITE),
            Self::Trim => Look::new(Pattern::Plaster, 2.0, [0.86, 0.82, 0.74]),
            Self::Slate => Look::new(Pattern::Scales, 2.4, [0.34, 0.38, 0.46]),
            Self::Zinc => Look::new(Pattern::Zinc, 3.0, WHITE),
            Self::Wood => Look::new(Pattern::Planks, 0.9, WHITE),
            Self::Joinery => Look::new(Pattern::Coat, 1.5, [0.09, 0.20, 0.21]).metal(0.0, 1.0),
            Self::Iron => Look::new(Pattern::Coat, 1.0, [0.06, 0.08, 0.07]).metal(0.3, 1.0),
            Self::Terracotta => Look::new(Pattern::Plaster, 1.0, [0.62, 0.25, 0.13]),
            Self::Enamel => Look::new(Pattern::Coat, 2.0, [0.75, 0.75, 0.75]).metal(0.0, 0.6),
            Self::Rubber => Look::new(Pattern::Coat, 0.5, [0.03, 0.03, 0.03]).metal(0.0, 1.0),
            Self::Chrome => Look::new(Pattern::Coat, 1.0, [0.8, 0.8, 0.8]).metal(1.0, 0.4),
            Self::Bark => Look::new(Pattern::Bark, 1.2, WHITE),
            Self::Room => Look::new(Pattern::Plaster, 4.0, [0.10, 0.09, 0.08]),
            Self::LitRoom => Look::new(Pattern::Curtain, 1.0, WHITE).glowing(1.6),
            Self::Sign => Look::new(Pattern::Letters, 1.0, WHITE).glowing(2.5),
            Self::LampGlass => Look::new(Pattern::Lamp, 1.0, WHITE).glowing(6.0),
            Self::Railing => Look::new(Pattern::Ironwork, 1.0, WHITE).masked(),
            Self::Foliage => Look::new(Pattern::Leaves, 1.0, WHITE).masked(),
            Self::Awning => Look::new(Pattern::Stripes, 1.0, WHITE).masked(),
            Self::Casement => Look::new(Pattern::Casement, 1.0, WHITE).blended(),
            Self::ShopGlass => Look::new(Pattern::Clear, 2.0, [0.6, 0.7, 0.7]).blended(),
            Self::Tumbler => Look::new(Pattern::Clear, 0.3, WHITE).blended(),
            Self::TempleWall => Look::new(Pattern::Ashlar, 4.0, [0.92, 0.84, 0.72]),
            Self::Marble => Look::new(Pattern::Marble, 3.0, WHITE),
            Self::Mosaic => Look::new(Pattern::Mosaic, 4.0, WHITE),
            Self::Flags => Look::new(Pattern::Paving, 3.6, [1.0, 0.88, 0.72]),
            Self::RoofTiles => Look::new(Pattern::Scales, 3.0, [0.95, 0.45, 0.28]),
            Self::Gold => Look::new(Pattern::Coat, 1.0, [1.0, 0.72, 0.28]).metal(1.0, 0.55),
            Self::Bronze => Look::new(Pattern::Coat, 1.5, [0.42, 0.28, 0.16]).metal(0.8, 1.0),
            Self::Embers => Look::new(Pattern::Embers, 1.0, WHITE).glowing(6.0),
            Self::Meadow => Look::new(Pattern::Meadow, 9.0, WHITE),
            Self::Banner => Look::new(Pattern::Banner, 1.0, WHITE).masked(),
            Self::Vines => Look::new(Pattern::Vines, 1.0, WHITE).masked(),
            Self::Screen => Look::new(Pattern::Lattice, 1.0, WHITE).masked(),
            Self::StainedGlass => Look::new(Pattern::Stained, 1.0, WHITE).blended().thin(),
            Self::Water => Look::new(Pattern::Water, 5.0, WHITE).blended(),
            Self::Chequers => Look::new(Pattern::Chequers, 2.5, WHITE),
            Self::Porphyry => Look::new(Pattern::Marble, 1.6, [0.52, 0.17, 0.13]).metal(0.0, 0.8),
            Self::Crimson => Look::new(Pattern::Damask, 0.9, [0.62, 0.05, 0.05]).thin(),
            Self::Teal => Look::new(Pattern::Damask, 0.9, [0.04, 0.30, 0.28]).thin(),
            Self::Ochre => Look::new(Pattern::Damask, 0.9, [0.72, 0.42, 0.08]).thin(),
            Self::Veil => Look::new(Pattern::Gauze, 1.2, [0.95, 0.88, 0.78]).blended().thin(),
            Self::Glaze => Look::new(Pattern::Porcelain, 0.8, WHITE),
            Self::GlazedBrick => Look::new(Pattern::Glazed, 2.4, WHITE),
            Self::RedPlaster => Look::new(Pattern::Plaster, 3.0, [0.72, 0.34, 0.22]),
        }
    }
}
