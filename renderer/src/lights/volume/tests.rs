use super::*;
use crate::lights::place::LightBox;
use proptest::prelude::*;

const ROOM: Corners = Corners { min: [0.0, 0.0, 0.0], max: [20.0, 5.0, 10.0] };

fn recipe(volumes: &[&str], set: Option<&str>) -> VolumeRecipe {
    VolumeRecipe {
        seed: 1,
        volumes: volumes.iter().map(|text| text.parse().unwrap()).collect(),
        set: set.map(|text| text.parse().unwrap()),
    }
}

fn placed(recipe: &VolumeRecipe, count: u32) -> Vec<PlacedVolume> {
    let place = |volume: Option<&LatticeBox>| match volume.and_then(|volume| volume.place) {
        Some(LightBox::Corners(corners)) => corners,
        _ => ROOM,
    };
    recipe.placed(count, place).unwrap()
}

fn lights(recipe: &VolumeRecipe, count: u32) -> Vec<Light> {
    recipe.lights(&placed(recipe, count), &Lighting::with_count(count)).unwrap()
}

fn lattices(recipe: &VolumeRecipe, count: u32) -> Vec<[u32; 3]> {
    placed(recipe, count).iter().map(|volume| volume.lattice).collect()
}

#[test]
fn sets_are_read_as_they_are_written() {
    for text in ["1x_1y_1z", "3x_2y_1z"] {
        assert_eq!(text.parse::<LightSet>().unwrap().to_string(), text);
    }
    assert_eq!("3x_2y_1z".parse::<LightSet>().unwrap().factor(), 6);
    for wrong in ["", "1x_1y", "4x_1y_1z", "0x_1y_1z", "1y_1x_1z", "1x_1y_1z_1w", "+1x_1y_1z", "1x1y1z"] {
        assert!(
            wrong.parse::<LightSet>().unwrap_err().starts_with(&format!("`{wrong}` is no set")),
            "{wrong}"
        );
    }
}

#[test]
fn volumes_are_read_as_they_are_written() {
    for text in
        ["10x4x10", "scene:1x2x3", "rain:1x2x3:0,1,0,1", "-5,0,-5,5,4,5:10x4x10:0.5,0,0,1:23", "1x1x1:2.5"]
    {
        assert_eq!(text.parse::<LatticeBox>().unwrap().to_string(), text);
    }
    for (wrong, part) in [
        ("", "is no volume"),
        ("10x4", "is no volume"),
        ("10x4x-1", "is no volume"),
        ("scene:10x4x10:1,0,0", "is no volume"),
        ("scene:10x4x10:0,0,0,1:2:3", "is no volume"),
        ("street:10x4x10", "`street` is no box"),
        ("0x4x10", "has no light along an axis"),
        ("70000x70000x1", "has no light along an axis, or more"),
        ("1x1x1:0,0,0,0", "quaternion of no length"),
        ("1x1x1:0", "lights of radius 0 m"),
    ] {
        let message = wrong.parse::<LatticeBox>().unwrap_err();
        assert!(message.contains(part), "{wrong}: {message}");
    }
}

#[test]
fn a_lattice_that_nobody_gave_has_cells_nearest_to_cubes() {
    // Cells of 20 x 5 x 10 m over 4 x 1 x 2 are cubes, and so over eight times as many.
    assert_eq!(lattices(&recipe(&[], None), 8), [[4, 1, 2]]);
    assert_eq!(lattices(&recipe(&[], None), 64), [[8, 2, 4]]);
    assert_eq!(lattices(&recipe(&[], Some("1x_3y_1z")), 24), [[4, 3, 2]]);
    assert_eq!(lattice::nearest_to_cubes(7, [20.0, 5.0, 10.0]), [7, 1, 1]);
    assert_eq!(lattice::nearest_to_cubes(16, [4.0, 0.0, 4.0]), [4, 1, 4]);
    assert_eq!(lattice::nearest_to_cubes(6, [0.0; 3]).iter().product::<u32>(), 6);
}

#[test]
fn a_set_multiplies_the_lattice_along_its_axes() {
    let two = |set| recipe(&["10x4x5", "rain:2x2x2"], set);
    assert_eq!(lattices(&two(None), 208), [[10, 4, 5], [2, 2, 2]]);
    assert_eq!(lattices(&two(None), 416), [[20, 4, 5], [4, 2, 2]]);
    assert_eq!(lattices(&two(Some("1x_2y_1z")), 416), [[10, 8, 5], [2, 4, 2]]);
    assert_eq!(lattices(&two(None), 208 * 6), [[30, 8, 5], [6, 4, 2]]);
    assert_eq!(lattices(&two(None), 208 * 27), [[30, 12, 15], [6, 6, 6]]);
}

