//! Texels to images: sRGB, normal maps and mip chains, with exactly reproducible arithmetic.

use std::sync::LazyLock;

use crate::scene::Image;

/// Texels along a side of every generated image.
pub(super) const SIDE: usize = 256;

/// What a pattern says about one point of its tile.
#[derive(Debug, Clone, Copy)]
pub(super) struct Texel {
    /// Colour of the texel, sRGB-encoded, 0..1.
    pub(super) color: [f32; 3],
    /// Coverage of the texel, 0..1.
    pub(super) alpha: f32,
    /// Height above the surface, in tile sides.
    pub(super) height: f32,
    /// Perceptual roughness of the texel.
    pub(super) roughness: f32,
    /// 0 dielectric to 1 metal.
    pub(super) metal: f32,
    /// How much of the colour is emitted.
    pub(super) glow: f32,
}

impl Texel {
    /// An opaque, flat, dielectric texel.
    pub(super) fn new(color: [f32; 3], roughness: f32) -> Self {
        Self { color, alpha: 1.0, height: 0.0, roughness, metal: 0.0, glow: 0.0 }
    }

    /// This texel, raised.
    pub(super) fn raised(self, height: f32) -> Self {
        Self { height, ..self }
    }

    /// This texel with another coverage.
    pub(super) fn covering(self, alpha: f32) -> Self {
        Self { alpha, ..self }
    }
}

/// The images of one pattern.
pub(super) struct PatternImages {
    /// Colour and coverage, sRGB.
    pub(super) base_color: Image,
    /// Occlusion, roughness and metalness in R, G and B.
    pub(super) surface: Image,
    /// Tangent-space normal, +Y along growing v.
    pub(super) normal: Image,
    /// Emitted colour, sRGB; only where something glows.
    pub(super) emissive: Option<Image>,
}

/// Evaluates a pattern at the centre of every texel and makes its images with their mips.
pub(super) fn bake(name: &str, pattern: impl Fn(f32, f32) -> Texel) -> PatternImages {
    let centre = |k: usize| (k as f32 + 0.5) / SIDE as f32;
    let texels: Vec<Texel> = (0..SIDE * SIDE).map(|k| pattern(centre(k % SIDE), centre(k / SIDE))).collect();
    let image = |suffix: &str, srgb: bool, texel: &dyn Fn(usize, &Texel) -> [f32; 4]| {
        let bytes = texels.iter().enumerate().flat_map(|(k, t)| texel(k, t).map(to_byte)).collect();
        with_mips(format!("{name}-{suffix}"), srgb, bytes)
    };
    let opaque = |[r, g, b]: [f32; 3], a: f32| [r, g, b, a];
    let slopes = Slopes(&texels);
    PatternImages {
        base_color: image("color", true, &|_, t| opaque(t.color, t.alpha)),
        surface: image("surface", false, &|k, t| [slopes.occlusion(k), t.roughness, t.metal, 1.0]),
        normal: image("normal", false, &|k, _| slopes.normal(k)),
        emissive: texels
            .iter()
            .any(|t| t.glow > 0.0)
            .then(|| image("emissive", true, &|_, t| opaque(t.color.map(|c| c * t.glow), 1.0))),
    }
}

/// The heights of a tile, seen as slopes.
struct Slopes<'a>(&'a [Texel]);

