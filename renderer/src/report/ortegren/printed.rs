//! What the paper prints (table C.1): nodes, and milliseconds of assignment and of shading, on a GeForce GTX 970.

/// Numbers of lights, half of them spots.
pub const LIGHTS: [u32; 4] = [400, 1000, 2000, 4000];

/// Grids of tiles and slices, in the table's order; each by exponential slices, then by linear ones.
pub const GRIDS: [[u32; 3]; 6] =
    [[24, 12, 32], [24, 12, 64], [24, 12, 128], [48, 24, 32], [48, 24, 64], [48, 24, 128]];

/// Nodes that were assigned, by lights, then by grid and law.
pub const NODES: [[f64; 12]; 4] = [
    [21809., 18413., 38137., 31144., 70647., 56576., 75317., 58500., 131777., 98409., 244977., 177697.],
    [51735., 46804., 89976., 79613., 166084., 145125., 176991., 148540., 308398., 250849., 570954., 454694.],
    [
        111352., 98203., 194582., 167294., 360630., 305231., 383065., 312243., 672104., 527930., 1249466.,
        958518.,
    ],
    [
        224822., 196729., 393160., 335930., 730033., 613473., 774062., 625930., 1359897., 1061304., 2531817.,
        1929030.,
    ],
];

/// Shells and fills of points and spots together, milliseconds.
pub const ASSIGNMENT: [[f64; 12]; 4] = [
    [0.1291, 0.1293, 0.1472, 0.1386, 0.1815, 0.1553, 0.1514, 0.1569, 0.1762, 0.1721, 0.2376, 0.2122],
    [0.2323, 0.2271, 0.2566, 0.2415, 0.3095, 0.2722, 0.2872, 0.2888, 0.3154, 0.3156, 0.4036, 0.3845],
    [0.4147, 0.4119, 0.4463, 0.4377, 0.5129, 0.4915, 0.5321, 0.5331, 0.5883, 0.5827, 0.7390, 0.7117],
    [0.7558, 0.7523, 0.8039, 0.7975, 0.9036, 0.8893, 0.9834, 0.9831, 1.0792, 1.0749, 1.3652, 1.3100],
];

/// Shading, milliseconds.
pub const SHADING: [[f64; 12]; 4] = [
    [0.5105, 0.5819, 0.4600, 0.5861, 0.4261, 0.5323, 0.4589, 0.5191, 0.4172, 0.5253, 0.3925, 0.4565],
    [0.8099, 0.7959, 0.6982, 0.7421, 0.6426, 0.6897, 0.6928, 0.6932, 0.6043, 0.6674, 0.5634, 0.5989],
    [1.3857, 1.3613, 1.1820, 1.1866, 1.0722, 1.0984, 1.1468, 1.1703, 0.9858, 1.0297, 0.9049, 0.9365],
    [2.6166, 2.5162, 2.2099, 2.1890, 2.0194, 2.0310, 2.1567, 2.1579, 1.8402, 1.8747, 1.6907, 1.7239],
];

/// A table's number for lights, grid and law; `None` where the paper has none.
pub fn printed(table: &[[f64; 12]; 4], lights: u32, grid: [u32; 3], linear: bool) -> Option<f64> {
    let row = LIGHTS.iter().position(|&known| known == lights)?;
    let column = GRIDS.iter().position(|&known| known == grid)?;
    Some(table[row][2 * column + usize::from(linear)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_by_lights_grid_and_law() {
        assert_eq!(printed(&NODES, 4000, [24, 12, 32], true), Some(196_729.0));
        assert_eq!(printed(&SHADING, 400, [48, 24, 128], false), Some(0.3925));
        assert_eq!(printed(&ASSIGNMENT, 401, [24, 12, 32], false), None);
        assert_eq!(printed(&ASSIGNMENT, 400, [24, 13, 32], false), None);
    }
}
