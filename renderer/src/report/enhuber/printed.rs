//! The numbers that the thesis prints (table 4.3, figure 4.12), and where they were measured.

/// Mean frame times of a kind of methods under 10 000 lights, at the sizes that the thesis selects.
pub struct Printed {
    /// The kind's name.
    pub kind: &'static str,
    /// Milliseconds in Robot Lab, Sponza and Viking Village.
    pub ms: [f64; 3],
}

/// The scenes of [`Printed::ms`].
pub const SCENES: [&str; 3] = ["Robot Lab", "Sponza", "Viking Village"];

/// The machine of the thesis (table 4.1).
pub const MACHINE: &str =
    "Intel Core i5-4670K, NVIDIA GeForce GTX 780 (driver 415.25), Linux 4.14.92, Vulkan 1.1.84, 1920 × 1080";

/// Every kind, in the thesis's order. M in Robot Lab is not printed: it is what its fitted line gives at 10 000 lights,
/// 0.56 ms and 9.32 µs a light.
pub const MEANS: [Printed; 8] = [
    Printed { kind: "t-i", ms: [43.66, 73.44, 66.76] },
    Printed { kind: "t-e", ms: [16.00, 18.82, 23.05] },
    Printed { kind: "dc-i", ms: [25.82, 31.64, 27.05] },
    Printed { kind: "dc-e", ms: [9.14, 8.87, 9.50] },
    Printed { kind: "sc-i", ms: [12.93, 12.27, 12.07] },
    Printed { kind: "sc-e", ms: [9.75, 9.75, 9.90] },
    Printed { kind: "g", ms: [26.93, 43.18, 30.20] },
    Printed { kind: "m", ms: [93.76, 2259.77, 1700.07] },
];

/// The kind that others are told as ratios to.
pub const BASE: &str = "t-e";

impl Printed {
    /// Over those of [`BASE`].
    pub fn ratios(&self) -> [f64; 3] {
        let base = MEANS.iter().find(|printed| printed.kind == BASE).map_or([1.0; 3], |printed| printed.ms);
        std::array::from_fn(|scene| self.ms[scene] / base[scene])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::enhuber::evaluation::EIGHT;

    #[test]
    fn every_kind_is_printed_once_and_the_ratios_are_to_tiles() {
        assert_eq!(MEANS.each_ref().map(|printed| printed.kind), EIGHT);
        let ratios = |kind| MEANS.iter().find(|printed| printed.kind == kind).unwrap().ratios();
        assert_eq!(ratios(BASE), [1.0; 3]);
        assert!((ratios("t-i")[0] - 2.72875).abs() < 1e-9 && (ratios("m")[1] - 120.072_794_9).abs() < 1e-6);
        assert!((MEANS[7].ms[0] - (0.56 + 9.32 * 10.0)).abs() < 1e-9);
    }
}
