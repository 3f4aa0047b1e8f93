//! Lights on regular lattices in oriented boxes, of random fully saturated hues (Tegelaers section 3.3).
//!
//! ```text
//! volumes (box, turn, lattice) ──┐
//! set ax_by_cz ──────────────────┼─> a lattice of each box ─> lights, box by box, x fastest ─> hue k of seed
//! count of the lighting ─────────┘
//! ```
//!
//! A volume's lattice NX x NY x NZ is that of the set 1x_1y_1z; the set ax_by_cz has a, b and c times as many lights
//! along the box's own axes, so base*a*b*c in all, where the base is the sum over the volumes. Lights stand in the
//! middles of equal cells. Without volumes there is one, whose lattice has the cells nearest to cubes. The lights do
//! not move.

mod lattice;
mod set;
mod shape;

pub use set::LightSet;
pub use shape::LatticeBox;

use super::place::Corners;
use super::random::{generator, saturated_hue};
use super::{Light, Lighting, reserve};
use crate::{Error, Result};
use glam::{DQuat, DVec3};

/// How lights are laid out in volumes.
#[derive(Debug, Clone, PartialEq)]
pub struct VolumeRecipe {
    /// Seed of the hues.
    pub seed: u64,
    /// The volumes; where there are none, the box of the lights is one.
    pub volumes: Vec<LatticeBox>,
    /// How many times as many lights along each axis; found from the number of lights where `None`.
    pub set: Option<LightSet>,
}

/// A volume where boxes are known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedVolume {
    /// The box before it is turned about its middle.
    pub within: Corners,
    /// How it is turned.
    pub turn: Option<[f32; 4]>,
    /// Lights along each of its axes.
    pub lattice: [u32; 3],
    /// Where its lights end, metres; as the lighting has it where `None`.
    pub r1: Option<f32>,
}

impl VolumeRecipe {
    /// Refuses a number of lights that the lattices cannot have.
    ///
    /// # Errors
    /// Names the numbers that they can have.
    pub(crate) fn check(&self, count: u32) -> Result<(), String> {
        self.set_of(count).map(drop)
    }

    /// The set that has `count` lights.
    fn set_of(&self, count: u32) -> Result<LightSet, String> {
        if self.volumes.is_empty() {
            return lattice::set_of_one(count, self.set);
        }
        let base = self.volumes.iter().map(|volume| u64::from(volume.light_count())).sum();
        lattice::set_of_base(count, base, self.set)
    }

    /// The volumes of `count` lights, which [`Self::check`] lets pass; `place` gives a volume's box.
    pub(super) fn placed(
        &self,
        count: u32,
        place: impl Fn(Option<&LatticeBox>) -> Corners,
    ) -> Result<Vec<PlacedVolume>, String> {
        let set = self.set_of(count)?;
        if self.volumes.is_empty() {
            let within = place(None);
            let base = lattice::nearest_to_cubes(count / set.factor(), within.sides());
            return Ok(vec![PlacedVolume { within, turn: None, lattice: set.times(base), r1: None }]);
        }
        let placed = |volume: &LatticeBox| PlacedVolume {
            within: place(Some(volume)),
            turn: volume.turn,
            lattice: set.times(volume.lattice),
            r1: volume.r1,
        };
        Ok(self.volumes.iter().map(placed).collect())
    }

    /// The lights of volumes.
    ///
    /// # Errors
    /// [`Error::Input`] where they do not fit into memory, or are not as many as the lighting says.
    pub(super) fn lights(&self, volumes: &[PlacedVolume], lighting: &Lighting) -> Result<Vec<Light>> {
        let mut lights = reserve(lighting.count)?;
        for volume in volumes {
            let template = match volume.r1 {
                Some(r1) => lighting.light_of_radius([0.0; 3], [1.0; 3], r1),
                None => lighting.light(),
            };
            for position in volume.positions() {
                let tint = saturated_hue(&mut generator(self.seed, lights.len() as u32, 0));
                lights.push(Light { position, tint, ..template });
            }
        }
        if lights.len() != lighting.count as usize {
            return Err(Error::Internal(format!(
                "{} lights on lattices of {}",
                lights.len(),
                lighting.count
            )));
        }
        Ok(lights)
    }
}

impl PlacedVolume {
    /// Middles of the lattice's cells, x fastest, world space, metres.
    fn positions(&self) -> impl Iterator<Item = [f32; 3]> {
        let Self { within, lattice: [nx, ny, nz], .. } = *self;
        let [low, high] = [within.min, within.max].map(|[x, y, z]| DVec3::new(x.into(), y.into(), z.into()));
        let (middle, cell) = (0.5 * (low + high), (high - low) / DVec3::new(nx.into(), ny.into(), nz.into()));
        let turn = self.turn.map_or(DQuat::IDENTITY, |[x, y, z, w]| {
            DQuat::from_xyzw(x.into(), y.into(), z.into(), w.into()).normalize()
        });
        let place = move |x: u32, y: u32, z: u32| {
            let from_low = (DVec3::new(x.into(), y.into(), z.into()) + 0.5) * cell;
            (middle + turn * (low + from_low - middle)).as_vec3().to_array()
        };
        (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| place(x, y, z))))
    }
}

#[cfg(test)]
mod tests;
