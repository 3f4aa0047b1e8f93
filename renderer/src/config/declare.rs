//! How settings are declared: `settings!` and what follows from an entry.
//!
//! ```text
//!              ┌─> Layer: flag, field of a file, schema ──apply──┐
//! an entry  ───┼─> default ──────────────────────────────────────┴─> Config ──check──> run.json, fingerprint
//!              └─> bearing: what compare, report and the fingerprint make of it
//! ```

use super::Config;
use crate::{Error, Result};
use serde_json::{Map, Value};

/// What a setting is to the results of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bearing {
    /// It says which run it is: an axis, or an input that the manifest names with its content.
    Run,
    /// What is counted depends on it: runs that differ in it are not compared, and where it is not the default, reports
    /// tell it beside what else the run is.
    Counts,
    /// As [`Self::Counts`], but reports have a place of their own for it.
    Shown,
    /// Counts are the same whatever it is, but it says how, how often or with what room they and times are taken: the run
    /// is made anew where it changes.
    Measures,
    /// Results do not depend on it, or by the content of what it names alone.
    Outside,
}

/// A field of [`Config`], but for its value.
#[derive(Debug)]
pub struct Setting {
    /// Its name in JSON.
    pub name: &'static str,
    /// What it is to results.
    pub bearing: Bearing,
    /// What reports call it by, before its value; its name where `None`.
    pub(super) told: Option<&'static str>,
}

impl Setting {
    /// What reports say of a value of it, such as `displaced volume own`.
    fn tell(&self, value: &Value) -> String {
        let told = self.told.map_or_else(|| self.name.replace('_', " "), str::to_owned);
        match value {
            Value::String(text) => format!("{told} {text}"),
            value => format!("{told} {value}"),
        }
    }
}

impl Config {
    /// The settings of the bearings that are wanted, as JSON, in the order in which they are declared.
    ///
    /// # Errors
    /// A path is not UTF-8 text, which [`Config::check`] refuses.
    pub fn settings(&self, wanted: impl Fn(Bearing) -> bool) -> Result<Map<String, Value>> {
        let not_json = |error| Error::Internal(format!("the configuration is not JSON: {error}"));
        let fields = serde_json::to_value(self).map_err(not_json)?;
        let wanted = Self::SETTINGS.iter().filter(|setting| wanted(setting.bearing));
        Ok(wanted
            .filter_map(|Setting { name, .. }| Some(((*name).into(), fields.get(name)?.clone())))
            .collect())
    }

    /// What reports tell of the settings of [`Bearing::Counts`] that are not the default.
    ///
    /// # Errors
    /// As [`Config::settings`].
    pub fn unusual(&self) -> Result<Vec<String>> {
        let counts = |bearing| bearing == Bearing::Counts;
        let (values, usual) = (self.settings(counts)?, Self::default().settings(counts)?);
        let told = |setting: &Setting| {
            let value = values.get(setting.name)?;
            (usual.get(setting.name) != Some(value)).then(|| setting.tell(value))
        };
        Ok(Self::SETTINGS.iter().filter_map(told).collect())
    }
}

/// Puts a value where one is given.
pub(super) fn set<T, U: From<T>>(field: &mut U, value: Option<T>) {
    if let Some(value) = value {
        *field = value.into();
    }
}

