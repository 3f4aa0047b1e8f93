//! Rules that leave combinations out of the product of the axes.

use super::Config;
use super::axes::{AXES, Axis, Values};
use crate::nearest;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

/// One name, or several of which any may match; `*` in a name stands for any text.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a name or a list of names")]
enum Names {
    /// This one.
    One(String),
    /// Any of these.
    Any(Vec<String>),
}

/// One number of lights, or several of which any may match.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a number of lights or a list of them")]
enum Counts {
    /// This one.
    One(u32),
    /// Any of these.
    Any(Vec<u32>),
}

/// What a rule says of an axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
enum Wanted {
    Names(Names),
    Counts(Counts),
}

/// Leaves out every run that matches all the fields given; a field that is left out matches everything.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Exclude {
    /// In the order of [`AXES`].
    wanted: Vec<(&'static Axis, Wanted)>,
}

impl Wanted {
    /// The alternatives.
    fn list(&self) -> Vec<Cow<'_, str>> {
        match self {
            Self::Names(Names::One(name)) => vec![name.into()],
            Self::Names(Names::Any(names)) => names.iter().map(Into::into).collect(),
            Self::Counts(Counts::One(count)) => vec![count.to_string().into()],
            Self::Counts(Counts::Any(counts)) => {
                counts.iter().map(|count| count.to_string().into()).collect()
            }
        }
    }

    /// Any of some values of an axis.
    fn of(kind: Values, values: &[String]) -> Self {
        match (kind, values) {
            (Values::Names, [name]) => Self::Names(Names::One(name.clone())),
            (Values::Names, names) => Self::Names(Names::Any(names.to_vec())),
            (Values::Counts, counts) => {
                Self::Counts(Counts::Any(counts.iter().filter_map(|count| count.parse().ok()).collect()))
            }
        }
    }

    /// Reads alternatives with `|` between; `None` where a number is none.
    fn parse(values: Values, text: &str) -> Option<Self> {
        let parts = text.split('|').map(str::trim);
        Some(match values {
            Values::Names => Self::Names(Names::Any(parts.map(str::to_owned).collect())),
            Values::Counts => {
                Self::Counts(Counts::Any(parts.map(str::parse).collect::<Result<_, _>>().ok()?))
            }
        })
    }
}

/// Whether `pattern`, in which `*` stands for any text, is all of `name`.
fn matches(pattern: &str, name: &str) -> bool {
    let Some((head, tail)) = pattern.split_once('*') else { return pattern == name };
    let Some(rest) = name.strip_prefix(head) else { return false };
    rest.char_indices().map(|(start, _)| start).chain([rest.len()]).any(|start| matches(tail, &rest[start..]))
}

/// Refuses a rule that says nothing.
pub(super) fn check_all(rules: &[Exclude]) -> Result<(), String> {
    rules.iter().try_for_each(Exclude::check)
}

/// Names of all axes.
fn axis_names() -> [&'static str; AXES.len()] {
    std::array::from_fn(|place| AXES[place].name)
}

impl Exclude {
    /// Leaves out what has one of the values given on each of some axes.
    pub fn of(given: &[(&'static Axis, Vec<String>)]) -> Self {
        let mut rule = Self::default();
        for (axis, values) in given {
            rule.set(axis, Wanted::of(axis.values, values));
        }
        rule
    }

    /// Whether the run of a configuration is left out.
    pub fn matches(&self, run: &Config) -> bool {
        self.wanted.iter().all(|(axis, wanted)| {
            let alternatives = wanted.list();
            axis.is_called(run, |name| alternatives.iter().any(|pattern| matches(pattern, name)))
        })
    }

    /// Refuses a rule that says nothing.
    fn check(&self) -> Result<(), String> {
        if self.wanted.is_empty() {
            let names = axis_names().join(", ");
            return Err(format!("an empty rule leaves everything out: give any of {names}"));
        }
        match self.wanted.iter().find(|(_, wanted)| wanted.list().is_empty()) {
            Some((axis, _)) => Err(format!("{}: an empty list matches nothing", axis.name)),
            None => Ok(()),
        }
    }

    /// Takes what is said of an axis, in place of what was said before.
    fn set(&mut self, axis: &'static Axis, wanted: Wanted) {
        self.wanted.retain(|(other, _)| *other != axis);
        self.wanted.push((axis, wanted));
        let place = |axis: &Axis| AXES.iter().position(|other| other == axis);
        self.wanted.sort_by_key(|(axis, _)| place(axis));
    }
}

impl Serialize for Exclude {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.wanted.iter().map(|(axis, wanted)| (axis.name, wanted)))
    }
}

impl<'de> Deserialize<'de> for Exclude {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(RuleVisitor)
    }
}

struct RuleVisitor;

