//! A method's name and parameters.
//!
//! Names are `sharing-space-size` with sizes as plain decimal numbers: `indi-persp-64`, `encl-ortho-0.5`,
//! `indi-displ-64-32`; and `all-lights`.

use crate::{Error, Result};
use std::fmt;
use std::str::FromStr;

/// How views share clusterings (Gelderen chapter 4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sharing {
    /// One clustering per view.
    Indi,
    /// One enclosing clustering for all views.
    Encl,
}

/// The shape of the clustering grid (Gelderen sections 3.1, 4.2, 4.3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Space {
    /// Perspective grid; the size of a cluster in pixels.
    Persp {
        /// Cluster side on the screen, pixels.
        pixels: f64,
    },
    /// Orthographic grid; the side of a cluster in metres.
    Ortho {
        /// Cluster side, metres.
        metres: f64,
    },
    /// Displaced perspective grid: apex moved back.
    Displ {
        /// Cluster side in pixels of the perspective grid whose average cluster volume is kept.
        pixels: f64,
        /// How far the apex moves back, metres.
        displacement: f64,
    },
}

/// A method: how the lights of a fragment are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MethodSpec {
    /// Brute force: every fragment evaluates every light.
    AllLights,
    /// Clustered shading.
    Clustered {
        /// One clustering per view, or one for all.
        sharing: Sharing,
        /// The grid.
        space: Space,
    },
}

impl fmt::Display for MethodSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Clustered { sharing, space } = self else { return f.write_str(ALL_LIGHTS) };
        let sharing = match sharing {
            Sharing::Indi => "indi",
            Sharing::Encl => "encl",
        };
        match space {
            Space::Persp { pixels } => write!(f, "{sharing}-persp-{pixels}"),
            Space::Ortho { metres } => write!(f, "{sharing}-ortho-{metres}"),
            Space::Displ { pixels, displacement } => write!(f, "{sharing}-displ-{pixels}-{displacement}"),
        }
    }
}

impl FromStr for MethodSpec {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        parse(name).ok_or_else(|| {
            Error::input(format!(
                "method '{name}' is not known: use {ALL_LIGHTS}, or indi- or encl- followed by persp-PIXELS, \
                 ortho-METRES or displ-PIXELS-METRES with sizes above 0; did you mean '{}'?",
                nearest(name)
            ))
        })
    }
}

const ALL_LIGHTS: &str = "all-lights";

/// One name of every kind, tuned as in Gelderen chapter 6.
const TUNED: [&str; 7] = [
    "indi-persp-64",
    "encl-persp-64",
    "indi-ortho-4",
    "encl-ortho-4",
    "indi-displ-64-32",
    "encl-displ-64-32",
    ALL_LIGHTS,
];

fn parse(name: &str) -> Option<MethodSpec> {
    if name == ALL_LIGHTS {
        return Some(MethodSpec::AllLights);
    }
    let (sharing, rest) = name.split_once('-')?;
    let sharing = match sharing {
        "indi" => Sharing::Indi,
        "encl" => Sharing::Encl,
        _ => return None,
    };
    let (kind, sizes) = rest.split_once('-')?;
    let space = match kind {
        "persp" => Space::Persp { pixels: size(sizes)? },
        "ortho" => Space::Ortho { metres: size(sizes)? },
        "displ" => {
            let (pixels, displacement) = sizes.split_once('-')?;
            Space::Displ { pixels: size(pixels)?, displacement: size(displacement)? }
        }
        _ => return None,
    };
    Some(MethodSpec::Clustered { sharing, space })
}

/// A plain decimal number above 0: digits and at most one point, no sign, no exponent.
fn size(text: &str) -> Option<f64> {
    let plain = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let value: f64 = if plain { text.parse().ok()? } else { return None };
    (value > 0.0 && value.is_finite()).then_some(value)
}

/// The valid name nearest to `name`, with its sizes where they fit.
fn nearest(name: &str) -> String {
    let (words, sizes): (Vec<&str>, Vec<&str>) = name.split('-').partition(|part| size(part).is_none());
    let kind = words.join("-").to_ascii_lowercase();
    let kind_of = |tuned: &str| tuned.trim_end_matches(|c: char| c == '-' || c.is_ascii_digit()).to_owned();
    let distance = |tuned: &&str| strsim::damerau_levenshtein(&kind_of(tuned), &kind);
    let tuned = TUNED.into_iter().min_by_key(distance).unwrap_or(ALL_LIGHTS);
    let own_sizes = format!("{}-{}", kind_of(tuned), sizes.join("-"));
    parse(&own_sizes).map_or(tuned.to_owned(), |spec| spec.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn names_read_and_print_the_same() {
        for name in TUNED.into_iter().chain(["indi-ortho-0.5", "encl-displ-16-0.25"]) {
            assert_eq!(name.parse::<MethodSpec>().unwrap().to_string(), name);
        }
        assert_eq!("indi-persp-64.0".parse::<MethodSpec>().unwrap().to_string(), "indi-persp-64");
    }

    #[test]
    fn a_wrong_name_is_answered_with_the_nearest_valid_one() {
        for (wrong, right) in [
            ("indi-prsp-32", "'indi-persp-32'"),
            ("encl-orto-2.5", "'encl-ortho-2.5'"),
            ("encl-displ-64", "'encl-displ-64-32'"),
            ("indi-persp", "'indi-persp-64'"),
            ("indi-persp-0", "'indi-persp-64'"),
            ("indi-persp-nan", "'indi-persp-64'"),
            ("indi-ortho-1e3", "'indi-ortho-4'"),
            ("indi-ortho--4", "'indi-ortho-4'"),
            ("indi-persp-64-32", "'indi-persp-64'"),
            ("Encl-Displ-8-2", "'encl-displ-8-2'"),
            ("all-light", "'all-lights'"),
            ("", "did you mean"),
        ] {
            let message = wrong.parse::<MethodSpec>().unwrap_err().to_string();
            assert!(message.contains(right) && message.contains("displ-PIXELS-METRES"), "{message}");
            assert!(!message.contains('\n'));
        }
    }

    proptest! {
        #[test]
        fn any_sizes_survive_the_round_trip(a in 1e-6..1e6f64, b in 1e-6..1e6f64, encl: bool, kind in 0..3) {
            let sharing = if encl { Sharing::Encl } else { Sharing::Indi };
            let space = match kind {
                0 => Space::Persp { pixels: a },
                1 => Space::Ortho { metres: a },
                _ => Space::Displ { pixels: a, displacement: b },
            };
            let spec = MethodSpec::Clustered { sharing, space };
            prop_assert_eq!(spec.to_string().parse::<MethodSpec>().unwrap(), spec);
        }
    }
}
