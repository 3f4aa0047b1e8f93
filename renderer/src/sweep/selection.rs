//! Which runs of a sweep are made in one sitting.

use super::Part;
use crate::nearest;
use crate::{Error, Result};
use std::fmt;
use std::str::FromStr;

/// One of several equal shares of the runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 1.
    pub number: usize,
    /// Of how many.
    pub of: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let wrong = || format!("`{text}` is no share I/N such as 1/2: I is from 1 to N");
        let (number, of) = text.split_once('/').ok_or_else(wrong)?;
        let read = |part: &str| part.parse::<usize>().map_err(|_| wrong());
        let shard = Self { number: read(number)?, of: read(of)? };
        if (1..=shard.of).contains(&shard.number) { Ok(shard) } else { Err(wrong()) }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

/// Flags that choose among the runs.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Selection {
    /// Make every Nth run alone, from the Ith on: 1/2 and 2/2 together are the whole. All shards may write to one
    /// output directory, or to several that are copied together.
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,

    /// Make the run of this name alone, as --list-runs prints it; repeated for several.
    #[arg(long, value_name = "NAME", conflicts_with = "shard")]
    pub only: Vec<String>,
}

impl Selection {
    /// The parts with the chosen runs alone; parts without any are left out.
    ///
    /// # Errors
    /// There is no run of a name.
    pub fn choose(&self, parts: &[Part]) -> Result<Vec<Part>> {
        self.check_names(parts)?;
        let mut number = 0;
        let mut chosen = parts.to_vec();
        for (part, whole) in chosen.iter_mut().zip(parts) {
            part.runs.retain(|run| {
                number += 1;
                let named = self.only.is_empty() || self.only.contains(&whole.full_name(run));
                named && self.shard.is_none_or(|shard| (number - 1) % shard.of == shard.number - 1)
            });
        }
        chosen.retain(|part| !part.runs.is_empty());
        Ok(chosen)
    }

    fn check_names(&self, parts: &[Part]) -> Result<()> {
        let names: Vec<String> =
            parts.iter().flat_map(|part| part.runs.iter().map(|run| part.full_name(run))).collect();
        let Some(unknown) = self.only.iter().find(|name| !names.contains(name)) else { return Ok(()) };
        let near = nearest::nearest(unknown, names.iter().map(String::as_str));
        let hint = near.map_or("--list-runs prints all".into(), |near| format!("did you mean `{near}`?"));
        Err(Error::Input(format!("--only: there is no run `{unknown}`; {hint}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;
    use crate::sweep::parts;

    fn all() -> Vec<Part> {
        let scenes = ["street=bistro-vive", "temple=suntem-vive"].map(|text| text.parse().unwrap()).to_vec();
        parts(&Config { scenes, ..Config::default() }).unwrap()
    }

    fn names(parts: &[Part]) -> Vec<String> {
        parts.iter().flat_map(|part| part.runs.iter().map(|run| part.full_name(run))).collect()
    }

    #[test]
    fn shards_are_the_whole_each_run_once() {
        let all = all();
        for of in [1, 2, 5, 20] {
            let mut found: Vec<String> = (1..=of)
                .flat_map(|number| {
                    let selection = Selection { shard: Some(Shard { number, of }), only: vec![] };
                    names(&selection.choose(&all).unwrap())
                })
                .collect();
            let mut expected = names(&all);
            found.sort();
            expected.sort();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn shares_are_read_as_documented() {
        assert_eq!("2/3".parse(), Ok(Shard { number: 2, of: 3 }));
        for wrong in ["", "1", "0/2", "3/2", "1/0", "a/b", "-1/2"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn runs_are_chosen_by_name_and_unknown_names_are_refused() {
        let only = |name: &str| Selection { shard: None, only: vec![name.into()] };
        assert_eq!(names(&only("temple/encl-ortho-4").choose(&all()).unwrap()), ["temple/encl-ortho-4"]);
        let error = only("temple/encl-orto-4").choose(&all()).unwrap_err().to_string();
        assert!(error.contains("did you mean `temple/encl-ortho-4`?"), "{error}");
    }
}
