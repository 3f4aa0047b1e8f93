//! What single passes are tried on: grids, visible clusters and lights, the same in every run.

use crate::Result;
use crate::geometry::views::Pose;
use crate::geometry::{ClusterSpace, Frustum, Grid, SliceLaw, Slices};
use crate::lights::rain::{Rain, RainParameters};
use crate::lights::{Light, Lighting, Spot};
use crate::methods::{Method, Sharing, Space};
use glam::{DQuat, DVec3};

/// A method of perspective grids.
pub const PERSP: Method = Method::grid(Sharing::Indi, Space::Persp { pixels: 64.0 });
/// A method of orthographic grids.
pub const ORTHO: Method = Method::grid(Sharing::Indi, Space::Ortho { metres: 4.0 });

/// A method of perspective grids whose cells are tested as boxes, and whose slices are found by a sum.
pub const ORTIZ: Method =
    Method::grid(Sharing::Indi, Space::Counted { columns: 16.0, rows: 9.0, slices: 24.0 });

/// Where grids lie, and views look from.
pub fn pose() -> Pose {
    Pose { position: DVec3::new(1.0, 2.0, 3.0), rotation: DQuat::from_rotation_y(0.7), mirror: None }
}

/// Boxes of two metres.
pub fn box_grid(dimensions: [u32; 3]) -> Grid {
    let max = DVec3::from_array(dimensions.map(f64::from));
    Grid { pose: pose(), space: ClusterSpace::Orthographic { min: -max, max }, dimensions }
}

/// Pieces of a frustum from 0.4 to 100 metres.
pub fn frustum_grid(dimensions: [u32; 3]) -> Grid {
    let frustum = Frustum { x0: -1.2, x1: 1.0, y0: -0.7, y1: 0.9, z0: -100.0, z1: -0.4 };
    let ratio = (100.0f64 / 0.4).powf(1.0 / f64::from(dimensions[2])) - 1.0;
    Grid { pose: pose(), space: ClusterSpace::geometric(frustum, ratio), dimensions }
}

/// The same pieces between the slices of a law.
pub fn sliced(law: SliceLaw) -> Grid {
    let mut grid = frustum_grid([13, 9, 21]);
    if let ClusterSpace::Perspective { frustum, slices } = &mut grid.space {
        *slices = Slices::new(law, frustum, 250f64.powf(1.0 / 21.0) - 1.0, 21.0);
    }
    grid
}

/// Points, and twice as many spots from narrow to wide.
pub fn points_and_spots(count: u32) -> Vec<Light> {
    let mut random = noise(77);
    let mut unit = move || -> f32 { (random() % 65_536) as f32 / 65_536.0 };
    let lights = random_lights(count, 21, 14.0, |u| 1.0 + 7.0 * u);
    let with_cone = |(number, light): (usize, Light)| {
        let direction = [0; 3].map(|_| 2.0 * unit() - 1.0);
        let outer: f32 = 2.0 + 88.0 * unit().powi(2);
        let spot = Spot::new(direction, 0.0, outer.to_radians());
        light.shining((number % 3 != 0).then_some(spot))
    };
    lights.into_iter().enumerate().map(with_cone).collect()
}

/// Falling lights, all of one radius.
///
/// # Errors
/// They do not fit into memory.
pub fn rain(count: u32) -> Result<Vec<Light>> {
    let lighting = Lighting { count, intensity: 20.0, cutoff: 0.5, r0: 0.1 };
    Ok(Rain::new(&RainParameters::default(), &lighting, 1.0 / 90.0, 30)?.lights().to_vec())
}

/// Lights in a box of `extent` metres to each side, with radii that `radius` makes of numbers from 0 to 1.
pub fn random_lights(count: u32, seed: u64, extent: f32, radius: impl Fn(f32) -> f32) -> Vec<Light> {
    let mut random = noise(seed);
    let mut unit = move || (random() % 65_536) as f32 / 65_536.0;
    (0..count)
        .map(|_| Light {
            position: [0; 3].map(|_| (2.0 * unit() - 1.0) * extent),
            tint: [1.0; 3],
            intensity: 1.0,
            cutoff: 0.5,
            r0: 0.01,
            r1: radius(unit()),
            spot: None,
        })
        .collect()
}

/// A small deterministic generator; quality does not matter here.
pub fn noise(seed: u64) -> impl FnMut() -> u32 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 32) as u32
    }
}

/// Bits with about one in `sparsity` set, none beyond `clusters`.
pub fn random_bits(clusters: u64, sparsity: u32, seed: u64) -> Vec<u32> {
    let mut random = noise(seed);
    let mut bits = vec![0; clusters.div_ceil(32) as usize];
    for cluster in 0..clusters {
        if random().is_multiple_of(sparsity) {
            bits[(cluster / 32) as usize] |= 1 << (cluster % 32);
        }
    }
    bits
}

/// A fragment in each cluster whose bit is set.
pub fn fragments_of(bits: &[u32], clusters: u64) -> Vec<u32> {
    (0..clusters).map(|c| bits[(c / 32) as usize] >> (c % 32) & 1).collect()
}
