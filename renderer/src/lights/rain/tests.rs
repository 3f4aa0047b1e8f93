use super::*;
use proptest::prelude::*;

const DT: f64 = 1.0 / 90.0;

fn lighting(count: u32) -> Lighting {
    Lighting { count, intensity: 100.0, cutoff: 0.5, r0: 0.1 }
}

fn rain(count: u32, frame: u32) -> Rain {
    Rain::new(&RainParameters::default(), &lighting(count), DT, frame).unwrap()
}

fn bits(light: &Light) -> [u32; 6] {
    let ([x, y, z], [r, g, b]) = (light.position, light.tint);
    [x, y, z, r, g, b].map(f32::to_bits)
}

#[test]
fn in_the_usual_box_it_is_the_usual_rain_and_elsewhere_it_fills_the_box_at_all_times() {
    let usual = RainParameters::default();
    assert_eq!(RainParameters::within(usual.box_min, usual.box_max), usual);
    for (low, high) in [
        ([1.0, 2.0, 3.0], [1.5, 2.25, 3.5]),
        ([-900.0, 0.0, -900.0], [900.0, 0.0, 900.0]),
        ([5.0; 3], [5.0; 3]),
    ] {
        let parameters = RainParameters::within(low, high);
        for axis in 0..3 {
            assert!(parameters.box_min[axis] <= low[axis] && parameters.box_max[axis] >= high[axis]);
        }
        assert_eq!(parameters.box_min[1], low[1], "nothing falls below the ground");
        let rain = Rain::new(&parameters, &lighting(2000), DT, 300).unwrap();
        let middle = 0.5 * (parameters.box_min[1] + parameters.box_max[1]);
        let above = rain.lights().iter().filter(|light| light.position[1] > middle).count();
        assert!((600..1400).contains(&above), "{above} of 2000 in the upper half of {parameters:?}");
        assert!(rain.lights().iter().all(|light| parameters.holds(light.position)));
    }
}

#[test]
fn pinned_lights_are_the_same_on_every_machine() {
    let (first, later) = (rain(1000, 0), rain(1000, 300));
    let found: Vec<_> = [&first, &later]
        .iter()
        .flat_map(|rain| [0, 1, 999].map(|light| bits(&rain.lights()[light])))
        .collect();
    assert_eq!(found, PINNED, "{found:#010x?}");
}

/// Bits of position and tint of lights 0, 1 and 999 at frame 0, then at frame 300.
const PINNED: [[u32; 6]; 6] = [
    [0xbfac0500, 0x3f9a6980, 0x422f8994, 0x3f0467f0, 0x3f1befb7, 0x3f460faa],
    [0x419b1420, 0x40e07b78, 0x41ada910, 0x3f759d90, 0x3f073b4c, 0x3f3a8323],
    [0x4259bb3e, 0x4254579e, 0xc1d25984, 0x3f55d230, 0x3f1a832a, 0x3f1df86e],
    [0xc172965c, 0x42337865, 0x4195c775, 0x3f0467f0, 0x3f1befb7, 0x3f460faa],
    [0x419d0bcb, 0xc199b157, 0x41bfa073, 0x3f759d90, 0x3f073b4c, 0x3f3a8323],
    [0x425ae8f9, 0x41c8a758, 0xc1c7e748, 0x3f55d230, 0x3f1a832a, 0x3f1df86e],
];

#[test]
fn spawned_lights_fill_the_box_and_the_tints() {
    let (rain, parameters) = (rain(20_000, 0), RainParameters::default());
    for axis in 0..3 {
        let (low, high) = (parameters.box_min[axis], parameters.box_max[axis]);
        let mean = |values: &mut dyn Iterator<Item = f32>| {
            values.map(f64::from).sum::<f64>() / rain.lights().len() as f64
        };
        let position = mean(&mut rain.lights().iter().map(|l| (l.position[axis] - low) / (high - low)));
        let tint = mean(&mut rain.lights().iter().map(|l| l.tint[axis]));
        let speed = mean(&mut rain.motions.iter().map(|motion| {
            (motion.velocity[axis] - parameters.velocity_min[axis])
                / (parameters.velocity_max[axis] - parameters.velocity_min[axis])
        }));
        // The mean of n uniform values has the standard deviation 0.29/sqrt(n) = 0.002.
        assert!((position - 0.5).abs() < 0.01, "axis {axis}: {position}");
        assert!((tint - 0.75).abs() < 0.005, "axis {axis}: {tint}");
        assert!((speed - 0.5).abs() < 0.01, "axis {axis}: {speed}");
    }
    assert!((rain.lights()[0].r1 - 14.142_136).abs() < 1e-6);
}

