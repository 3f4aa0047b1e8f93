//! The tests of a sphere against a cluster, by name.

use crate::nearest;
use std::fmt;
use std::str::FromStr;

/// Which test decides whether a sphere meets a cluster.
///
/// Its name is its identity everywhere: `exact`, `box`, `mm`, or what may separate the two, such as `hs`, `sat-epv`,
/// `hs+sat-n` (Enhuber sections 2.6 and 3.5.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SphereTest {
    /// They meet where the nearest point of the cluster lies in the sphere.
    Exact,
    /// They meet where the nearest point of the cluster's axis-aligned bounds lies in the sphere: exact for orthographic grids, conservative otherwise.
    Box,
    /// They meet where the rectangle in which the sphere is seen meets the cluster's, and its depths those of the cluster (Mara and
    /// McGuire, Tegelaers section 5.2): conservative; of clusters of perspective grids alone.
    Projected,
    /// They meet unless something separates them: conservative.
    Separating(Separators),
}

/// A set of what may separate a sphere from a cluster; not empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Separators(u8);

impl Separators {
    /// HS: a plane of the cluster, moved out by the radius (Gelderen section 3.3).
    pub const HALF_SPACES: Self = Self(1);
    /// SAT-E: axes along the cluster's edges.
    pub const EDGES: Self = Self(1 << 1);
    /// SAT-N: the axis from the centre to the nearest vertex.
    pub const NEAREST_VERTEX: Self = Self(1 << 2);
    /// SAT-P: axes along the normals of the cluster's planes.
    pub const NORMALS: Self = Self(1 << 3);
    /// SAT-V: axes from the centre to each vertex.
    pub const VERTICES: Self = Self(1 << 4);

    /// Axes by the letters that name them.
    const AXES: [(char, Self); 4] =
        [('e', Self::EDGES), ('n', Self::NEAREST_VERTEX), ('p', Self::NORMALS), ('v', Self::VERTICES)];

    /// Whether all of `others` are in the set.
    pub fn contain(self, others: Self) -> bool {
        self.0 & others.0 == others.0
    }

    /// The set of these separators and `others`.
    pub fn and(self, others: Self) -> Self {
        Self(self.0 | others.0)
    }
}

impl SphereTest {
    /// HS alone: the test of the thesis for perspective clusters.
    pub const HALF_SPACES: Self = Self::Separating(Separators::HALF_SPACES);

    /// `hs+sat-n`: half spaces, then the axis to the nearest vertex.
    pub const HALF_SPACES_AND_NEAREST: Self =
        Self::Separating(Separators(Separators::HALF_SPACES.0 | Separators::NEAREST_VERTEX.0));

    /// Names to suggest; the axes of `sat` combine freely.
    const KNOWN: [&str; 8] = ["exact", "box", "mm", "hs", "hs+sat-n", "hs+sat-epv", "sat-epv", "auto"];

    /// Whether what passes lies within the cluster's planes moved out by the radius, so that ranges of cells and boxes
    /// around lights can be cut by them. The edges of `boxes` (orthographic clusters) are their normals.
    pub fn is_bounded(self, boxes: bool) -> bool {
        match self {
            Self::Exact | Self::Box | Self::Projected => true,
            Self::Separating(asked) => {
                asked.contain(Separators::HALF_SPACES)
                    || asked.contain(Separators::NORMALS)
                    || boxes && asked.contain(Separators::EDGES)
            }
        }
    }

    /// Whether the test asks all of `separators`.
    pub fn asks(self, separators: Separators) -> bool {
        matches!(self, Self::Separating(asked) if asked.contain(separators))
    }
}

impl fmt::Display for SphereTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let separators = match self {
            Self::Exact => return f.write_str("exact"),
            Self::Box => return f.write_str("box"),
            Self::Projected => return f.write_str("mm"),
            Self::Separating(separators) => separators,
        };
        let axes: String = Separators::AXES
            .iter()
            .filter(|(_, axis)| separators.contain(*axis))
            .map(|(letter, _)| letter)
            .collect();
        let half_spaces = separators.contain(Separators::HALF_SPACES).then(|| "hs".to_owned());
        let sat = (!axes.is_empty()).then(|| format!("sat-{axes}"));
        f.write_str(&half_spaces.into_iter().chain(sat).collect::<Vec<_>>().join("+"))
    }
}

impl FromStr for SphereTest {
    type Err = String;

    /// Reads what [`fmt::Display`] writes; letters of axes may come in any order.
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "exact" => return Ok(Self::Exact),
            "box" => return Ok(Self::Box),
            "mm" => return Ok(Self::Projected),
            _ => {}
        }
        separating(text).map(Self::Separating).ok_or_else(|| {
            let hint = nearest::hint(text, &Self::KNOWN);
            format!("`{text}` is no test of sphere against cluster{hint} (after sat- any of the letters e, n, p, v)")
        })
    }
}

fn separating(text: &str) -> Option<Separators> {
    let sat = match text.strip_prefix("hs") {
        Some("") => return Some(Separators::HALF_SPACES),
        Some(rest) => rest.strip_prefix('+')?,
        None => text,
    };
    let letters = sat.strip_prefix("sat-").filter(|letters| !letters.is_empty())?;
    let mut found = Separators(if sat == text { 0 } else { Separators::HALF_SPACES.0 });
    for letter in letters.chars() {
        let (_, axis) = Separators::AXES.into_iter().find(|(name, _)| *name == letter)?;
        if found.contain(axis) {
            return None;
        }
        found = found.and(axis);
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_and_written_alike() {
        for name in [
            "exact",
            "box",
            "mm",
            "hs",
            "sat-n",
            "sat-e",
            "sat-p",
            "sat-v",
            "sat-epv",
            "hs+sat-n",
            "hs+sat-enpv",
        ] {
            assert_eq!(name.parse::<SphereTest>().unwrap().to_string(), name);
        }
        assert_eq!("hs+sat-vep".parse::<SphereTest>().unwrap().to_string(), "hs+sat-epv");
        let test: SphereTest = "hs+sat-n".parse().unwrap();
        assert!(test.asks(Separators::HALF_SPACES) && test.asks(Separators::NEAREST_VERTEX));
        assert!(!test.asks(Separators::EDGES) && !SphereTest::Exact.asks(Separators::HALF_SPACES));
    }

    #[test]
    fn other_names_are_refused_with_the_nearest() {
        for wrong in
            ["", "hs+", "sat", "sat-", "sat-x", "sat-nn", "hs+hs", "hs-n", "sat-n+hs", "HS", "exact+hs"]
        {
            assert!(wrong.parse::<SphereTest>().is_err(), "{wrong}");
        }
        let error = "hs+sat_n".parse::<SphereTest>().unwrap_err();
        assert!(error.contains("did you mean `hs+sat-n`?"), "{error}");
    }
}
