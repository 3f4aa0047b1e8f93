//! Falling lights: point lights that fall through a box and start anew at its top (Gelderen chapter 6).
//!
//! The state of frame f is f steps after the spawn, one step a frame, each of the recording's time step:
//! v += g; v *= damping; p += v * dt. A drop that has left the box respawns in the slab at its top with a new
//! position and velocity; its tint stays. Each of a light's lives draws from a generator of its own, seeded from
//! (seed, light, life), and the step uses single-precision `+`, `-` and `*` alone: light k of frame f has the
//! same bits on every machine, however frames are skipped, batched or threaded, and however many lights there are.

use crate::json::{Check, Problem};
use crate::lights::{Lighting, PointLight};
use crate::{Error, Result};
use rand_core::Rng;
use rand_pcg::Pcg32;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Lights that one task steps at least; fewer are not worth handing to another thread.
const LIGHTS_PER_TASK: usize = 1024;

/// What the rain is like. The default is the rain of Gelderen's chapter 6, in the box of both its scenes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RainParameters {
    /// Seed of all random choices: the same seed gives the same lights on every machine.
    pub seed: u64,
    /// Lowest corner of the box, metres.
    pub box_min: [f32; 3],
    /// Highest corner of the box, metres.
    pub box_max: [f32; 3],
    /// Lowest velocity of a new drop, m/s.
    pub velocity_min: [f32; 3],
    /// Highest velocity of a new drop, m/s.
    pub velocity_max: [f32; 3],
    /// Lowest and highest value of a tint's channels.
    pub tint: [f32; 2],
    /// What is added to the velocity in every step, m/s.
    pub gravity_step: [f32; 3],
    /// Multiplies the velocity in every step, after gravity.
    pub damping: f32,
    /// Height of the slab at the box's top where drops respawn, as a fraction of the box's height.
    pub respawn_slab: f32,
}

impl Default for RainParameters {
    fn default() -> Self {
        Self {
            seed: 1,
            box_min: [-60.0, -20.0, -60.0],
            box_max: [80.0, 60.0, 60.0],
            velocity_min: [0.2, -20.0, 1.0],
            velocity_max: [1.2, -14.0, 2.3],
            tint: [0.5, 1.0],
            gravity_step: [0.0, -0.04, 0.0],
            damping: 0.99,
            respawn_slab: 0.01,
        }
    }
}

impl Check for RainParameters {
    fn check(&self) -> Result<(), Problem> {
        let sane = |values: &[f32]| values.iter().all(|value| value.abs() <= 1e6);
        let ordered = |low: &[f32], high: &[f32]| {
            sane(low) && sane(high) && low.iter().zip(high).all(|(low, high)| low <= high)
        };
        let filled = self.box_min.iter().zip(self.box_max).all(|(low, high)| *low < high);
        let fault = |field: &'static str, message: &str| Err(Problem::new(message).under(field));
        if !(ordered(&self.box_min, &self.box_max) && filled) {
            return fault("box_max", "must lie above box_min on every axis, and both within +-1e6 m");
        }
        if !ordered(&self.velocity_min, &self.velocity_max) {
            return fault("velocity_max", "must not lie below velocity_min, and both within +-1e6 m/s");
        }
        if !(ordered(&self.tint[..1], &self.tint[1..]) && self.tint[0] >= 0.0) {
            return fault("tint", "must be a lowest and a highest value, 0 or above, in this order");
        }
        if !sane(&self.gravity_step) {
            return fault("gravity_step", "must lie within +-1e6 m/s");
        }
        if !(0.0..=1.0).contains(&self.damping) {
            return fault("damping", "must lie within 0..1");
        }
        if !(self.respawn_slab > 0.0 && self.respawn_slab <= 1.0) {
            return fault("respawn_slab", "must lie above 0 and not above 1");
        }
        Ok(())
    }
}

/// How flat a box of rain may be: its shortest side over its longest.
const FLATTEST: f32 = 0.1;

