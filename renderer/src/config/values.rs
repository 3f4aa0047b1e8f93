//! Single values: how flags spell them, what is in range, how JSON carries them. Each rule is stated once
//! here and serves flags and files alike.

use super::{Choice, Lighting, SceneEntry, scenes};
use crate::assign::{ListStore, MeshDetail};
use crate::geometry::NormalCones;
use crate::lights::Attenuation;
use crate::methods::{Method, OctreeWay};
use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serializer};
use std::borrow::Borrow;
use std::fmt;
use std::marker::PhantomData;
use std::path::Path;
use std::str::FromStr;

/// Widest and highest view, pixels.
pub(super) const MAX_RESOLUTION: u32 = 16384;

/// The value, where `check` lets it pass.
pub(super) fn passed<T, U: ?Sized>(
    value: T,
    check: impl FnOnce(&U) -> Result<(), String>,
) -> Result<T, String>
where
    T: Borrow<U>,
{
    check(value.borrow()).map(|()| value)
}

/// Reads the name of a method.
pub(super) fn method(text: &str) -> Result<Method, String> {
    text.parse::<Method>().map_err(|error| error.to_string())
}

/// Reads the name of a test of sphere against cluster.
pub(super) fn choice<T: FromStr<Err = String>>(text: &str) -> Result<Choice<T>, String> {
    text.parse()
}

/// Reads the name of a store of light lists.
pub(super) fn list_store(text: &str) -> Result<ListStore, String> {
    text.parse()
}

/// Reads into how many squares the faces of the cube of normal cones are divided.
pub(super) fn normal_cones(text: &str) -> Result<NormalCones, String> {
    text.parse()
}

/// Reads how fine meshes around lights are.
pub(super) fn mesh_detail(text: &str) -> Result<MeshDetail, String> {
    text.parse()
}

/// Reads the name of a way to make octrees.
pub(super) fn octree_way(text: &str) -> Result<OctreeWay, String> {
    text.parse()
}

/// Reads a width and height in pixels, `WxH`.
pub fn resolution(text: &str) -> Result<[u32; 2], String> {
    let wrong = || format!("`{text}` is no resolution such as 1280x720");
    let (width, height) = text.split_once('x').ok_or_else(wrong)?;
    let number = |part: &str| part.parse::<u32>().map_err(|_| wrong());
    passed([number(width)?, number(height)?], check_resolution)
}

/// Refuses views without pixels and larger than any device renders.
pub(super) fn check_resolution([width, height]: &[u32; 2]) -> Result<(), String> {
    if [width, height].iter().all(|side| (1..=MAX_RESOLUTION).contains(*side)) {
        return Ok(());
    }
    Err(format!("{width}x{height} pixels: each side is from 1 to {MAX_RESOLUTION}"))
}

/// Refuses resolutions with sides out of range, and one that is named twice.
pub(super) fn check_resolutions(resolutions: &[[u32; 2]]) -> Result<(), String> {
    if let Some([width, height]) = first_twin(resolutions) {
        return Err(format!("{width}x{height} is named twice"));
    }
    resolutions.iter().try_for_each(check_resolution)
}

/// Reads a number of samples a pixel.
pub(super) fn msaa(text: &str) -> Result<u32, String> {
    passed(text.parse().map_err(|_| format!("`{text}` is neither 1 nor 4"))?, check_msaa)
}

/// Refuses sample counts other than 1 and 4.
pub(super) fn check_msaa(samples: &u32) -> Result<(), String> {
    if matches!(samples, 1 | 4) { Ok(()) } else { Err(format!("{samples} samples a pixel: only 1 or 4")) }
}

/// Refuses buffers that hold nothing.
pub(super) fn check_capacity(capacity: &u32) -> Result<(), String> {
    if *capacity > 0 { Ok(()) } else { Err("a capacity of 0: it is at least 1".into()) }
}

/// Reads how many entries a buffer holds.
pub(super) fn capacity(text: &str) -> Result<u32, String> {
    let wrong = || format!("`{text}` is no whole number from 1 to {}", u32::MAX);
    passed(text.parse().map_err(|_| wrong())?, check_capacity)
}

/// Refuses an empty list of methods and one that names a method twice.
pub(super) fn check_methods(methods: &[Method]) -> Result<(), String> {
    if methods.is_empty() {
        return Err("no method: name at least one, such as indi-persp-64".into());
    }
    match first_twin(methods) {
        Some(twin) => Err(format!("method {twin} is named twice")),
        None => Ok(()),
    }
}

/// Refuses a lighting that is given twice or has values out of range.
pub(super) fn check_lights(lights: &[Lighting]) -> Result<(), String> {
    match first_twin(lights) {
        Some(twin) => Err(format!("lights {twin} are given twice")),
        None => lights.iter().try_for_each(|lighting| lighting.check().map(drop)),
    }
}

/// Refuses an empty list of ways or tests, and one that names one twice.
pub(super) fn check_ways<T: PartialEq + fmt::Display>(ways: &[T]) -> Result<(), String> {
    if ways.is_empty() {
        return Err("an empty list: name at least one".into());
    }
    match first_twin(ways) {
        Some(twin) => Err(format!("{twin} is named twice")),
        None => Ok(()),
    }
}

