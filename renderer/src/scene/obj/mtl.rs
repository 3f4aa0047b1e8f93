//! MTL text made safe, and the options of its texture lines.

use std::path::{Path, PathBuf};

use super::super::source::SourceFiles;
use super::super::{Sampler, TextureRef, Wrap};
use crate::{Error, Result};

/// The material libraries of an OBJ file as one checked text.
#[derive(Debug, Default)]
pub(super) struct Library {
    /// For tobj.
    pub text: String,
    /// By material in `text`: the file that defines it.
    pub files: Vec<PathBuf>,
}

impl Library {
    /// Reads the libraries that lie beside `obj`; one that is missing is a warning.
    pub fn read(obj: &Path, names: &[String], files: &mut SourceFiles) -> Result<Self> {
        let mut library = Self::default();
        let folder = obj.parent().unwrap_or(Path::new(""));
        for name in names {
            // A line may name several files, and a name may hold spaces.
            let whole = folder.join(portable(name));
            let paths: Vec<_> = match whole.is_file() {
                true => vec![whole],
                false => name.split_whitespace().map(|name| folder.join(portable(name))).collect(),
            };
            for path in paths {
                if path.is_file() {
                    library.add(&path, &files.read(&path)?)?;
                } else {
                    tracing::warn!("{}: is missing; its materials become a default one", path.display());
                }
            }
        }
        Ok(library)
    }

    fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<()> {
        let mut named = false;
        for (i, line) in String::from_utf8_lossy(bytes).lines().enumerate() {
            let fail = |message: String| Error::file(path, format!("line {}: {message}", i + 1));
            let Some(line) = clean_line(line.trim()).map_err(fail)? else { continue };
            let is_name = line.starts_with("newmtl ");
            named |= is_name;
            if is_name {
                self.files.push(path.to_owned());
            }
            // What comes before the first name belongs to no material, least of all to one of another file.
            if named {
                self.text.extend([line.as_str(), "\n"]);
            }
        }
        Ok(())
    }
}

/// A line of MTL with its numbers checked and its keyword as tobj spells it; `None` if nothing here reads it.
fn clean_line(line: &str) -> Result<Option<String>, String> {
    let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let rest = rest.trim();
    let lower = keyword.to_lowercase();
    let cleaned = match lower.as_str() {
        "newmtl" if rest.is_empty() => return Err("newmtl without a name".into()),
        "newmtl" => format!("newmtl {rest}"),
        "kd" | "ke" => {
            let [r, g, b] = color(keyword, rest)?;
            format!("K{} {r} {g} {b}", &lower[1..])
        }
        "ns" => format!("Ns {}", number(keyword, rest)?),
        // "-halo" makes alpha depend on the view; only the factor is used.
        "d" => format!("d {}", number(keyword, rest.trim_start_matches("-halo"))?),
        "tr" => format!("Tr {}", number(keyword, rest)?),
        "pr" => format!("Pr {}", number(keyword, rest)?),
        "pm" => format!("Pm {}", number(keyword, rest)?),
        "map_kd" | "map_ke" | "map_d" | "map_bump" | "bump" | "norm" if rest.is_empty() => {
            return Err(format!("{keyword} without a file"));
        }
        "map_kd" => format!("map_Kd {rest}"),
        "map_ke" => format!("map_Ke {rest}"),
        "map_d" => format!("map_d {rest}"),
        "map_bump" | "bump" => format!("map_Bump {rest}"),
        "norm" => format!("norm {rest}"),
        _ => return Ok(None),
    };
    Ok(Some(cleaned))
}

fn number(keyword: &str, rest: &str) -> Result<f32, String> {
    let word = rest.split_whitespace().next().unwrap_or_default();
    let number: Option<f32> = word.parse().ok().filter(|number: &f32| number.is_finite());
    number.ok_or_else(|| format!("{keyword} has \"{word}\", which is not a finite number"))
}

/// One number stands for all three; spectra and CIE XYZ are refused.
fn color(keyword: &str, rest: &str) -> Result<[f32; 3], String> {
    let mut words = rest.split_whitespace().take_while(|word| !word.starts_with('#'));
    let mut next = || words.next().map(|word| number(keyword, word)).transpose();
    match (next()?, next()?, next()?) {
        (Some(r), Some(g), Some(b)) => Ok([r, g, b]),
        (Some(grey), None, None) => Ok([grey; 3]),
        _ => Err(format!("{keyword} has \"{rest}\" instead of three numbers")),
    }
}

