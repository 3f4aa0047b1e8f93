//! The city is whole, of the size it says, and its recording flies through it and jumps where it says.

use super::*;
use crate::recording::load;

static CITY: LazyLock<Scene> = LazyLock::new(city);

/// Farther than the near plane's corner.
const CLEARANCE: f32 = 0.6;

#[test]
fn it_is_whole() {
    check_structure(&CITY);
    check_materials(&CITY, 15);
    assert!((150_000..200_000).contains(&CITY.triangle_count()), "{}", CITY.triangle_count());
    assert!((900..=1000).contains(&CITY.instances.len()), "{} models", CITY.instances.len());
    assert_eq!(by_name("city").as_ref(), Some(&*CITY));
    assert!(NAMES.contains(&CITY.name.as_str()));
}

#[test]
fn it_is_reproducible() {
    assert_eq!((&CITY.sha256[..16], texture_hash(&CITY).as_str()), ("edb4bb5caa42e036", "f2d50a80f976f2e0"));
    assert_eq!(*CITY, city());
}

#[test]
fn it_is_as_large_as_it_says() {
    let (low, high) = CITY.bounds().unwrap();
    for (size, meant) in (high - low).to_array().into_iter().zip([480.0, 29.2, 480.0]) {
        assert!((size - meant).abs() < 0.2, "{size} m instead of {meant} m");
    }
}

#[test]
fn its_recording_flies_through_free_space() {
    check_clearance(&CITY, &recorded("city"), CLEARANCE);
}

#[test]
fn its_recording_jumps_twice_and_nowhere_else() {
    let recording = load("city").unwrap();
    let frames = &recording.file().frames;
    assert_eq!(frames.len(), 463);
    let steps = frames.windows(2).map(|pair| pair[0].head.position.distance(pair[1].head.position));
    let jumps: Vec<usize> = steps.enumerate().filter(|(_, step)| *step > 3.0).map(|(k, _)| k + 1).collect();
    assert_eq!(jumps, [100, 167]);
}