impl RainParameters {
    /// The default rain in the box from `low` to `high` (metres). Speeds and gravity are scaled with its sides, so that a
    /// drop falls through it in the same time. A side too short for rain is stretched, upwards or to both sides.
    pub fn within(low: [f32; 3], high: [f32; 3]) -> Self {
        let usual = Self::default();
        let side = |axis: usize| high[axis] - low[axis];
        let least = (FLATTEST * side(0).max(side(1)).max(side(2))).max(1e-3);
        let [box_min, box_max] = [-1.0, 1.0].map(|sign: f32| {
            std::array::from_fn(|axis| {
                let missing = (least - side(axis)).max(0.0);
                match (axis, sign < 0.0) {
                    (1, true) => low[1],
                    (1, false) => high[1] + missing,
                    (_, true) => low[axis] - 0.5 * missing,
                    (_, false) => high[axis] + 0.5 * missing,
                }
            })
        });
        let scaled = |values: [f32; 3]| -> [f32; 3] {
            std::array::from_fn(|axis| {
                let usual_side = usual.box_max[axis] - usual.box_min[axis];
                values[axis] * ((box_max[axis] - box_min[axis]) / usual_side)
            })
        };
        Self {
            velocity_min: scaled(usual.velocity_min),
            velocity_max: scaled(usual.velocity_max),
            gravity_step: scaled(usual.gravity_step),
            box_min,
            box_max,
            ..usual
        }
    }

    /// A drop at the start of life `life` (0: the spawn) of light `light`.
    fn start(&self, light: u32, life: u32) -> ([f32; 3], Motion, Pcg32) {
        let mut random = generator(self.seed, light, life);
        let mut lowest = self.box_min;
        if life > 0 {
            lowest[1] = self.box_max[1] - self.respawn_slab * (self.box_max[1] - self.box_min[1]);
        }
        let position = uniform_vector(&mut random, lowest, self.box_max);
        let velocity = uniform_vector(&mut random, self.velocity_min, self.velocity_max);
        (position, Motion { velocity, life }, random)
    }

    /// Whether a position lies in the box. No short cut: six comparisons cost less than a branch guessed wrong.
    fn holds(&self, [x, y, z]: [f32; 3]) -> bool {
        let ([x0, y0, z0], [x1, y1, z1]) = (self.box_min, self.box_max);
        (x >= x0) & (x <= x1) & (y >= y0) & (y <= y1) & (z >= z0) & (z <= z1)
    }

    /// One step of `dt` seconds for light `light`.
    fn step(&self, dt: f32, light: u32, position: &mut [f32; 3], motion: &mut Motion) {
        let ([x, y, z], [u, v, w], [gx, gy, gz]) = (*position, motion.velocity, self.gravity_step);
        let [u, v, w] = [(u + gx) * self.damping, (v + gy) * self.damping, (w + gz) * self.damping];
        motion.velocity = [u, v, w];
        *position = [x + u * dt, y + v * dt, z + w * dt];
        if !self.holds(*position) {
            (*position, *motion, _) = self.start(light, motion.life.wrapping_add(1));
        }
    }
}

/// What a light needs besides its [`PointLight`] to go on falling.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Motion {
    /// m/s.
    velocity: [f32; 3],
    /// How often it has respawned.
    life: u32,
}

/// N falling lights at one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Rain {
    parameters: RainParameters,
    /// What all lights have in common.
    template: PointLight,
    dt: f32,
    frame: u32,
    lights: Vec<PointLight>,
    motions: Vec<Motion>,
}

