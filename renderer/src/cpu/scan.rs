//! Exclusive prefix sum.

/// The exclusive prefix sum of `values`, and behind it their total: one entry more than `values` has.
///
/// A sum that 32 bits do not hold is all ones, as on the device.
pub fn scan(values: &[u32]) -> Vec<u32> {
    let mut sums = Vec::with_capacity(values.len() + 1);
    let mut sum = 0u32;
    sums.push(sum);
    for &value in values {
        sum = sum.saturating_add(value);
        sums.push(sum);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_entry_is_the_sum_of_those_before_it() {
        assert_eq!(scan(&[]), [0]);
        assert_eq!(scan(&[7]), [0, 7]);
        assert_eq!(scan(&[3, 0, 5, 1]), [0, 3, 3, 8, 9]);
        assert_eq!(scan(&[u32::MAX, 3]), [0, u32::MAX, u32::MAX]);
    }
}
