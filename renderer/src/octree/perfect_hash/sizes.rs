//! How large the table of a perfect hash is, and that of its offsets.

/// Largest side all of whose slots an offset of 8 bits reaches.
const REACHED: u32 = 255;

/// Slots per key where offsets do not reach all slots.
const SPARE: f64 = 1.01;

/// Keys per offset of the first attempt (Lefebvre and Hoppe section 4: 1/(2d) offsets a key in d dimensions).
const KEYS_PER_OFFSET: f64 = 6.0;

/// How much the side of the table of offsets grows from one attempt to the next, as its part of one. By half as much again at
/// once, as Tegelaers has it, it comes out up to three times as large as it has to be, and its size depends on the seed.
const GROWTH: u32 = 16;

/// How many sizes of the table of offsets are tried: up to more than 20 times the first side.
const ATTEMPTS: usize = 60;

/// The least odd side of a table with `slack` slots for each of some keys.
pub(super) fn slot_side(keys: usize, slack: f64) -> u32 {
    let side = odd_side(keys as f64 * slack.max(1.0));
    if side > REACHED { odd_side(keys as f64 * slack.max(SPARE)) } else { side }
}

/// Sides of the table of offsets to try in turn for a table of keys.
pub(super) fn offset_sides(keys: usize, side: u32) -> impl Iterator<Item = u32> {
    let first = fitting(odd_side(keys as f64 / KEYS_PER_OFFSET), side);
    std::iter::successors(Some(first), move |last| {
        (side > 1).then(|| fitting((last + last.div_ceil(GROWTH)) | 1, side))
    })
    .take(ATTEMPTS)
}

/// The least odd side from `least` on by which keys are spread otherwise than by the table's: sides without a common divisor,
/// and not such that keys one bucket apart are one slot apart.
fn fitting(least: u32, side: u32) -> u32 {
    let fits = |offset_side: &u32| {
        let rest = side % offset_side;
        *offset_side == 1 || (gcd(side, *offset_side) == 1 && rest != 1 && rest != offset_side - 1)
    };
    (least..).step_by(2).find(fits).expect("a side above the table's that shares no divisor with it")
}

/// The least odd side of a cube of `cells`.
fn odd_side(cells: f64) -> u32 {
    let mut side = (cells.cbrt() as u32).saturating_sub(1) | 1;
    while f64::from(side).powi(3) < cells {
        side += 2;
    }
    side
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_the_least_odd_cubes_that_hold_all_keys() {
        let sides = [1, 2, 27, 28, 125, 126].map(|keys| slot_side(keys, 1.0));
        assert_eq!(sides, [1, 3, 3, 5, 5, 7]);
        assert_eq!(slot_side(64, 2.0), 7, "128 slots");
        // 255 is reached by all offsets of 8 bits; past it slots are spared.
        assert_eq!(slot_side(255_usize.pow(3), 1.0), 255);
        assert_eq!(slot_side(257_usize.pow(3), 1.0), 259);
    }

    #[test]
    fn sides_of_offsets_share_nothing_with_the_tables() {
        for side in (3..200).step_by(2) {
            let keys = (side as usize).pow(3);
            let sides: Vec<u32> = offset_sides(keys, side).collect();
            assert!(f64::from(sides[0]).powi(3) >= keys as f64 / 6.0);
            assert!(sides.windows(2).all(|pair| pair[1] > pair[0]));
            for offset_side in sides.into_iter().filter(|offset_side| *offset_side > 1) {
                assert_eq!((gcd(side, offset_side), offset_side % 2), (1, 1));
                assert!(![1, offset_side - 1].contains(&(side % offset_side)));
            }
        }
        assert_eq!(offset_sides(1, 1).collect::<Vec<_>>(), [1], "one slot needs no offset");
    }
}