#[test]
fn a_number_that_no_lattice_has_is_refused_with_those_that_it_has() {
    let refused = |volumes: &[&str], set, count| recipe(volumes, set).check(count).unwrap_err();
    assert_eq!(
        refused(&["10x4x5"], None, 500),
        "500 lights: no set of lattices with 200 in all has so many: ask for one of 200, 400, 600, 800, 1200, 1600, \
         1800, 2400, 3600, 5400"
    );
    assert_eq!(
        refused(&["10x4x5"], Some("2x_2y_1z"), 400),
        "400 lights: the set 2x_2y_1z of lattices with 200 in all has 800: ask for so many"
    );
    assert_eq!(
        refused(&[], Some("3x_1y_1z"), 1000),
        "1000 lights: the set 3x_1y_1z has a multiple of 3, such as 999"
    );
    assert_eq!(
        refused(&[], Some("3x_1y_1z"), 2),
        "2 lights: the set 3x_1y_1z has a multiple of 3, such as 3"
    );
    assert_eq!(recipe(&[], None).check(10_007), Ok(()));
}

#[test]
fn lights_stand_in_the_middles_of_cells_with_x_fastest() {
    let made = lights(&recipe(&["0,0,0,4,1,2:2x1x2"], None), 4);
    let places: Vec<_> = made.iter().map(|light| light.position).collect();
    assert_eq!(places, [[1.0, 0.5, 0.5], [3.0, 0.5, 0.5], [1.0, 0.5, 1.5], [3.0, 0.5, 1.5]]);
}

#[test]
fn a_box_is_turned_about_its_middle() {
    // A quarter turn about y takes +x to -z; the length of the quaternion does not matter.
    let made = lights(&recipe(&["0,0,0,4,1,2:2x1x1:0,3,0,3"], None), 2);
    for (light, place) in made.iter().zip([[2.0, 0.5, 2.0], [2.0, 0.5, 0.0]]) {
        for axis in 0..3 {
            assert!((light.position[axis] - place[axis]).abs() < 1e-6, "{:?} {place:?}", light.position);
        }
    }
}

#[test]
fn lights_have_the_radius_of_their_volume_or_of_the_lighting() {
    let made = lights(&recipe(&["1x1x1", "1x1x1:0.1"], None), 2);
    made.iter().for_each(|light| light.check().unwrap());
    assert_eq!((made[0].intensity, made[0].r1), (100.0, 200_f32.sqrt()));
    assert_eq!((made[1].cutoff, made[1].r1, made[1].r0), (0.5, 0.1, 0.05));
    assert!((made[1].intensity - 0.005).abs() < 1e-9);
}

#[test]
fn hues_follow_from_the_seed_alone() {
    let tints = |seed, count| -> Vec<_> {
        let recipe = VolumeRecipe { seed, ..recipe(&[], None) };
        lights(&recipe, count).iter().map(|light| light.tint.map(f32::to_bits)).collect()
    };
    assert_eq!(tints(1, 100)[..50], tints(1, 50));
    assert_ne!(tints(1, 50), tints(2, 50));
    assert_eq!(tints(1, 2), PINNED, "{:#010x?}", tints(1, 2));
}

/// Bits of the hues of lights 0 and 1.
const PINNED: [[u32; 3]; 2] = [[0, 0x3f800000, 0x3f038a8c], [0, 0x3f1908f8, 0x3f800000]];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Whatever the count, there are so many different places, all within the box.
    #[test]
    fn lattices_fill_their_box(count in 1_u32..2000) {
        let made = lights(&recipe(&[], None), count);
        prop_assert_eq!(made.len(), count as usize);
        let places: std::collections::BTreeSet<_> = made.iter().map(|light| light.position.map(f32::to_bits)).collect();
        prop_assert_eq!(places.len(), count as usize);
        for light in &made {
            for axis in 0..3 {
                prop_assert!(light.position[axis] > ROOM.min[axis] && light.position[axis] < ROOM.max[axis]);
            }
        }
        let mean = made.iter().map(|light| f64::from(light.position[0])).sum::<f64>() / f64::from(count);
        prop_assert!((mean - 10.0).abs() < 1e-4, "even along x: {mean}");
    }
}
