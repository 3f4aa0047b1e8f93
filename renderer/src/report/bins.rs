//! Rows of the heat maps: every value its own below 8, then four rows an octave.

/// The row of `value`: 0 to 7 for themselves; 8 for 8 and 9, 12 for 16 to 19, and so on.
pub fn row(value: u64) -> usize {
    if value < 8 {
        return value as usize;
    }
    let octave = value.ilog2();
    let quarter = (value >> (octave - 2)) & 3;
    8 + (octave as usize - 3) * 4 + quarter as usize
}

/// The least value of a row.
pub fn first(row: usize) -> u64 {
    if row < 8 {
        return row as u64;
    }
    let (octave, quarter) = (3 + (row - 8) / 4, (row - 8) % 4);
    (4 + quarter as u64) << (octave - 2)
}

/// The greatest value of a row.
pub fn last(row: usize) -> u64 {
    first(row + 1) - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_tile_the_numbers() {
        for value in (0..5000).chain([1 << 20, (1 << 32) - 1]) {
            let row = row(value);
            assert!(first(row) <= value && value <= last(row), "{value} in row {row}");
        }
        assert_eq!([7, 8, 9, 10, 15, 16, 19, 20, 4096].map(row), [7, 8, 8, 9, 11, 12, 12, 13, 44]);
    }
}
