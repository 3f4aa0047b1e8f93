//! What sorting the samples of tiles takes of a workgroup, and which tiles it cannot sort.

use crate::gpu_interface::SORT_TILE_SLICES;

/// Keys of a sorted tile: one for each of its samples, filled up to a power of two.
pub const fn sorted_keys(pixels: u32, samples: u32) -> u32 {
    (pixels * pixels * samples).next_power_of_two()
}

/// Threads of a workgroup that sorts so many keys: each takes eight at a time, in turns where there are very many.
pub const fn sorted_threads(keys: u32) -> u32 {
    match keys / 8 {
        ..8 => 8,
        threads @ 8..128 => threads,
        128.. => 128,
    }
}

/// Shared memory of a workgroup that sorts so many keys, bytes: the keys, a sum a thread, a bit a slice, and what is counted.
const fn sorted_bytes(keys: u32) -> u32 {
    4 * (keys + sorted_threads(keys) + SORT_TILE_SLICES / 32 + 4)
}

/// Most keys of a sorted tile: more have no room in their lower half.
const MOST_SORTED: u32 = 1 << 16;

/// Why tiles so wide, of so many samples a pixel, cannot be sorted by a workgroup with `shared` bytes of memory.
///
/// # Errors
/// Says how many samples there are, and how many there could be.
pub fn check_sorted_tiles(pixels: u32, samples: u32, shared: u32) -> Result<(), String> {
    let all = u64::from(pixels).pow(2) * u64::from(samples);
    let fits = |keys: &u32| *keys <= MOST_SORTED && sorted_bytes(*keys) <= shared;
    let most = (0..u32::BITS - 1).map(|power| 1 << power).take_while(fits).last().unwrap_or(0);
    if all <= most.into() {
        return Ok(());
    }
    Err(format!(
        "compaction: tiles of {pixels} x {pixels} pixels have {all} samples, and a workgroup sorts up to {most} in the {shared} bytes \
         that it shares: use smaller tiles, or --compaction ranks"
    ))
}

/// Why the tiles of a grid with so many slices cannot be sorted.
///
/// # Errors
/// Says how many slices there may be.
pub fn check_sorted_slices(slices: u32) -> Result<(), String> {
    if slices <= SORT_TILE_SLICES {
        return Ok(());
    }
    Err(format!(
        "compaction: tiles are sorted by up to {SORT_TILE_SLICES} slices, and the grid has {slices}: use larger tiles, or \
         --compaction ranks"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_sorted_where_their_samples_fit_a_workgroup() {
        for (pixels, samples, shared) in
            [(64, 1, 32 << 10), (32, 4, 32 << 10), (32, 1, 16 << 10), (1, 1, 16 << 10)]
        {
            check_sorted_tiles(pixels, samples, shared).unwrap();
        }
        for (pixels, samples, shared, most) in [
            (65, 1, 32 << 10, 4096),
            (33, 4, 32 << 10, 4096),
            (64, 1, 16 << 10, 2048),
            (300, 1, 1 << 20, 65_536),
        ] {
            let message = check_sorted_tiles(pixels, samples, shared).unwrap_err();
            assert!(message.contains(&format!("sorts up to {most} in")), "{message}");
        }
        check_sorted_slices(SORT_TILE_SLICES).unwrap();
        assert!(check_sorted_slices(SORT_TILE_SLICES + 1).unwrap_err().contains("larger tiles"));
        assert_eq!([1, 64, 256, 1024, 4096].map(sorted_threads), [8, 8, 32, 128, 128]);
        assert_eq!([sorted_keys(28, 1), sorted_keys(32, 4), sorted_keys(1, 1)], [1024, 4096, 1]);
    }
}
