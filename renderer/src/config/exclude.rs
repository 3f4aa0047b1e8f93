//! Rules that leave combinations out of the product of scenes, lightings, methods, ways of assignment and tests.

use super::{Case, Lighting, LightsFrom, SceneEntry};
use crate::methods::MethodSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// One name, or several of which any may match; `*` in a name stands for any text.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a name or a list of names")]
pub enum Names {
    /// This one.
    One(String),
    /// Any of these.
    Any(Vec<String>),
}

/// One number of lights, or several of which any may match.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a number of lights or a list of them")]
pub enum Counts {
    /// This one.
    One(u32),
    /// Any of these.
    Any(Vec<u32>),
}

/// Leaves out every run that matches all the fields given; a field that is left out matches everything.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with any of scene, recording, lights, method, assign and test"
)]
pub struct Exclude {
    /// The scene as the configuration has it, or its file's name without extension; `*` stands for any text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<Names>,
    /// The recording as the configuration has it, or its file's name without extension; `*` stands for any text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recording: Option<Names>,
    /// How many lights fall.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lights: Option<Counts>,
    /// The method's name; `*` stands for any text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<Names>,
    /// The way of assignment; `*` stands for any text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub assign: Option<Names>,
    /// The test of light against cluster, `auto` as what it is for the method; `*` stands for any text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub test: Option<Names>,
}

/// Names of all fields.
const FIELDS: [&str; 6] = ["scene", "recording", "lights", "method", "assign", "test"];

impl Names {
    fn list(&self) -> &[String] {
        match self {
            Self::One(name) => std::slice::from_ref(name),
            Self::Any(names) => names,
        }
    }

    fn matches(&self, name: &str) -> bool {
        self.list().iter().any(|pattern| matches(pattern, name))
    }

    fn matches_file(&self, name: &str) -> bool {
        let stem = Path::new(name).file_stem().map(|stem| stem.to_string_lossy().into_owned());
        self.matches(name) || stem.is_some_and(|stem| self.matches(&stem))
    }
}

impl Counts {
    fn list(&self) -> &[u32] {
        match self {
            Self::One(count) => std::slice::from_ref(count),
            Self::Any(counts) => counts,
        }
    }
}

/// Whether `pattern`, in which `*` stands for any text, is all of `name`.
fn matches(pattern: &str, name: &str) -> bool {
    let Some((head, tail)) = pattern.split_once('*') else { return pattern == name };
    let Some(rest) = name.strip_prefix(head) else { return false };
    rest.char_indices().map(|(start, _)| start).chain([rest.len()]).any(|start| matches(tail, &rest[start..]))
}

impl Exclude {
    /// Whether a run is left out.
    pub fn matches(&self, scene: &SceneEntry, case: &Case) -> bool {
        // A method without clusters is under no way or test.
        let clustered = case.method != MethodSpec::AllLights;
        let way = |names: &Option<Names>, name: String| {
            names.as_ref().is_none_or(|names| clustered && names.matches(&name))
        };
        self.scene.as_ref().is_none_or(|names| names.matches_file(&scene.scene))
            && self.recording.as_ref().is_none_or(|names| names.matches_file(&scene.recording))
            && self.lights.as_ref().is_none_or(|counts| match &case.lights {
                LightsFrom::Rain(Lighting { count, .. }) => counts.list().contains(count),
                LightsFrom::File(_) | LightsFrom::Scene => false,
            })
            && self.method.as_ref().is_none_or(|names| names.matches(&case.method.to_string()))
            && way(&self.assign, case.assign.to_string())
            && way(&self.test, case.test.to_string())
    }

    /// Refuses a rule that says nothing.
    pub(super) fn check(&self) -> Result<(), String> {
        if *self == Self::default() {
            return Err(format!("an empty rule leaves everything out: give any of {}", FIELDS.join(", ")));
        }
        let names = [
            ("scene", &self.scene),
            ("recording", &self.recording),
            ("method", &self.method),
            ("assign", &self.assign),
            ("test", &self.test),
        ];
        let empty =
            names.iter().find(|(_, names)| names.as_ref().is_some_and(|names| names.list().is_empty()));
        let counts = self.lights.as_ref().is_some_and(|counts| counts.list().is_empty());
        match (empty, counts) {
            (Some((field, _)), _) => Err(format!("{field}: an empty list matches nothing")),
            (None, true) => Err("lights: an empty list matches nothing".into()),
            (None, false) => Ok(()),
        }
    }
}

impl fmt::Display for Exclude {
    /// Writes `scene=..,recording=..,lights=..,method=..,assign=..,test=..` with `|` between alternatives.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = |names: &Option<Names>| names.as_ref().map(|names| names.list().join("|"));
        let counts =
            |counts: &Counts| counts.list().iter().map(ToString::to_string).collect::<Vec<_>>().join("|");
        let fields = [
            ("scene", names(&self.scene)),
            ("recording", names(&self.recording)),
            ("lights", self.lights.as_ref().map(counts)),
            ("method", names(&self.method)),
            ("assign", names(&self.assign)),
            ("test", names(&self.test)),
        ];
        let given: Vec<String> =
            fields.into_iter().filter_map(|(field, value)| Some(format!("{field}={}", value?))).collect();
        f.write_str(&given.join(","))
    }
}

impl FromStr for Exclude {
    type Err = String;

    /// Reads what [`fmt::Display`] writes, in any order.
    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("`{text}` is no rule such as scene=street,lights=1000|10000,method=encl-*");
        let mut rule = Self::default();
        for part in text.split(',') {
            let (field, value) = part.split_once('=').ok_or_else(wrong)?;
            let names = || Some(Names::Any(value.split('|').map(|name| name.trim().to_owned()).collect()));
            match field.trim() {
                "scene" => rule.scene = names(),
                "recording" => rule.recording = names(),
                "method" => rule.method = names(),
                "assign" => rule.assign = names(),
                "test" => rule.test = names(),
                "lights" => {
                    let counts = value.split('|').map(|count| count.trim().parse()).collect::<Result<_, _>>();
                    rule.lights = Some(Counts::Any(counts.map_err(|_| wrong())?));
                }
                field => {
                    return Err(format!("`{field}` is no axis{}", crate::nearest::hint(field, &FIELDS)));
                }
            }
        }
        rule.check().map(|()| rule)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Assign;

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
        let scene = |scene: &str| SceneEntry {
            scene: scene.into(),
            recording: "bistro".into(),
            resolution: None,
            frames: None,
        };
        let case = |count, method: &str| Case {
            lights: LightsFrom::Rain(Lighting::with_count(count)),
            method: method.parse().unwrap(),
            assign: Assign::Scatter,
            test: "hs+sat-n".parse().unwrap(),
        };
        assert!(rule.matches(&scene("street"), &case(1000, "encl-ortho-4")));
        assert!(rule.matches(&scene("scenes/bistro.gltf"), &case(1000, "encl-ortho-4")));
        assert!(!rule.matches(&scene("temple"), &case(1000, "encl-ortho-4")));
        assert!(!rule.matches(&scene("street"), &case(10, "encl-ortho-4")));
        let lit = Case { lights: LightsFrom::Scene, ..case(1000, "encl-ortho-4") };
        assert!(!rule.matches(&scene("street"), &lit));
        assert!(!rule.matches(&scene("street"), &case(1000, "indi-ortho-4")));

        let ways = |text: &str, method: &str| {
            text.parse::<Exclude>().unwrap().matches(&scene("street"), &case(1, method))
        };
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
