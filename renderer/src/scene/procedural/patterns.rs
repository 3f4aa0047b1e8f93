//! The textures, as functions of a point of their tile.

mod cloth;
mod cutout;
mod masonry;
mod plain;

use super::texture::{PatternImages, Texel, bake};

/// A texture shared by one or more surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Pattern {
    /// Grey setts of a road.
    Setts,
    /// Slabs of a pavement.
    Paving,
    /// Dressed limestone in courses.
    Ashlar,
    /// Painted plaster.
    Plaster,
    /// Bricks.
    Brick,
    /// Zinc sheets with standing seams.
    Zinc,
    /// Slates or clay tiles in scales.
    Scales,
    /// Planks.
    Planks,
    /// A coat of paint, or cast metal.
    Coat,
    /// Wrought iron panel, cut out.
    Ironwork,
    /// A cluster of leaves, cut out.
    Leaves,
    /// Bark.
    Bark,
    /// A casement with its glazing bars.
    Casement,
    /// A lit curtain.
    Curtain,
    /// Glowing letters.
    Letters,
    /// Striped cloth with a scalloped hem.
    Stripes,
    /// Thin clear glass.
    Clear,
    /// Milky lamp glass.
    Lamp,
    /// Veined marble.
    Marble,
    /// A mosaic floor with a sun.
    Mosaic,
    /// A hanging cloth with an emblem and a frayed hem.
    Banner,
    /// Hanging vines, cut out.
    Vines,
    /// Water with ripples.
    Water,
    /// Leaded coloured glass.
    Stained,
    /// Glowing coals and flames.
    Embers,
    /// Rock and grass.
    Meadow,
    /// A pierced stone screen, cut out.
    Lattice,
    /// Dark and light polished tiles, cornerwise.
    Chequers,
    /// Woven cloth with a raised motif.
    Damask,
    /// A thin weave that lets light through.
    Gauze,
    /// White glaze with blue bands.
    Porcelain,
    /// Glazed bricks in blues, a few golden.
    Glazed,
}

impl Pattern {
    /// The pattern's images, named after it.
    pub(super) fn bake(self) -> PatternImages {
        bake(&format!("{self:?}").to_lowercase(), self.texel())
    }

    fn texel(self) -> fn(f32, f32) -> Texel {
        match self {
            Self::Setts => masonry::setts,
            Self::Paving => masonry::paving,
            Self::Ashlar => masonry::ashlar,
            Self::Plaster => plain::plaster,
            Self::Brick => masonry::brick,
            Self::Zinc => masonry::zinc,
            Self::Scales => masonry::scales,
            Self::Planks => masonry::planks,
            Self::Coat => plain::coat,
            Self::Ironwork => cutout::ironwork,
            Self::Leaves => cutout::leaves,
            Self::Bark => plain::bark,
            Self::Casement => plain::casement,
            Self::Curtain => plain::curtain,
            Self::Letters => plain::letters,
            Self::Stripes => cutout::stripes,
            Self::Clear => plain::clear,
            Self::Lamp => plain::lamp,
            Self::Marble => plain::marble,
            Self::Mosaic => masonry::mosaic,
            Self::Banner => cutout::banner,
            Self::Vines => cutout::vines,
            Self::Water => plain::water,
            Self::Stained => masonry::stained,
            Self::Embers => plain::embers,
            Self::Meadow => plain::meadow,
            Self::Lattice => cutout::lattice,
            Self::Chequers => masonry::chequers,
            Self::Damask => cloth::damask,
            Self::Gauze => cloth::gauze,
            Self::Porcelain => plain::porcelain,
            Self::Glazed => masonry::glazed,
        }
    }
}

/// A grey level moved towards a hue.
fn shade(color: [f32; 3], factor: f32) -> [f32; 3] {
    color.map(|c| c * factor)
}

/// Linear interpolation of colours.
fn blend(a: [f32; 3], b: [f32; 3], t: f32) -> [f32; 3] {
    [0, 1, 2].map(|k| super::maths::mix(a[k], b[k], t))
}