fn first_twin<T: PartialEq>(items: &[T]) -> Option<&T> {
    items.iter().enumerate().find(|(i, item)| items[..*i].contains(item)).map(|(_, item)| item)
}

/// Refuses text that names nothing.
pub(super) fn check_text(text: &str) -> Result<(), String> {
    if text.trim().is_empty() { Err("empty: it must name something".into()) } else { Ok(()) }
}

/// Refuses a path that names nothing, or is no text.
pub(super) fn check_path(path: &Path) -> Result<(), String> {
    if path.as_os_str().is_empty() {
        return Err("empty: it must name a file or directory".into());
    }
    match path.to_str() {
        // run.json is JSON, and a run's configuration can be replayed from there.
        None => Err(format!("{path:?} is not UTF-8 text: rename it")),
        Some(_) => Ok(()),
    }
}

/// One method in a JSON list.
struct MethodText(Method);

impl<'de> Deserialize<'de> for MethodText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        method(&String::deserialize(deserializer)?).map(Self).map_err(D::Error::custom)
    }
}

/// A name of something in JSON.
struct Named<T>(T);

impl<'de, T: FromStr<Err = String>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map(Self).map_err(D::Error::custom)
    }
}

/// A name, or a list of names.
struct OneOrSeveral<T>(Vec<T>);

impl<'de, T: FromStr<Err = String>> Deserialize<'de> for OneOrSeveral<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NamesVisitor(PhantomData)).map(Self)
    }
}

struct NamesVisitor<T>(PhantomData<T>);

impl<'de, T: FromStr<Err = String>> Visitor<'de> for NamesVisitor<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a name or a list of names")
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Vec<T>, E> {
        name.parse().map(|item| vec![item]).map_err(E::custom)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut names: A) -> Result<Vec<T>, A::Error> {
        let mut items = Vec::new();
        while let Some(Named(item)) = names.next_element()? {
            items.push(item);
        }
        Ok(items)
    }
}

/// Deserializes an optional field and makes a value of it.
fn made<'de, D, T, U>(
    deserializer: D,
    make: impl FnOnce(T) -> Result<U, String>,
) -> Result<Option<U>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    Option::<T>::deserialize(deserializer)?.map(make).transpose().map_err(D::Error::custom)
}

/// The checks above as serde calls them, one a kind of field.
pub(super) mod de {
    use super::*;

    pub fn text<'de, D: Deserializer<'de>>(d: D) -> Result<Option<String>, D::Error> {
        made(d, |text| passed(text, check_text))
    }

    pub fn methods<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Vec<Method>>, D::Error> {
        let names = |list: Vec<MethodText>| list.into_iter().map(|method| method.0).collect();
        made(d, |list| passed(names(list), check_methods))
    }

    pub fn ways<'de, D, T>(d: D) -> Result<Option<Vec<T>>, D::Error>
    where
        D: Deserializer<'de>,
        T: FromStr<Err = String> + PartialEq + fmt::Display,
    {
        made(d, |OneOrSeveral(ways): OneOrSeveral<T>| passed(ways, check_ways))
    }

    pub fn lights<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Vec<Lighting>>, D::Error> {
        made(d, |lights| passed(lights, check_lights))
    }

    pub fn scenes<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Vec<SceneEntry>>, D::Error> {
        made(d, |scenes| passed(scenes, scenes::check_given))
    }

    pub fn resolution<'de, D: Deserializer<'de>>(d: D) -> Result<Option<[u32; 2]>, D::Error> {
        made(d, |resolution| passed(resolution, check_resolution))
    }

    pub fn resolutions<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Vec<[u32; 2]>>, D::Error> {
        made(d, |resolutions: Vec<[u32; 2]>| passed(resolutions, check_resolutions))
    }

    pub fn msaa<'de, D: Deserializer<'de>>(d: D) -> Result<Option<u32>, D::Error> {
        made(d, |samples| passed(samples, check_msaa))
    }

    pub fn capacity<'de, D: Deserializer<'de>>(d: D) -> Result<Option<u32>, D::Error> {
        made(d, |capacity| passed(capacity, check_capacity))
    }

    pub fn attenuation<'de, D: Deserializer<'de>>(d: D) -> Result<Option<Attenuation>, D::Error> {
        made(d, |name: String| name.parse())
    }
}

/// How resolved values are written.
pub(super) mod ser {
    use super::*;

    pub fn methods<S: Serializer>(methods: &[Method], serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(methods.iter().map(ToString::to_string))
    }

    /// Writes one item as its name, several as a list of names.
    pub fn one_or_several<S: Serializer, T: ToString>(items: &[T], serializer: S) -> Result<S::Ok, S::Error> {
        match items {
            [one] => serializer.serialize_str(&one.to_string()),
            _ => serializer.collect_seq(items.iter().map(ToString::to_string)),
        }
    }

    pub fn attenuation<S: Serializer>(attenuation: &Attenuation, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(attenuation)
    }
}
