//! What shaders count.

/// Parts of an octave, a factor of 2, in which [`DeviceCounts::depth_steps`] is told.
pub const OCTAVE_PARTS: u32 = 1 << 16;

/// Declares the counters, each a line.
macro_rules! counters {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// What the shaders of an atemporal run count, 64 bits each. In GLSL a counter is `COUNTER_` and its name in
        /// capitals.
        #[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
        pub struct DeviceCounts {
            $($(#[$doc])* pub $name: u64,)*
        }

        impl DeviceCounts {
            /// Names of the counters, in the order in which the device has them.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($name)),*];

            /// Counters as the device has them: of each the low word, then the high one.
            pub fn from_words(words: &[u32]) -> Self {
                let mut counts =
                    words.chunks_exact(2).map(|pair| u64::from(pair[0]) | u64::from(pair[1]) << 32);
                Self { $($name: counts.next().unwrap_or(0),)* }
            }

            /// Adds the counts of another clustering.
            pub fn add(&mut self, other: &Self) {
                $(self.$name += other.$name;)*
            }
        }
    };
}

counters! {
    /// Fragment shader invocations that shaded.
    fragments_shaded,
    /// Fragments that are seen whose cluster was not marked visible; always 0.
    fragments_without_cluster,
    /// Evaluations of one light for one fragment.
    lighting_computations,
    /// Lighting computations whose light is closer than R1.
    needed_computations,
    /// Tests of a light's volume against a cluster or a node.
    intersection_tests,
    /// Fragments that were shaded and are hidden in the end, with overdraw.
    fragments_hidden,
    /// Lights that capped lists were too full for.
    lights_dropped,
    /// Lights that get onto no list of a cluster that they meet, for they lie behind all of its samples.
    lights_skipped,
    /// Octaves by which the distances of neighbouring pixels of the first view differ, all together, in [`OCTAVE_PARTS`].
    depth_steps,
    /// Pairs of neighbouring pixels that these are of: both show something.
    depth_pairs,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counters_are_read_in_the_order_of_their_names() {
        let words: Vec<u32> = (0..DeviceCounts::NAMES.len() as u32).flat_map(|place| [place, 1]).collect();
        let mut counts = DeviceCounts::from_words(&words);
        assert_eq!(DeviceCounts::NAMES[2], "lighting_computations");
        assert_eq!(counts.lighting_computations, (1 << 32) + 2);
        counts.add(&DeviceCounts { needed_computations: 7, ..DeviceCounts::default() });
        assert_eq!((counts.needed_computations, counts.intersection_tests), ((1 << 32) + 10, (1 << 32) + 4));
    }
}
