//! What lights reach, as tests against clusters take it.

use super::SphericalSector;
use glam::DVec3;

/// The shape of what a light reaches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum VolumeKind {
    /// All around the light, up to a radius: the bounding sphere itself.
    Sphere,
    /// Within a cone from the light, up to a range: a spherical sector.
    Sector,
}

impl VolumeKind {
    /// Every kind; shaders know each by its place here.
    pub const ALL: [Self; 2] = [Self::Sphere, Self::Sector];

    /// What shaders call it, in small letters.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Sector => "sector",
        }
    }
}

/// What a light reaches: a shape within a bounding sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightVolume {
    /// Centre of the bounding sphere, metres, in the space of what it is tested against: clustering space, of octrees the world's.
    pub centre: DVec3,
    /// Radius of the bounding sphere, metres.
    pub radius: f64,
    /// Of a spot light, what part of the sphere it reaches, in the same space.
    pub sector: Option<SphericalSector>,
}

impl LightVolume {
    /// A sphere around `centre`, lengths in metres.
    pub const fn sphere(centre: DVec3, radius: f64) -> Self {
        Self { centre, radius, sector: None }
    }

    /// What a spot light reaches.
    pub fn sector(sector: SphericalSector) -> Self {
        let (centre, radius) = sector.bounding_sphere();
        Self { centre, radius, sector: Some(sector) }
    }

    /// The shape of the volume.
    pub const fn kind(&self) -> VolumeKind {
        match self.sector {
            None => VolumeKind::Sphere,
            Some(_) => VolumeKind::Sector,
        }
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
        assert_eq!(LightVolume::sphere(DVec3::ZERO, 1.0).kind(), VolumeKind::Sphere);
        let sector = SphericalSector { apex: DVec3::ZERO, axis: DVec3::X, range: 1.0, half_angle: 0.5 };
        assert_eq!(LightVolume::sector(sector).kind(), VolumeKind::Sector);
    }
}