impl Slopes<'_> {
    fn height(&self, k: usize, dx: usize, dy: usize) -> f32 {
        let (x, y) = ((k % SIDE + dx) % SIDE, (k / SIDE + dy) % SIDE);
        self.0[y * SIDE + x].height
    }

    fn normal(&self, k: usize) -> [f32; 4] {
        let half = SIDE as f32 / 2.0;
        let x = (self.height(k, SIDE - 1, 0) - self.height(k, 1, 0)) * half;
        let y = (self.height(k, 0, SIDE - 1) - self.height(k, 0, 1)) * half;
        let scale = 0.5 / (x * x + y * y + 1.0).sqrt();
        [x * scale + 0.5, y * scale + 0.5, scale + 0.5, 1.0]
    }

    /// Darker in hollows: the height against its surroundings.
    fn occlusion(&self, k: usize) -> f32 {
        const REACH: usize = 4;
        let around = [(REACH, 0), (SIDE - REACH, 0), (0, REACH), (0, SIDE - REACH)];
        let mean = around.iter().fold(0.0, |sum, (dx, dy)| sum + self.height(k, *dx, *dy)) / 4.0;
        (1.0 - (mean - self.height(k, 0, 0)).max(0.0) * 40.0).max(0.35)
    }
}

fn to_byte(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// Linear light of each sRGB code, exactly rounded arithmetic only: x^2.4 = x^2 * fifth root of x^2.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|code| {
        let encoded = code as f64 / 255.0;
        if encoded <= 0.04045 {
            return (encoded / 12.92) as f32;
        }
        let base = (encoded + 0.055) / 1.055;
        let square = base * base;
        let root = (0..40).fold(1.0_f64, |x, _| (4.0 * x + square / (x * x * x * x)) / 5.0);
        (square * root) as f32
    })
});

/// The sRGB code nearest to a linear value.
fn encode(linear: f32) -> u8 {
    let above = LINEAR.partition_point(|value| *value < linear).min(255);
    if above > 0 && linear - LINEAR[above - 1] < LINEAR[above] - linear {
        above as u8 - 1
    } else {
        above as u8
    }
}

/// Adds the mip chain of a square image whose side is a power of two; colours are averaged in linear light.
fn with_mips(name: String, srgb: bool, bytes: Vec<u8>) -> Image {
    let mut mips = vec![bytes];
    let mut side = SIDE;
    while side > 1 {
        side /= 2;
        let finer = &mips[mips.len() - 1];
        let coarser = (0..side * side * 4)
            .map(|k| {
                let (channel, x, y) = (k % 4, k / 4 % side, k / 4 / side);
                let at = |dx: usize, dy: usize| finer[((2 * y + dy) * 2 * side + 2 * x + dx) * 4 + channel];
                let four = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
                if srgb && channel < 3 {
                    encode(four.iter().fold(0.0, |sum, code| sum + LINEAR[usize::from(*code)]) / 4.0)
                } else {
                    ((four.iter().map(|code| u32::from(*code)).sum::<u32>() + 2) / 4) as u8
                }
            })
            .collect();
        mips.push(coarser);
    }
    Image { name, width: SIDE as u32, height: SIDE as u32, srgb, mips }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_codes_survive_a_round_trip() {
        assert_eq!((LINEAR[0], LINEAR[255]), (0.0, 1.0));
        assert!((LINEAR[188] - 0.502_886).abs() < 1e-5);
        for code in 0..=255_u8 {
            assert_eq!(encode(LINEAR[usize::from(code)]), code);
        }
    }

    #[test]
    fn mips_average_in_linear_light() {
        let set = bake("checker", |u, v| {
            let on = (u * 256.0) as u32 % 2 == (v * 256.0) as u32 % 2;
            Texel::new([if on { 1.0 } else { 0.0 }; 3], if on { 1.0 } else { 0.0 })
        });
        assert_eq!(set.base_color.mips.len(), 9);
        assert_eq!(set.base_color.mips[1][..4], [188, 188, 188, 255]);
        assert_eq!(set.surface.mips[1][1], 128);
        assert_eq!(set.base_color.mips[8].len(), 4);
    }

    #[test]
    fn flat_patterns_have_upright_normals() {
        let set = bake("flat", |_, _| Texel::new([0.5; 3], 0.5));
        assert!(set.normal.mips[0].chunks(4).all(|n| n == [128, 128, 255, 255]));
        assert!(set.emissive.is_none());
    }
}