/// Declares settings, in the order of help, schema and JSON.
///
/// ```text
/// /// Documentation: of the flag, in the schema, of the field.
/// name: Type = default, Bearing {
///     arg(clap's attributes of the flag)
///     serde(how it is read from JSON)
///     schemars(its schema)
///     write(how serde writes it)
///     check(a `fn(&Type) -> Result<(), String>` that refuses values)
///     told("what reports call it by")
/// }
/// ```
///
/// All but `arg` may be left out, the default too: then a configuration holds an `Option`. `Layer`, `Config`, its `Default`,
/// how a layer goes over a configuration, and the check of single values follow.
macro_rules! settings {
    (@held $type:ty = $default:expr) => { $type };
    (@held $type:ty) => { Option<$type> };
    (@default $default:expr) => { $default };
    (@default) => { None };
    (@told $told:literal) => { Some($told) };
    (@told) => { None };
    ($(
        $(#[$doc:meta])*
        $name:ident: $type:ty $(= $default:expr)?, $bearing:ident {
            arg($($arg:tt)*)
            $(serde($($read:tt)*))?
            $(schemars($($schema:tt)*))?
            $(write($($write:tt)*))?
            $(check($check:expr))?
            $(told($told:literal))?
        }
    )+) => {
        /// What one source says of a [`Config`]: a JSON file, or the flags. Every field is a flag.
        #[derive(Debug, Clone, Default, PartialEq, clap::Args, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        #[schemars(
            title = "manylight configuration",
            description = "What to replay and measure. Every field may be left out."
        )]
        pub struct Layer {
            /// Where editors find the schema of this file; otherwise without meaning.
            #[arg(skip)]
            #[serde(rename = "$schema")]
            pub schema: Option<String>,
            $(
                $(#[$doc])*
                #[arg($($arg)*)]
                $(#[serde($($read)*)])?
                $(#[schemars($($schema)*)])?
                pub $name: Option<$type>,
            )+
        }

        /// One fully resolved run configuration. Serialized, it is a configuration file again; read back, what is left out
        /// has its default.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        #[serde(try_from = "Layer")]
        pub struct Config {
            $(
                $(#[$doc])*
                $(#[serde($($write)*)])?
                pub $name: settings!(@held $type $(= $default)?),
            )+
        }

        impl Default for Config {
            /// The default replay: the street in HTC Vive stereo under 1000 lights, by the thesis's six tuned methods.
            fn default() -> Self {
                Self { $($name: settings!(@default $($default)?),)+ }
            }
        }

        impl Config {
            /// All settings, in the order of JSON.
            pub const SETTINGS: &'static [Setting] = &[$(Setting {
                name: stringify!($name),
                bearing: Bearing::$bearing,
                told: settings!(@told $($told)?),
            }),+];

            /// Puts what a layer gives in place of what was there.
            pub(super) fn replace(&mut self, layer: Layer) {
                $(set(&mut self.$name, layer.$name);)+
            }

            /// Refuses the first value that is out of range by itself.
            pub(super) fn check_values(&self) -> Result<(), String> {
                $($(
                    if let Some(value) = Option::<&$type>::from(&self.$name) {
                        $check(value).map_err(|message| format!("{}: {message}", stringify!($name)))?;
                    }
                )?)+
                Ok(())
            }
        }
    };
}
pub(super) use settings;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assign::Marking;
    use crate::geometry::DisplacedVolume;
    use crate::lights::Attenuation;

    #[test]
    fn reports_tell_what_counts_and_is_not_the_default_in_words() {
        assert_eq!(Config::default().unusual().unwrap(), [""; 0]);
        let config = Config {
            attenuation: Attenuation::PhySmo1,
            marking: Marking::Geometry,
            displaced_volume: DisplacedVolume::Own,
            resolution: [8, 4],
            runs: 9.into(),
            ..Config::default()
        };
        let expected = ["attenuation phy_smo_1", "marking from geometry", "displaced volume own"];
        assert_eq!(config.unusual().unwrap(), expected);
    }

    #[test]
    fn settings_of_a_bearing_are_those_alone_with_their_values() {
        let config = Config { resolution: [8, 4], out: "elsewhere".into(), ..Config::default() };
        let outside = config.settings(|bearing| bearing == Bearing::Outside).unwrap();
        assert_eq!(outside["out"], "elsewhere");
        assert!(!outside.contains_key("resolution") && !outside.contains_key("runs"));
        let shown = config.settings(|bearing| bearing == Bearing::Shown).unwrap();
        assert_eq!(shown["resolution"], serde_json::json!([8, 4]));
        assert!(!shown.contains_key("out"));
    }
}
