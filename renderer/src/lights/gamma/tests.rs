use super::*;
use proptest::prelude::*;

const DT: f64 = 1.0 / 90.0;
const ROOM: Corners = Corners { min: [-10.0, 0.0, -5.0], max: [10.0, 6.0, 25.0] };

fn recipe() -> GammaRecipe {
    GammaRecipe { seed: 1, radii: GammaRadii::default(), motion: LightMotion::Static, moving: 1.0 }
}

fn lights(recipe: &GammaRecipe, count: u32, frame: u32) -> Vec<Light> {
    let mut made = GammaLights::new(recipe, &Lighting::with_count(count), ROOM, DT).unwrap();
    made.at_frame(frame).list.to_vec()
}

fn radii(radii: GammaRadii, count: u32, seed: u64) -> Vec<f64> {
    (0..count).map(|light| radii.sample(&mut generator(seed, light, 0))).collect()
}

/// Mean and standard deviation.
fn moments(values: &[f64]) -> [f64; 2] {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    [mean, (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt()]
}

#[test]
fn the_parameters_of_the_paper_follow_from_mode_and_mean() {
    let radii = GammaRadii::default();
    assert!((radii.shape() - 4.0 / 3.0).abs() < 1e-15);
    assert_eq!(radii.scale(), 0.75);
}

#[test]
fn radii_have_the_papers_mean_deviation_and_mode() {
    let values = radii(GammaRadii::default(), 200_000, 1);
    let [mean, deviation] = moments(&values);
    assert!((mean - 1.0).abs() < 0.01, "{mean}");
    assert!((deviation - 0.866).abs() < 0.012, "{deviation}");
    // The density is within 0.5 % of its greatest at 0.2 and 0.3 m and has fallen by 7 % and more at 0.08 and 0.5 m.
    let near = |at: f64| values.iter().filter(|radius| (**radius - at).abs() < 0.04).count() as f64;
    let most = near(0.25);
    assert!(most > 1.03 * near(0.08) && most > 1.03 * near(0.5), "{most} {} {}", near(0.08), near(0.5));
    assert!((near(0.2) / most - 1.0).abs() < 0.04 && (near(0.3) / most - 1.0).abs() < 0.04);
}

/// The greatest distance between the distribution of `values` and the integral of the density.
fn kolmogorov_smirnov(radii: &GammaRadii, mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let (shape, scale) = (radii.shape(), radii.scale());
    let log_gamma = libm::lgamma(shape);
    let density = |x: f64| ((shape - 1.0) * (x / scale).ln() - x / scale - log_gamma).exp() / scale;
    let (mut below, mut at, mut greatest) = (0.0, 0.0, 0.0_f64);
    for (rank, value) in values.iter().enumerate() {
        // Steps between neighbours are small enough for the midpoint rule, but for the first, which is checked by the rest.
        let steps = 1 + ((value - at) / (0.002 * radii.mean)) as u32;
        let step = (value - at) / f64::from(steps);
        below += (0..steps).map(|k| density(at + (f64::from(k) + 0.5) * step) * step).sum::<f64>();
        at = *value;
        greatest = greatest.max((below - rank as f64 / values.len() as f64).abs());
    }
    greatest
}

#[test]
fn radii_follow_the_density_everywhere() {
    for (mode, mean, seed) in [(0.25, 1.0, 1), (0.0, 2.0, 2), (3.0, 4.0, 3), (0.1, 50.0, 4)] {
        let distribution = GammaRadii { mode, mean };
        let distance = kolmogorov_smirnov(&distribution, radii(distribution, 40_000, seed));
        // A distance of 1.95/sqrt(n) = 0.00975 has the probability 0.1 %.
        assert!(distance < 0.00975, "mode {mode}, mean {mean}: {distance}");
    }
    let other = GammaRadii { mode: 0.3, mean: 1.0 };
    let distance = kolmogorov_smirnov(&other, radii(GammaRadii::default(), 40_000, 1));
    assert!(distance > 0.012, "another mode is told apart: {distance}");
}

#[test]
fn pinned_lights_are_the_same_on_every_machine() {
    let made = lights(&recipe(), 1000, 0);
    let found = [0, 1, 999].map(|light: usize| {
        let Light { position: [x, y, z], tint: [r, ..], r1, .. } = made[light];
        [x, y, z, r, r1].map(f32::to_bits)
    });
    assert_eq!(found, PINNED, "{found:#010x?}");
}

/// Bits of position, red and radius of lights 0, 1 and 999.
const PINNED: [[u32; 5]; 3] = [
    [0xbfcf6e70, 0x3fcb94b7, 0x41a7c4ca, 0x3f129504, 0x3d048bd9],
    [0x3fab9bb8, 0x4001ac1e, 0x4176d488, 0x3f047e66, 0x3e89d3d3],
    [0x40cb1f20, 0x40af67c6, 0x405b4cf8, 0x3f0a7497, 0x403e4268],
];

#[test]
fn lights_end_at_their_radius_where_they_have_fallen_to_the_cutoff() {
    let made = lights(&recipe(), 5000, 0);
    for light in &made {
        light.check().unwrap();
        assert_eq!(light.cutoff, 0.5);
        assert!((light.intensity / (light.r1 * light.r1) / light.cutoff - 1.0).abs() < 1e-6);
        assert!(light.r0 == 0.1_f32.min(0.5 * light.r1));
    }
    let [mean, _] = moments(&made.iter().map(|light| f64::from(light.r1)).collect::<Vec<_>>());
    assert!((mean - 1.0).abs() < 0.06, "{mean}");
}

#[test]
fn lights_fill_the_box_and_the_tints() {
    let made = lights(&recipe(), 20_000, 0);
    let mean = |value: &dyn Fn(&Light) -> f32| {
        moments(&made.iter().map(|l| f64::from(value(l))).collect::<Vec<_>>())[0]
    };
    for axis in 0..3 {
        let (low, high) = (ROOM.min[axis], ROOM.max[axis]);
        assert!(made.iter().all(|light| (low..=high).contains(&light.position[axis])));
        let place = mean(&|light| (light.position[axis] - low) / (high - low));
        let tint = mean(&|light| light.tint[axis]);
        assert!((place - 0.5).abs() < 0.01 && (tint - 0.75).abs() < 0.005, "axis {axis}: {place} {tint}");
    }
}

#[test]
fn standing_lights_are_uploaded_once_and_moving_ones_with_every_frame() {
    let mut standing = GammaLights::new(&recipe(), &Lighting::with_count(50), ROOM, DT).unwrap();
    let first = standing.at_frame(0).list.to_vec();
    assert_eq!(standing.at_frame(300).list, first);
    assert_eq!(standing.at_frame(300).revision, standing.at_frame(7).revision);
    let bouncing = GammaRecipe { motion: LightMotion::Bounce, ..recipe() };
    let mut moving = GammaLights::new(&bouncing, &Lighting::with_count(50), ROOM, DT).unwrap();
    assert_eq!(moving.at_frame(0).list, first);
    assert_ne!(moving.at_frame(1).revision, moving.at_frame(2).revision);
    let later = moving.at_frame(90).list;
    for (light, first) in later.iter().zip(&first) {
        assert!((light.r1, light.tint) == (first.r1, first.tint) && light.position != first.position);
        assert!(light.position.iter().zip(first.position).all(|(a, b)| (a - b).abs() <= 1.0 + 1e-4));
    }
}

#[test]
fn a_part_of_the_lights_moves_and_the_others_are_as_they_were() {
    let all = GammaRecipe { motion: LightMotion::Bounce, ..recipe() };
    let few = GammaRecipe { moving: 0.1, ..all };
    let [first, of_all, of_few] = [lights(&all, 50, 0), lights(&all, 50, 90), lights(&few, 50, 90)];
    for (light, here) in of_few.iter().enumerate() {
        let expected = if light % 10 == 9 { &of_all } else { &first };
        assert_eq!(*here, expected[light], "{light}");
    }
}

#[test]
fn radii_that_cannot_be_are_refused() {
    let refused = |mode: f64, mean: f64| GammaRadii { mode, mean }.check().unwrap_err();
    assert!(refused(1.0, 1.0).starts_with("a most frequent radius of 1 m"));
    assert!(refused(-0.1, 1.0).starts_with("a most frequent radius of -0.1 m"));
    assert!(refused(f64::NAN, 1.0).starts_with("a most frequent radius of NaN m"));
    assert!(refused(0.25, 0.0).starts_with("a mean radius of 0 m"));
    assert!(refused(0.25, f64::NAN).starts_with("a mean radius of NaN m"));
    assert!(GammaRadii { mode: 0.0, mean: 1.0 }.check().is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Mean alpha beta, standard deviation sqrt(alpha) beta, and of both the mode: mean - variance/mean.
    #[test]
    fn moments_are_those_asked_for(mean in 0.05_f64..50.0, part in 0.0_f64..0.9, seed: u64) {
        let asked = GammaRadii { mode: part * mean, mean };
        let [found, deviation] = moments(&radii(asked, 40_000, seed));
        let expected = asked.shape().sqrt() * asked.scale();
        prop_assert!((found / mean - 1.0).abs() < 0.03, "{found} {mean}");
        prop_assert!((deviation / expected - 1.0).abs() < 0.06, "{deviation} {expected}");
        let mode = found - deviation * deviation / found;
        prop_assert!((mode - asked.mode).abs() < 0.13 * mean, "{mode} {asked:?}");
    }

    /// A light depends neither on how many others there are nor on threads nor on which frames came before.
    #[test]
    fn a_light_is_itself_in_any_company(
        count in 1_u32..3000, frame in 0_u32..400, before in 0_u32..400, threads in 1_usize..4, seed: u64
    ) {
        let recipe = GammaRecipe { seed, motion: LightMotion::Bounce, ..recipe() };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let few = pool.install(|| {
            let mut made = GammaLights::new(&recipe, &Lighting::with_count(count), ROOM, DT).unwrap();
            made.at_frame(before);
            made.at_frame(frame).list.to_vec()
        });
        prop_assert_eq!(&few[..], &lights(&recipe, 3000, frame)[..count as usize]);
    }
}
