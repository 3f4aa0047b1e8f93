//! The world grid (Enhuber sections 2.5, 3.2): cells divide a box of the world, whatever the cameras see, so that one grid
//! serves any number of views, in mirrors too, and its lists are the same for all of them.
//!
//! ```text
//! lights, scene ──bounds──> grid (all cells) ──list_clusters──count, offsets, assign──> LightLists
//!                                             position of a sample ──cell──> its list (shading)
//! ```
//!
//! What lies outside the box looks its lights up in the nearest cell. That loses none while the centres of all lights lie in
//! the box: projection to a box brings a point no farther from any point of the box, so that a light that reaches the point
//! reaches the nearest cell as well. Nor does it where all that is shaded lies inside, whatever the lights do.
//!
//! [`plan()`] says how many cells there are, [`settled`] where they lie once a frame's lights are known.
//! `lookup/world.glsl` finds the cell of a sample; passes are those of the other grids, and so are their twins.

mod settle;

pub use settle::{GridBox, settled};

use super::{Method, Scenery};
use crate::geometry::views::Pose;
use crate::geometry::{ClusterSpace, Grid};
use crate::{Error, Result};
use glam::DVec3;

/// Most cells along an axis: as many as the indices of all cells allow.
const MOST_CELLS: u32 = 512;

/// A method of cells that divide a box of the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorldGrid {
    /// Cells along each axis, a whole number.
    pub cells: f64,
}

/// The grid of a frame, of so many cells around the world's origin; [`settled`] gives it its place.
///
/// # Errors
/// A number of cells that is not whole, or above 512.
pub fn plan(method: WorldGrid) -> Result<Grid> {
    let WorldGrid { cells } = method;
    if cells.fract() != 0.0 || !(1.0..=f64::from(MOST_CELLS)).contains(&cells) {
        let name = Method::World(method);
        return Err(Error::input(format!(
            "method {name}: {cells} cells along each axis are no whole number from 1 to {MOST_CELLS}"
        )));
    }
    let space = ClusterSpace::Orthographic { min: -DVec3::ONE, max: DVec3::ONE };
    Ok(Grid { pose: Pose::IDENTITY, space, dimensions: [cells as u32; 3] })
}

#[cfg(test)]
mod tests;
