//! How many temporal runs are made.

use super::Config;
use serde::de::{self, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// How many temporal runs are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Runs {
    /// So many.
    Fixed(u32),
    /// As many as it takes until times are known as precisely as is asked for.
    Auto,
}

/// The word for [`Runs::Auto`].
const AUTO: &str = "auto";

impl Runs {
    /// How many, where that is known before.
    pub fn fixed(self) -> Option<u32> {
        match self {
            Self::Fixed(runs) => Some(runs),
            Self::Auto => None,
        }
    }

    /// Whether nothing is timed.
    pub fn is_none(self) -> bool {
        self == Self::Fixed(0)
    }
}

impl From<u32> for Runs {
    fn from(runs: u32) -> Self {
        Self::Fixed(runs)
    }
}

impl FromStr for Runs {
    type Err = String;

    /// Reads what [`fmt::Display`] writes.
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            AUTO => Ok(Self::Auto),
            _ => text
                .parse()
                .map(Self::Fixed)
                .map_err(|_| format!("`{text}` is neither a whole number nor `{AUTO}`")),
        }
    }
}

impl fmt::Display for Runs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(runs) => runs.fmt(f),
            Self::Auto => f.write_str(AUTO),
        }
    }
}

impl Serialize for Runs {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Fixed(runs) => serializer.serialize_u32(*runs),
            Self::Auto => serializer.serialize_str(AUTO),
        }
    }
}

impl<'de> Deserialize<'de> for Runs {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RunsVisitor)
    }
}

struct RunsVisitor;

impl Visitor<'_> for RunsVisitor {
    type Value = Runs;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a whole number from 0 to {} or \"{AUTO}\"", u32::MAX)
    }

    fn visit_u64<E: de::Error>(self, runs: u64) -> Result<Runs, E> {
        let wrong = || E::invalid_value(de::Unexpected::Unsigned(runs), &self);
        runs.try_into().map(Runs::Fixed).map_err(|_| wrong())
    }

    fn visit_i64<E: de::Error>(self, runs: i64) -> Result<Runs, E> {
        let wrong = || E::invalid_value(de::Unexpected::Signed(runs), &self);
        runs.try_into().map(Runs::Fixed).map_err(|_| wrong())
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Runs, E> {
        if text == AUTO { Ok(Runs::Auto) } else { Err(E::invalid_value(de::Unexpected::Str(text), &self)) }
    }
}

impl Config {
    /// The most temporal runs that are made.
    pub fn most_runs(&self) -> u32 {
        self.runs.fixed().unwrap_or(self.max_runs)
    }

    /// Refuses a way of choosing the number of temporal runs that ends nowhere.
    pub(super) fn check_runs(&self) -> Result<(), String> {
        if !(self.precision.is_finite() && self.precision > 0.0) {
            return Err(format!("precision: {} percent: it is above 0, such as 2", self.precision));
        }
        if self.max_runs < 2 {
            return Err(format!(
                "max_runs: {}: at least 2, for one run tells nothing of noise",
                self.max_runs
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_of_runs_is_written_as_it_is_read() {
        for (runs, text, json) in [(Runs::Fixed(3), "3", "3"), (Runs::Auto, "auto", "\"auto\"")] {
            assert_eq!((text.parse(), runs.to_string()), (Ok(runs), text.to_owned()));
            assert_eq!(serde_json::to_string(&runs).unwrap(), json);
            assert_eq!(serde_json::from_str::<Runs>(json).unwrap(), runs);
        }
        for wrong in ["", "-1", "1.5", "Auto", "4294967296"] {
            assert!(wrong.parse::<Runs>().is_err(), "{wrong}");
        }
        for wrong in ["-1", "1.5", "\"3\"", "4294967296", "true"] {
            let error = serde_json::from_str::<Runs>(wrong).unwrap_err().to_string();
            assert!(error.contains("or \"auto\""), "{wrong}: {error}");
        }
    }

    #[test]
    fn what_ends_nowhere_is_refused() {
        let refused = |config: Config| config.check_runs().unwrap_err();
        assert!(refused(Config { precision: 0.0, ..Config::default() }).starts_with("precision: 0 percent"));
        assert!(refused(Config { precision: f64::NAN, ..Config::default() }).starts_with("precision"));
        assert!(refused(Config { max_runs: 1, ..Config::default() }).starts_with("max_runs: 1"));
        assert_eq!(Config { runs: Runs::Auto, max_runs: 9, ..Config::default() }.most_runs(), 9);
    }
}
