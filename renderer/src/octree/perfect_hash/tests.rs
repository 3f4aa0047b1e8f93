//! Perfect hashes of keys as octrees have them, and of such as they do not.

use super::*;
use proptest::prelude::*;
use std::collections::BTreeSet;

const SETTINGS: HashSettings = HashSettings { seed: 23, slack: 1.0, most_slots: 1 << 25 };

/// Checks that all keys have slots of their own in the table.
fn check(keys: &[UVec3], hash: &PerfectHash) {
    assert_eq!(hash.offsets.len(), (hash.offset_side as usize).pow(3));
    let slots: BTreeSet<usize> = keys.iter().map(|key| hash.slot(*key)).collect();
    assert_eq!(slots.len(), keys.len());
    assert!(slots.last().is_none_or(|slot| *slot < (hash.side as usize).pow(3)));
}

fn distinct(keys: Vec<[u32; 3]>) -> Vec<UVec3> {
    let keys: BTreeSet<[u32; 3]> = keys.into_iter().collect();
    keys.into_iter().map(UVec3::from_array).collect()
}

/// The cells of a shell around the middle of a cube of 40.
fn shell() -> Vec<UVec3> {
    let cells = (0..40_u32.pow(3)).map(|at| UVec3::new(at % 40, at / 40 % 40, at / 1600));
    cells.filter(|cell| (100.0..200.0).contains(&(cell.as_dvec3() - 19.5).length_squared())).collect()
}

#[test]
fn a_surface_fills_a_table_of_nearly_its_size() {
    // The table is 19^3 = 6859.
    let keys = &shell()[..6800];
    for seed in 0..4 {
        let hash = PerfectHash::build(keys, &HashSettings { seed, ..SETTINGS }).unwrap();
        check(keys, &hash);
        assert_eq!(hash, PerfectHash::build(keys, &HashSettings { seed, ..SETTINGS }).unwrap());
        assert_eq!(hash.side, 19);
        assert!((hash.offset_side as usize).pow(3) < keys.len(), "{} keys, {}", keys.len(), hash.offset_side);
    }
}

#[test]
fn a_full_cube_is_stored_in_one_of_its_size() {
    let keys: Vec<UVec3> = (0..27).map(|at| UVec3::new(at % 3, at / 3 % 3, at / 9)).collect();
    let hash = PerfectHash::build(&keys, &SETTINGS).unwrap();
    check(&keys, &hash);
    assert_eq!(hash.side, 3);
}

#[test]
fn no_keys_take_one_slot() {
    let hash = PerfectHash::build(&[], &SETTINGS).unwrap();
    assert_eq!((hash.side, hash.offset_side, hash.slot(UVec3::new(7, 8, 9))), (1, 1, 0));
}

#[test]
fn keys_that_agree_by_both_sides_get_more_offsets() {
    // Two keys make a table of 3^3 slots with one offset, by which they are the same.
    let keys = [UVec3::ZERO, UVec3::new(3, 0, 0)];
    let hash = PerfectHash::build(&keys, &SETTINGS).unwrap();
    check(&keys, &hash);
    assert!(hash.offset_side > 1);
}

#[test]
fn offsets_of_8_bits_serve_tables_that_they_do_not_reach_across() {
    let keys = shell();
    let hash = PerfectHash::build(&keys, &HashSettings { slack: 2500.0, ..SETTINGS }).unwrap();
    assert!(hash.side > 256);
    check(&keys, &hash);
}

#[test]
fn tables_past_the_limit_are_refused() {
    let settings = HashSettings { most_slots: 100, ..SETTINGS };
    assert_eq!(PerfectHash::build(&shell(), &settings), Err(HashError::TooLarge(21_usize.pow(3))));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn every_key_has_a_slot_of_its_own(
        keys in proptest::collection::vec([0..40_u32, 0..40_u32, 0..40_u32], 1..500), seed: u64, slack in 1.0..3.0f64,
    ) {
        let keys = distinct(keys);
        check(&keys, &PerfectHash::build(&keys, &HashSettings { seed, slack, ..SETTINGS }).unwrap());
    }

    /// Coordinates of 21 bits, and such as have many divisors.
    #[test]
    fn keys_far_apart_have_slots_of_their_own(
        keys in proptest::collection::vec([0..40_u32, 0..40_u32, 0..40_u32], 1..100), step in 1..50_000_u32,
    ) {
        let keys: Vec<UVec3> = distinct(keys).into_iter().map(|key| key * step).collect();
        check(&keys, &PerfectHash::build(&keys, &SETTINGS).unwrap());
    }
}
