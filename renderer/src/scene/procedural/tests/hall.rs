//! The hall is whole, of the size it says, and its recording flies through it.

use super::*;
use crate::recording::load;

static HALL: LazyLock<Scene> = LazyLock::new(hall);

/// Farther than the near plane's corner: 0.2 m, and 0.46 m from a Vive eye.
const CLEARANCE: f32 = 0.6;

#[test]
fn it_is_whole() {
    check_structure(&HALL);
    check_materials(&HALL, 20);
    assert!((240_000..260_000).contains(&HALL.triangle_count()), "{}", HALL.triangle_count());
    assert!((300..=400).contains(&HALL.instances.len()), "{} models", HALL.instances.len());
    assert_eq!(by_name("hall").as_ref(), Some(&*HALL));
    assert!(NAMES.contains(&HALL.name.as_str()));
}

#[test]
fn it_is_reproducible() {
    assert_eq!((&HALL.sha256[..16], texture_hash(&HALL).as_str()), ("e92558f18801a96c", "9c6a8485db0d97f5"));
    assert_eq!(*HALL, hall());
}

#[test]
fn it_is_as_large_as_it_says() {
    let (low, high) = HALL.bounds().unwrap();
    for (size, meant) in (high - low).to_array().into_iter().zip([37.2, 15.6, 22.9]) {
        assert!((size - meant).abs() < 0.2, "{size} m instead of {meant} m");
    }
}

#[test]
fn its_recordings_go_through_free_space_near_walls() {
    for name in ["hall", "aisle"] {
        check_clearance(&HALL, &recorded(name), CLEARANCE);
    }
    assert!(nearest(&HALL, &recorded("hall")) < 1.0);
}

#[test]
fn it_rains_inside() {
    let (low, high) = HALL.bounds().unwrap();
    for name in ["hall", "hall-vive", "aisle"] {
        let rain = *load(name).unwrap().rain().unwrap();
        for axis in 0..3 {
            let inside =
                f64::from(rain.box_min[axis]) >= low[axis] && f64::from(rain.box_max[axis]) <= high[axis];
            let most = f64::from(rain.box_max[axis] - rain.box_min[axis]) > 0.9 * (high[axis] - low[axis]);
            assert!(inside && most, "{name}: {rain:?}");
        }
        assert!(rain.velocity_max[1] < 0.0);
    }
}

#[test]
fn both_its_recordings_are_one_flight() {
    let (mono, vive, street) =
        (load("hall").unwrap(), load("hall-vive").unwrap(), load("bistro-vive").unwrap());
    assert_eq!(mono.file().frames, vive.file().frames);
    assert_eq!((mono.rain(), &street.file().hmd), (vive.rain(), &vive.file().hmd));
}
