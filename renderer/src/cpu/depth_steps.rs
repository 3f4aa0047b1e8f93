//! How much depth jumps from pixel to pixel.

use crate::measure::OCTAVE_PARTS;

/// Bits of a logarithm behind the point.
const BITS: u32 = OCTAVE_PARTS.ilog2();

/// log2 of a normal positive number in parts of [`OCTAVE_PARTS`], rounded down. Bit by bit: squaring what is left doubles its logarithm,
/// and whether that comes to 2 or more is the next bit.
pub fn log2_parts(number: f32) -> i32 {
    let bits = number.to_bits();
    let exponent = (bits >> 23) as i32 - 127;
    // 1 to 2, with 31 bits behind the point.
    let mut rest = u64::from((bits | 0x80_0000) << 8);
    (0..BITS).fold(exponent, |result, _| {
        let square = rest * rest;
        let doubles = square >> 63;
        rest = if doubles == 1 { square >> 32 } else { square >> 31 };
        2 * result + doubles as i32
    })
}

/// Sum over pairs of neighbours, beside and above one another, of the difference of their distances' log2, in [`OCTAVE_PARTS`]; and how
/// many pairs there are. `distances` are a view's by rows of `width`, metres, infinite where nothing is seen: such pixels have no
/// pairs.
pub fn depth_steps(distances: &[f32], width: usize) -> (u64, u64) {
    let step = |a: usize, b: usize| {
        let [a, b] = [distances[a], distances[b]];
        (a.is_finite() && b.is_finite()).then(|| u64::from(log2_parts(a).abs_diff(log2_parts(b))))
    };
    let beside = (1..distances.len()).filter(|at| at % width != 0).filter_map(|at| step(at - 1, at));
    let above = (width..distances.len()).filter_map(|at| step(at - width, at));
    beside.chain(above).fold((0, 0), |(sum, pairs), step| (sum + step, pairs + 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ONE: u64 = OCTAVE_PARTS as u64;

    #[test]
    fn octaves_are_whole_and_neighbours_are_pairs_once() {
        assert_eq!(
            [0.25, 1.0, 2.0, 4096.0].map(log2_parts),
            [-2, 0, 1, 12].map(|octave| octave * OCTAVE_PARTS as i32)
        );
        let far = f32::INFINITY;
        assert_eq!(depth_steps(&[1.0, 2.0, 8.0, 4.0, 4.0, 8.0], 3), (7 * ONE, 7));
        assert_eq!(depth_steps(&[1.0, far, 8.0, 4.0, 4.0, far], 3), (2 * ONE, 2));
        assert_eq!(depth_steps(&[1.0, 2.0], 1), (ONE, 1));
        assert_eq!(depth_steps(&[far; 4], 2), (0, 0));
    }

    proptest! {
        #[test]
        fn parts_are_those_of_the_logarithm(number in 1e-3_f32..1e5) {
            let exact = f64::from(number).log2() * f64::from(OCTAVE_PARTS);
            let found = f64::from(log2_parts(number));
            prop_assert!((found - exact.floor()).abs() <= 1.0, "{found} {exact}");
        }
    }
}