impl<'de> Visitor<'de> for RuleVisitor {
    type Value = Exclude;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = axis_names();
        let (last, others) = names.split_last().unwrap_or((&"", &[]));
        write!(f, "an object with any of {} and {last}", others.join(", "))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Exclude, A::Error> {
        let mut rule = Exclude::default();
        while let Some(AxisName(axis)) = map.next_key()? {
            let wanted = match axis.values {
                Values::Names => map.next_value::<Option<Names>>()?.map(Wanted::Names),
                Values::Counts => map.next_value::<Option<Counts>>()?.map(Wanted::Counts),
            };
            if let Some(wanted) = wanted {
                rule.set(axis, wanted);
            }
        }
        Ok(rule)
    }
}

/// An axis by its name.
struct AxisName(&'static Axis);

impl<'de> Deserialize<'de> for AxisName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let unknown = || {
            let names: Vec<String> = axis_names().iter().map(|name| format!("`{name}`")).collect();
            de::Error::custom(format!("unknown field `{name}`, expected one of {}", names.join(", ")))
        };
        Axis::named(&name).map(Self).ok_or_else(unknown)
    }
}

impl JsonSchema for Exclude {
    fn schema_name() -> Cow<'static, str> {
        "Exclude".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut properties = serde_json::Map::new();
        for axis in &AXES {
            let values = match axis.values {
                Values::Names => generator.subschema_for::<Names>(),
                Values::Counts => generator.subschema_for::<Counts>(),
            };
            let property = json_schema!({
                "anyOf": [values, { "type": "null" }],
                "description": axis.description
            });
            properties.insert(axis.name.into(), property.into());
        }
        json_schema!({
            "type": "object",
            "additionalProperties": false,
            "properties": properties,
            "description":
                "Leaves out every run that matches all the fields given; a field that is left out matches everything."
        })
    }
}

impl fmt::Display for Exclude {
    /// Writes `AXIS=..` with commas between, and `|` between alternatives.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let given =
            self.wanted.iter().map(|(axis, wanted)| format!("{}={}", axis.name, wanted.list().join("|")));
        f.write_str(&given.collect::<Vec<_>>().join(","))
    }
}

impl FromStr for Exclude {
    type Err = String;

    /// Reads what [`fmt::Display`] writes, in any order.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is no rule such as scene=street,lights=1000|10000,method=encl-*");
        let mut rule = Self::default();
        for part in text.split(',') {
            let (name, values) = part.split_once('=').ok_or_else(wrong)?;
            let name = name.trim();
            let axis = Axis::named(name)
                .ok_or_else(|| format!("`{name}` is no axis{}", nearest::hint(name, &axis_names())))?;
            rule.set(axis, Wanted::parse(axis.values, values).ok_or_else(wrong)?);
        }
        rule.check().map(|()| rule)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Assign;
    use crate::lights::Lighting;

    #[test]
    fn stars_stand_for_any_text() {
        for (pattern, name) in
            [("*", ""), ("*", "a"), ("a*", "a"), ("*-vive", "bistro-vive"), ("a*c*e", "abcde")]
        {
            assert!(matches(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in
            [("", "a"), ("a*", "ba"), ("*-vive", "bistro"), ("a*c", "abcd"), ("encl-*", "indi-x")]
        {
            assert!(!matches(pattern, name), "{pattern} {name}");
        }
    }

    #[test]
    fn all_given_fields_must_match() {
        let rule: Exclude = "scene=street|bistro,lights=1000,method=encl-*".parse().unwrap();
        let run = |scene: &str, count, method: &str| Config {
            scene: scene.into(),
            recording: "bistro".into(),
            lights: vec![Lighting::with_count(count)],
            methods: vec![method.parse().unwrap()],
            assign: vec![Assign::Scatter],
            test: vec!["hs+sat-n".parse().unwrap()],
            ..Config::default()
        };
        assert!(rule.matches(&run("street", 1000, "encl-ortho-4")));
        assert!(rule.matches(&run("scenes/bistro.gltf", 1000, "encl-ortho-4")));
        assert!(!rule.matches(&run("temple", 1000, "encl-ortho-4")));
        assert!(!rule.matches(&run("street", 10, "encl-ortho-4")));
        let lit = Config { lights: vec![], scene_lights: true, ..run("street", 1000, "encl-ortho-4") };
        assert!(!rule.matches(&lit));
        assert!(!rule.matches(&run("street", 1000, "indi-ortho-4")));

        let ways =
            |text: &str, method: &str| text.parse::<Exclude>().unwrap().matches(&run("street", 1, method));
        assert!(ways("assign=scatter|auto,test=*sat-*", "encl-ortho-4"));
        assert!(!ways("assign=brute", "encl-ortho-4") && !ways("test=exact", "encl-ortho-4"));
        assert!(!ways("test=*", "all-lights") && !ways("assign=*", "all-lights"), "it has neither");
    }

    #[test]
    fn rules_are_read_as_documented() {
        let text = "scene=a|b,recording=*-vive,lights=1|2,method=encl-*,assign=brute,test=hs+sat-n|exact";
        assert_eq!(text.parse::<Exclude>().unwrap().to_string(), text);
        for wrong in ["", "scene", "scenes=a", "lights=x", "lights="] {
            assert!(wrong.parse::<Exclude>().is_err(), "{wrong}");
        }
    }
}