#[test]
fn one_step_adds_gravity_damps_and_moves() {
    let (before, after) = (rain(1, 0), rain(1, 1));
    let velocity = (before.motions[0].velocity[1] - 0.04) * 0.99;
    assert_eq!(after.motions[0].velocity[1], velocity);
    assert_eq!(after.lights()[0].position[1], before.lights()[0].position[1] + velocity * (1.0_f32 / 90.0));
}

#[test]
fn drops_stay_in_the_box_and_respawn_in_its_top_slab_with_their_tint() {
    let (mut rain, parameters) = (rain(500, 0), RainParameters::default());
    let tints: Vec<_> = rain.lights().iter().map(|light| light.tint).collect();
    let mut respawns = 0;
    for frame in 1..=400 {
        let lives: Vec<_> = rain.motions.iter().map(|motion| motion.life).collect();
        rain.advance_to(frame);
        for (light, life) in lives.into_iter().enumerate() {
            let point = &rain.lights()[light];
            assert_eq!(point.tint, tints[light]);
            for axis in 0..3 {
                assert!(point.position[axis] >= parameters.box_min[axis]);
                assert!(point.position[axis] <= parameters.box_max[axis]);
            }
            if rain.motions[light].life != life {
                respawns += 1;
                assert!(point.position[1] >= 60.0 - 0.8 - 1e-4, "{:?}", point.position);
                assert!((-20.0..=-14.0).contains(&rain.motions[light].velocity[1]));
            }
        }
    }
    assert!(respawns > 100, "{respawns}");
}

#[test]
fn nonsense_is_refused_and_named() {
    let refused = |change: &dyn Fn(&mut RainParameters, &mut Lighting)| {
        let (mut parameters, mut lighting) = (RainParameters::default(), lighting(1));
        change(&mut parameters, &mut lighting);
        Rain::new(&parameters, &lighting, DT, 0).unwrap_err().to_string()
    };
    assert!(refused(&|p, _| p.box_max[2] = -60.0).starts_with("rain: box_max: "));
    assert!(refused(&|p, _| p.velocity_min[0] = f32::NAN).starts_with("rain: velocity_max: "));
    assert!(refused(&|p, _| p.damping = f32::NAN).starts_with("rain: damping: "));
    assert!(refused(&|p, _| p.respawn_slab = 0.0).starts_with("rain: respawn_slab: "));
    assert!(refused(&|p, _| p.tint = [0.6, 0.5]).starts_with("rain: tint: "));
    assert!(refused(&|_, l| l.cutoff = 0.0).starts_with("lights: i0: "));
    assert!(refused(&|_, l| l.r0 = 15.0).starts_with("lights: r0: "));
    assert!(Rain::new(&RainParameters::default(), &lighting(1), 0.0, 0).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Any way to a frame ends in the bits of a replay that goes frame by frame.
    #[test]
    fn every_way_to_a_frame_gives_the_same_lights(
        count in 1_u32..2000, hops in prop::collection::vec(0_u32..300, 1..5), seed: u64
    ) {
        let parameters = RainParameters { seed, ..RainParameters::default() };
        let mut hopping = Rain::new(&parameters, &lighting(count), DT, 0).unwrap();
        for &frame in &hops {
            hopping.advance_to(frame);
        }
        let last = *hops.last().unwrap();
        let mut replay = Rain::new(&parameters, &lighting(count), DT, 0).unwrap();
        (1..=last).for_each(|frame| replay.advance_to(frame));
        prop_assert_eq!(&hopping, &replay);
        prop_assert_eq!(&hopping, &Rain::new(&parameters, &lighting(count), DT, last).unwrap());
    }

    /// A light does not depend on how many others there are, nor on the number of threads.
    #[test]
    fn a_light_is_itself_in_any_company(count in 1_u32..5000, frame in 0_u32..300, threads in 1_usize..4) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let few = pool.install(|| rain(count, frame));
        let many = rain(5000, frame);
        prop_assert_eq!(few.lights(), &many.lights()[..count as usize]);
    }
}
