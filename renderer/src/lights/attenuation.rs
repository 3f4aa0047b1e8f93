//! How a light fades with distance.

use crate::nearest;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

/// How a light fades with distance (Gelderen appendix A, with names as there, and Tegelaers section 3.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(into = "&'static str", try_from = "Cow<'_, str>")]
pub enum Attenuation {
    /// I/d^2 for d < R1.
    Phy,
    /// I/d^2 - I0.
    Red,
    /// I/d^2 + 2*I0*d/R1 - 3*I0.
    Smo,
    /// I/d^2 - I0*d/R1.
    PhyRed1,
    /// I/d^2 - I0*d^2/R1^2: the default (Gelderen equation 5.1).
    #[default]
    PhyRed2,
    /// I/d^2 + 2*I0*d^2/R1^2 - 3*I0*d/R1.
    PhySmo1,
    /// I/d^2 + 2*I0*d^3/R1^3 - 3*I0*d^2/R1^2.
    PhySmo2,
    /// I*(R1-d)/R1.
    Lin,
    /// I for d < R1.
    Stp,
    /// (1 - d/R1)^2, whatever I is (Tegelaers listing 2, which squares; his text in places does not).
    Tegelaers,
}

impl Attenuation {
    /// Every function: Gelderen's in the order of appendix A, then that of Tegelaers.
    pub const ALL: [Self; 10] = [
        Self::Phy,
        Self::Red,
        Self::Smo,
        Self::PhyRed1,
        Self::PhyRed2,
        Self::PhySmo1,
        Self::PhySmo2,
        Self::Lin,
        Self::Stp,
        Self::Tegelaers,
    ];

    /// The name that configs, the command line and shaders use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Phy => "phy",
            Self::Red => "red",
            Self::Smo => "smo",
            Self::PhyRed1 => "phy_red_1",
            Self::PhyRed2 => "phy_red_2",
            Self::PhySmo1 => "phy_smo_1",
            Self::PhySmo2 => "phy_smo_2",
            Self::Lin => "lin",
            Self::Stp => "stp",
            Self::Tegelaers => "tegelaers",
        }
    }
}

impl fmt::Display for Attenuation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Attenuation {
    /// What is wrong and what may have been meant.
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        nearest::named(name, &Self::ALL, "attenuation function")
    }
}

impl From<Attenuation> for &'static str {
    fn from(attenuation: Attenuation) -> Self {
        attenuation.name()
    }
}

impl TryFrom<Cow<'_, str>> for Attenuation {
    type Error = String;

    fn try_from(name: Cow<'_, str>) -> Result<Self, String> {
        name.parse()
    }
}

impl JsonSchema for Attenuation {
    fn schema_name() -> Cow<'static, str> {
        "Attenuation".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "string",
            "enum": Self::ALL.map(Self::name),
            "description": "How a light fades with distance"
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for attenuation in Attenuation::ALL {
            assert_eq!(attenuation.to_string().parse::<Attenuation>().unwrap(), attenuation);
            let json = serde_json::to_string(&attenuation).unwrap();
            assert_eq!(json, format!("\"{attenuation}\""));
            assert_eq!(serde_json::from_str::<Attenuation>(&json).unwrap(), attenuation);
        }
        assert_eq!(Attenuation::default().name(), "phy_red_2");
    }

    #[test]
    fn an_unknown_name_is_answered_with_what_may_be_meant() {
        let message = "phy_red".parse::<Attenuation>().unwrap_err();
        assert_eq!(message, "`phy_red` is no attenuation function; did you mean `phy_red_1`?");
        assert!(serde_json::from_str::<Attenuation>("\"PhyRed2\"").is_err());
    }
}
