//! What lights reach, as tests against clusters take it.

use glam::DVec3;

/// The shape of what a light reaches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum VolumeKind {
    /// All around the light, up to a radius: the bounding sphere itself.
    Sphere,
}

impl VolumeKind {
    /// Every kind; shaders know each by its place here.
    pub const ALL: [Self; 1] = [Self::Sphere];

    /// What shaders call it, in small letters.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
        }
    }
}

/// What a light reaches: a shape within a bounding sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightVolume {
    /// Shape of the volume.
    pub kind: VolumeKind,
    /// Centre of the bounding sphere, clustering space, metres.
    pub centre: DVec3,
    /// Radius of the bounding sphere, metres.
    pub radius: f64,
}

impl LightVolume {
    /// A sphere around `centre` (clustering space), lengths in metres.
    pub const fn sphere(centre: DVec3, radius: f64) -> Self {
        Self { kind: VolumeKind::Sphere, centre, radius }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_stands_at_its_own_place() {
        for (place, kind) in VolumeKind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, place);
        }
    }
}