/// A texture line without its keyword: `[-option value...]... file`.
#[derive(Debug, PartialEq)]
pub(super) struct TextureLine {
    /// As written, with forward slashes.
    pub file: PathBuf,
    /// `-bm`.
    pub bump: f32,
    sampler: Sampler,
    uv_transform: [[f32; 3]; 2],
}

impl TextureLine {
    /// Reads `-bm`, `-clamp`, `-o` and `-s`; skips the values of the other options.
    pub fn parse(line: &str) -> Self {
        let mut rest = line.trim();
        let (mut bump, mut wrap) = (1.0, Wrap::Repeat);
        let (mut scale, mut offset) = ([1.0, 1.0], [0.0, 0.0]);
        while let Some((option, after)) =
            rest.strip_prefix('-').and_then(|r| r.split_once(char::is_whitespace))
        {
            let Some(limit) = value_count(option) else { break };
            let (values, after) = take_values(after, limit, matches!(option, "o" | "s" | "t" | "mm"));
            let number =
                |i: usize| values.get(i).and_then(|v| v.parse().ok()).filter(|v: &f32| v.is_finite());
            match option {
                "bm" => bump = number(0).unwrap_or(bump),
                "clamp" if values.first() == Some(&"on") => wrap = Wrap::Clamp,
                "s" => scale = [number(0).unwrap_or(1.0), number(1).unwrap_or(1.0)],
                "o" => offset = [number(0).unwrap_or(0.0), number(1).unwrap_or(0.0)],
                _ => {}
            }
            rest = after;
        }
        // The options count v up the image, textures count it down: v' = 1 - (scale * (1 - v) + offset).
        let v_offset = 1.0 - scale[1] - offset[1];
        Self {
            file: portable(rest).into(),
            bump,
            sampler: Sampler { wrap: [wrap; 2], nearest: false },
            uv_transform: [[scale[0], 0.0, offset[0]], [0.0, scale[1], v_offset]],
        }
    }

    /// The texture, given the place of its image in the scene.
    pub fn reference(&self, image: u32) -> TextureRef {
        TextureRef { image, sampler: self.sampler, uv_slot: 0, uv_transform: self.uv_transform }
    }
}

/// At most how many values an option takes.
fn value_count(option: &str) -> Option<usize> {
    match option {
        "o" | "s" | "t" => Some(3),
        "mm" => Some(2),
        "blendu" | "blendv" | "bm" | "boost" | "cc" | "clamp" | "imfchan" | "texres" | "type" => Some(1),
        _ => None,
    }
}

/// The next words, up to `limit` of them and, where they are to be, only `numeric` ones.
fn take_values(mut rest: &str, limit: usize, numeric: bool) -> (Vec<&str>, &str) {
    let mut values = Vec::new();
    rest = rest.trim_start();
    while values.len() < limit {
        let Some((word, after)) = rest.split_once(char::is_whitespace) else { break };
        if numeric && word.parse::<f32>().is_err() {
            break;
        }
        values.push(word);
        rest = after.trim_start();
    }
    (values, rest)
}

/// File names written on Windows.
fn portable(name: &str) -> String {
    name.replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_checked_and_spelt_as_tobj_reads_them() {
        let cases = [
            ("KD 0.5", Some("Kd 0.5 0.5 0.5")),
            ("Ke 1 2 3 # bright", Some("Ke 1 2 3")),
            ("d -halo 0.25", Some("d 0.25")),
            ("Bump a b.png", Some("map_Bump a b.png")),
            ("illum 99999", None),
            ("Ks nonsense", None),
            ("", None),
        ];
        for (line, expected) in cases {
            assert_eq!(clean_line(line), Ok(expected.map(String::from)), "{line}");
        }
        for bad in ["Kd 1 2", "Kd spectral a.rfl", "Kd", "Ns x", "d nan", "newmtl", "map_Kd"] {
            assert!(clean_line(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn texture_options_come_before_the_file() {
        let line = TextureLine::parse(r"-bm 0.5 -s 2 4 -o 0.25 0.5 0 -clamp on dir\my file.png");
        assert_eq!((line.file.to_str(), line.bump), (Some("dir/my file.png"), 0.5));
        assert_eq!(line.sampler.wrap, [Wrap::Clamp; 2]);
        assert_eq!(line.uv_transform, [[2.0, 0.0, 0.25], [0.0, 4.0, -3.5]]);
        let plain = TextureLine::parse("-texres 512 -unknown.png");
        assert_eq!(plain.file.to_str(), Some("-unknown.png"));
        assert_eq!(plain.uv_transform, TextureRef::IDENTITY);
    }
}