impl Rain {
    /// The rain of `lighting` at `frame`, stepped by `dt_s` seconds a frame (the recording's time step).
    ///
    /// # Errors
    /// [`Error::Input`] where parameters, lighting or time step are out of range, or the lights do not fit into
    /// memory.
    pub fn new(parameters: &RainParameters, lighting: &Lighting, dt_s: f64, frame: u32) -> Result<Self> {
        parameters.check().map_err(|problem| Error::input(format!("rain: {problem}")))?;
        let dt = dt_s as f32;
        if !(dt.is_finite() && dt > 0.0) {
            return Err(Error::input(format!("rain: a time step of {dt_s} s is not above 0")));
        }
        let template = PointLight::new([0.0; 3], [1.0; 3], lighting.intensity, lighting.cutoff, lighting.r0);
        template.check().map_err(|(field, message)| Error::input(format!("lights: {field}: {message}")))?;
        let mut rain = Self {
            parameters: *parameters,
            template,
            dt,
            frame: 0,
            lights: reserve(lighting.count)?,
            motions: reserve(lighting.count)?,
        };
        rain.spawn(lighting.count);
        rain.advance_to(frame);
        Ok(rain)
    }

    /// Goes to `frame`, forwards by stepping, backwards by falling anew from frame 0.
    pub fn advance_to(&mut self, frame: u32) {
        if frame < self.frame {
            self.spawn(self.lights.len() as u32);
        }
        let (steps, dt, parameters) = (frame - self.frame, self.dt, self.parameters);
        let pairs = self.lights.par_iter_mut().zip(&mut self.motions).enumerate();
        pairs.with_min_len(LIGHTS_PER_TASK).for_each(|(light, (point, motion))| {
            for _ in 0..steps {
                parameters.step(dt, light as u32, &mut point.position, motion);
            }
        });
        self.frame = frame;
    }

    /// The lights, in the order of their indices.
    pub fn lights(&self) -> &[PointLight] {
        &self.lights
    }

    /// The frame that [`Rain::lights`] belongs to.
    pub fn frame(&self) -> u32 {
        self.frame
    }

    fn spawn(&mut self, count: u32) {
        let (parameters, template) = (self.parameters, self.template);
        let [low, high] = parameters.tint;
        let start = |light| {
            let (position, motion, mut random) = parameters.start(light, 0);
            let tint = uniform_vector(&mut random, [low; 3], [high; 3]);
            (PointLight { position, tint, ..template }, motion)
        };
        let lights = (0..count).into_par_iter().with_min_len(LIGHTS_PER_TASK);
        lights.map(start).unzip_into_vecs(&mut self.lights, &mut self.motions);
        self.frame = 0;
    }
}

/// An empty list with room for `count` elements, or an error instead of an abort.
fn reserve<T>(count: u32) -> Result<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(count as usize)
        .map_err(|_| Error::input(format!("{count} lights do not fit into memory; ask for fewer")))?;
    Ok(list)
}

/// The generator of one life of one light: its own stream, and a state that no other seed or life is near to.
fn generator(seed: u64, light: u32, life: u32) -> Pcg32 {
    let key = u64::from(light) << 32 | u64::from(life);
    Pcg32::new(scramble(seed ^ scramble(key)), key)
}

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014; constants of Vigna's version).
fn scramble(value: u64) -> u64 {
    let value = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let value = (value ^ (value >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    value ^ (value >> 31)
}

/// Uniform in low..=high on each axis, in steps of 2^-24 of the range.
fn uniform_vector(random: &mut Pcg32, low: [f32; 3], high: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|axis| {
        let fraction = (random.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0);
        (low[axis] + fraction * (high[axis] - low[axis])).min(high[axis])
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const DT: f64 = 1.0 / 90.0;

    fn lighting(count: u32) -> Lighting {
        Lighting { count, intensity: 100.0, cutoff: 0.5, r0: 0.1 }
    }

    fn rain(count: u32, frame: u32) -> Rain {
        Rain::new(&RainParameters::default(), &lighting(count), DT, frame).unwrap()
    }

    fn bits(light: &PointLight) -> [u32; 6] {
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
        assert_eq!(
            after.lights()[0].position[1],
            before.lights()[0].position[1] + velocity * (1.0_f32 / 90.0)
        );
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
}
