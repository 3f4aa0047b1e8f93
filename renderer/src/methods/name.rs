//! A method's name: the name of its kind and its sizes, as plain decimal numbers: `indi-persp-64`, `encl-ortho-0.5`,
//! `indi-displ-64-32`, `tiled-16`, `sc-e-48-40`, `ortiz-16-9-24`, `clustered-mm-32`, `g-20`, `m`, `hashed-0.5-3`, `hashed-2m-3`,
//! `all-lights`. A size may have its unit behind it.

use super::sizes::Size;
use super::{KINDS, Kind, Method};
use crate::{Error, Result};
use std::fmt;
use std::str::FromStr;

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind().name)?;
        self.sizes().iter().try_for_each(|size| write!(f, "-{size}"))?;
        f.write_str(self.kind().suffix)
    }
}

impl FromStr for Method {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        parse(name).ok_or_else(|| {
            let patterns = KINDS.iter().map(Kind::pattern).collect::<Vec<_>>().join(", ");
            let nearest = nearest(name);
            Error::input(format!(
                "method '{name}' is not known: use one of {patterns}, with sizes above 0, of columns, rows, slices and depth whole ones (SIZE \
                 in radii of the smallest light, or in metres as 2m; DEPTH from 0); did you mean '{nearest}'?"
            ))
        })
    }
}

fn parse(name: &str) -> Option<Method> {
    KINDS.iter().find_map(|kind| {
        let rest = name.strip_prefix(kind.name)?.strip_suffix(kind.suffix)?;
        let mut parts = rest.split('-');
        let sizes: Option<Vec<Size>> = parts.next()?.is_empty().then(|| parts.map(Size::parse).collect())?;
        sizes.filter(|sizes| kind.takes(sizes)).map(|sizes| kind.with_sizes(&sizes))
    })
}

/// The valid name nearest to `name`, with its sizes where they fit.
fn nearest(name: &str) -> String {
    let parts = || name.split('-');
    let words: Vec<&str> = parts().filter(|part| part.starts_with(char::is_alphabetic)).collect();
    let sizes: Vec<&str> = parts().filter(|part| Size::parse(part).is_some()).collect();
    let word = words.join("-").to_ascii_lowercase();
    let distance = |kind: &&Kind| strsim::damerau_levenshtein(kind.name, &word);
    let kind = KINDS.iter().min_by_key(distance).unwrap_or(&KINDS[0]);
    let own_sizes = format!("{}-{}{}", kind.name, sizes.join("-"), kind.suffix);
    parse(&own_sizes).unwrap_or_else(|| kind.tuned()).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::{Sharing, Space};
    use proptest::prelude::*;

    #[test]
    fn names_read_and_print_the_same() {
        for name in [
            "indi-ortho-0.5",
            "encl-displ-16-0.25",
            "tiled-12.5",
            "t-e-28",
            "dc-i-12.5-64",
            "g-20",
            "m",
            "hashed-0.5-3",
            "hashed-2m-0",
            "ortiz-16-9-24",
            "raster-24-12-32-e",
            "raster-48-24-128-l",
            "encl-raster-24-12-64-e",
            "tiled-mm-32",
            "clustered-mm-12.5",
            "all-lights",
        ] {
            assert_eq!(name.parse::<Method>().unwrap().to_string(), name);
        }
        assert_eq!("indi-persp-64.0".parse::<Method>().unwrap().to_string(), "indi-persp-64");
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
            ("tile-8", "'tiled-8'"),
            ("tiled-8-2", "'tiled-16'"),
            ("dc-e-64-2.5", "'dc-e-64-40'"),
            ("sc-e-64", "'sc-e-48-40'"),
            ("g-0", "'g-20'"),
            ("G-8", "'g-8'"),
            ("m-2", "'m'"),
            ("hashed-0-3", "'hashed-0.5-3'"),
            ("hashed-0.25", "'hashed-0.5-3'"),
            ("hashd-0.25m-2", "'hashed-0.25m-2'"),
            ("hashed-1-2.5", "'hashed-0.5-3'"),
            ("hashed-1-3m", "'hashed-0.5-3'"),
            ("indi-ortho-4m", "'indi-ortho-4'"),
            ("ortiz-16-9", "'ortiz-16-9-24'"),
            ("ortiz-16-9-0", "'ortiz-16-9-24'"),
            ("ortiz-16.5-9-24", "'ortiz-16-9-24'"),
            ("ortis-8-4-12", "'ortiz-8-4-12'"),
            ("tiled-mm", "'tiled-mm-32'"),
            ("clustered-16", "'clustered-mm-16'"),
            ("", "did you mean"),
        ] {
            let message = wrong.parse::<Method>().unwrap_err().to_string();
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
            let spec = Method::grid(sharing, space);
            prop_assert_eq!(spec.to_string().parse::<Method>().unwrap(), spec);
        }
    }
}
