//! The tests of a light's volume against a cluster, by name.

use super::{Hexahedron, SphereTest, SphericalSector};
use std::fmt;
use std::str::FromStr;

/// What is asked of a spot light's cone where its bounding sphere meets a cluster.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConeTest {
    /// Nothing: a spot light is its bounding sphere.
    Unasked,
    /// They meet unless one of some axes separates the cone's sector from the cluster: conservative.
    Separating,
    /// They meet where the sector and the cluster have a point in common.
    Exact,
}

impl ConeTest {
    /// Every test; of two whose suffixes a name ends in, the one that is read comes first.
    const ALL: [Self; 3] = [Self::Separating, Self::Exact, Self::Unasked];

    /// Signed margin in metres: at least 0 where what a spot light reaches meets a cell, by this test.
    pub fn margin(self, cell: &Hexahedron, sector: &SphericalSector) -> f64 {
        match self {
            Self::Unasked => f64::INFINITY,
            Self::Separating => cell.separation_margin(sector),
            Self::Exact => cell.sector_margin(sector),
        }
    }

    /// What it adds to the name of the sphere's test.
    fn suffix(self) -> &'static str {
        match self {
            Self::Unasked => "",
            Self::Separating => "+cone-sat",
            Self::Exact => "+cone",
        }
    }
}

/// Which test decides whether what a light reaches meets a cluster: that of its bounding sphere, then that of its cone.
///
/// Its name is its identity everywhere: a [`SphereTest`]'s, with `+cone-sat` or `+cone` behind it where cones are asked, as in
/// `hs+sat-n+cone-sat`, `exact+cone`. Point lights have no cone, so that the suffix changes nothing of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct VolumeTest {
    /// The test of the bounding sphere.
    pub sphere: SphereTest,
    /// The test of the cone.
    pub cone: ConeTest,
}

impl From<SphereTest> for VolumeTest {
    fn from(sphere: SphereTest) -> Self {
        Self { sphere, cone: ConeTest::Unasked }
    }
}

impl fmt::Display for VolumeTest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.sphere, self.cone.suffix())
    }
}

impl FromStr for VolumeTest {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        let suffixed = |cone: ConeTest| Some((cone, text.strip_suffix(cone.suffix())?));
        let (cone, sphere) =
            ConeTest::ALL.into_iter().find_map(suffixed).unwrap_or((ConeTest::Unasked, text));
        Ok(Self { sphere: sphere.parse()?, cone })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_and_written_alike() {
        for (name, cone) in [
            ("exact", ConeTest::Unasked),
            ("exact+cone", ConeTest::Exact),
            ("hs+sat-n+cone", ConeTest::Exact),
            ("box+cone-sat", ConeTest::Separating),
            ("sat-epv+cone-sat", ConeTest::Separating),
        ] {
            let test: VolumeTest = name.parse().unwrap();
            assert_eq!((test.cone, test.to_string().as_str()), (cone, name));
        }
    }

    #[test]
    fn other_names_are_refused() {
        for wrong in
            ["", "+cone", "cone", "exact+cone+cone", "exact+cone-sat+cone", "cone+exact", "exact+cones"]
        {
            assert!(wrong.parse::<VolumeTest>().is_err(), "{wrong}");
        }
        let error = "exat+cone".parse::<VolumeTest>().unwrap_err();
        assert!(error.contains("did you mean `exact`?"), "{error}");
    }
}
