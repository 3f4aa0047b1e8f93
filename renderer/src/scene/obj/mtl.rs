//! MTL text as what it says of each material.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::super::source::SourceFiles;
use super::lines::{self, Statement, name_without_comment, number, portable, unquoted, without_comment};
use super::oddities::{Kind, Oddities, count, shown};
use super::texture_line::TextureLine;
use crate::{Error, Result, text};

/// What an MTL file says of a material, as it says it.
#[derive(Debug, Default)]
pub(super) struct Definition {
    pub name: String,
    /// Path of the MTL file.
    pub file: PathBuf,
    /// Where it begins, from 1.
    line: usize,
    /// Diffuse colour `Kd`, linear.
    pub diffuse: Option<[f32; 3]>,
    /// Emitted colour `Ke`, linear.
    pub emissive: Option<[f32; 3]>,
    /// Specular exponent `Ns`.
    pub exponent: Option<f32>,
    /// Roughness `Pr`.
    pub roughness: Option<f32>,
    /// Metalness `Pm`.
    pub metallic: Option<f32>,
    /// `d`.
    dissolve: Option<f32>,
    /// `Tr` and its line.
    transparency: Option<(f32, usize)>,
    /// 1 opaque to 0 invisible, from `d` and `Tr`.
    pub alpha: f32,
    /// Map of the diffuse colour, `map_Kd`.
    pub color_map: Option<TextureLine>,
    /// Map of the coverage, `map_d`.
    pub mask_map: Option<TextureLine>,
    /// Map of the emitted colour, `map_Ke`.
    pub emissive_map: Option<TextureLine>,
    /// Map of tangent-space normals, `norm`.
    pub normal_map: Option<TextureLine>,
    /// Map of heights, `map_Bump` or `bump`.
    pub bump_map: Option<TextureLine>,
}

/// Statements that the materials here have no use for: Phong's ambient and specular terms, refraction.
const UNUSED: &[&str] = &[
    "aniso",
    "anisor",
    "illum",
    "ka",
    "ks",
    "map_aat",
    "map_ka",
    "map_ks",
    "map_ns",
    "ni",
    "pc",
    "pcr",
    "ps",
    "sharpness",
    "tf",
];

/// Maps that would change the picture and are not drawn.
const NOT_DRAWN: &[&str] =
    &["decal", "disp", "map_decal", "map_disp", "map_pm", "map_pr", "map_ps", "map_refl", "map_tr", "refl"];

/// The materials of all libraries of an OBJ file.
#[derive(Debug, Default)]
pub(super) struct Library {
    pub definitions: Vec<Definition>,
    oddities: Vec<Oddities>,
}

impl Library {
    /// Reads the libraries that an OBJ file names and that lie beside it.
    ///
    /// # Errors
    /// A file that cannot be read or is no text; the first oddity, where they are refused.
    pub fn read(
        obj: &Path,
        names: &[(String, usize)],
        files: &mut SourceFiles,
        oddities: &mut Oddities,
    ) -> Result<Self> {
        let mut library = Self::default();
        let folder = obj.parent().unwrap_or(Path::new(""));
        for (name, line) in names {
            let exists = |name: &str| folder.join(portable(name)).is_file();
            for name in split_names(name, &exists) {
                let path = folder.join(portable(name));
                if exists(name) {
                    library.add(&path, files, oddities)?;
                } else {
                    let what = format_args!("the library {} is missing", shown(name));
                    oddities.note_named(*line, Kind::NoLibrary, name, what)?;
                }
            }
        }
        Ok(library)
    }

    /// Warnings, one a kind for each library of the OBJ file at `scene`.
    pub fn warnings(&self, scene: &Path) -> impl Iterator<Item = String> {
        self.oddities.iter().flat_map(|oddities| oddities.warnings(scene))
    }

    /// What the warnings say.
    #[cfg(test)]
    pub fn messages(&self) -> Vec<String> {
        self.oddities.iter().flat_map(Oddities::messages).collect()
    }

    fn add(&mut self, path: &Path, files: &mut SourceFiles, obj: &Oddities) -> Result<()> {
        let mut oddities = obj.of_same_rigour(path);
        let bytes = files.read(path)?;
        let (text, odd_line) = text::decode_any(&bytes).map_err(|message| Error::file(path, message))?;
        if let Some(line) = odd_line {
            oddities.note(line, Kind::Encoding, "the text is not UTF-8")?;
        }
        let mut reader = Reader { file: path, definitions: Vec::new(), oddities: &mut oddities };
        for statement in lines::statements(&text) {
            reader.statement(&statement)?;
        }
        reader.finish()?;
        self.definitions.append(&mut reader.definitions);
        self.oddities.push(oddities);
        Ok(())
    }

    /// The definition that each of the names after `usemtl` means: the last of that name, else of that name without a
    /// comment behind it. `None` where there is none.
    pub fn find(&self, names: &[(String, usize)]) -> Vec<Option<usize>> {
        let mut exact = BTreeMap::new();
        let mut bare = BTreeMap::new();
        for (i, definition) in self.definitions.iter().enumerate() {
            exact.insert(definition.name.as_str(), i);
            bare.insert(without_note(&definition.name), i);
        }
        let find = |name: &str| {
            let name_alone = without_note(name);
            exact.get(name).or_else(|| exact.get(name_alone)).or_else(|| bare.get(name_alone)).copied()
        };
        names.iter().map(|(name, _)| find(name)).collect()
    }
}

fn without_note(name: &str) -> &str {
    unquoted(name_without_comment(name))
}

/// The files that `mtllib` names: one with spaces, or several, each maybe with spaces or in quotes.
fn split_names<'a>(rest: &'a str, exists: &dyn Fn(&str) -> bool) -> Vec<&'a str> {
    /// Longer names are not put together from words.
    const MOST_WORDS: usize = 16;
    let rest = if exists(unquoted(rest)) { rest } else { name_without_comment(rest) };
    if exists(unquoted(rest)) {
        return vec![unquoted(rest)];
    }
    let mut names = Vec::new();
    let mut left = rest.trim();
    while !left.is_empty() {
        let quoted = left.strip_prefix('"').and_then(|inner| inner.split_once('"'));
        if let Some((name, after)) = quoted {
            names.push(name);
            left = after.trim_start();
            continue;
        }
        let ends = left.match_indices(char::is_whitespace).map(|(end, _)| end).chain([left.len()]);
        let ends: Vec<_> = ends.take(MOST_WORDS).collect();
        let end = ends.iter().rev().find(|end| exists(left[..**end].trim_end())).unwrap_or(&ends[0]);
        names.push(left[..*end].trim_end());
        left = left[*end..].trim_start();
    }
    names
}

struct Reader<'a> {
    file: &'a Path,
    definitions: Vec<Definition>,
    oddities: &'a mut Oddities,
}

impl Reader<'_> {
    fn statement(&mut self, statement: &Statement) -> Result<()> {
        let line = statement.line;
        let (keyword, rest) = statement.split();
        let lower = keyword.to_lowercase();
        if lower == "newmtl" {
            return self.begin(line, unquoted(rest));
        }
        if self.definitions.is_empty() {
            let what = format_args!("{} before the first newmtl", shown(keyword));
            return self.oddities.note(line, Kind::NoOwner, what);
        }
        match lower.as_str() {
            "kd" | "ke" => self.color(line, keyword, rest),
            "ns" | "pr" | "pm" | "d" | "tr" => self.scalar(line, keyword, rest),
            "map_kd" | "map_ke" | "map_d" | "map_bump" | "bump" | "norm" => self.texture(line, keyword, rest),
            "#mrgb" => Ok(()),
            other if UNUSED.contains(&other) => Ok(()),
            other if NOT_DRAWN.contains(&other) => self.oddities.note_named(
                line,
                Kind::NotDrawn,
                other,
                format_args!("`{keyword}` is not drawn"),
            ),
            _ => {
                let keyword = shown(keyword);
                let what = format_args!("unknown keyword {keyword}");
                self.oddities.note_named(line, Kind::UnknownKeyword, &keyword, what)
            }
        }
    }

    fn begin(&mut self, line: usize, name: &str) -> Result<()> {
        if name.is_empty() {
            self.oddities.note(line, Kind::EmptyName, "newmtl without a name")?;
        }
        let (name, file) = (name.to_owned(), self.file.to_owned());
        self.definitions.push(Definition { name, file, line, ..Definition::default() });
        Ok(())
    }

    /// The material that statements are of.
    fn current(&mut self) -> &mut Definition {
        let last = self.definitions.len() - 1;
        &mut self.definitions[last]
    }

    fn scalar(&mut self, line: usize, keyword: &str, rest: &str) -> Result<()> {
        // "-halo" makes alpha depend on the view; only the factor is used.
        let rest = without_comment(rest).trim_start_matches("-halo");
        let mut words = rest.split_whitespace();
        let word = words.next().unwrap_or_default();
        let Some(value) = number(word) else {
            let what = format_args!("{keyword} has {}, which is not a finite number", shown(word));
            return self.oddities.note(line, Kind::Value, what);
        };
        self.stray(line, keyword, 1 + words.count(), 1)?;
        let material = self.current();
        match keyword.to_lowercase().as_str() {
            "ns" => material.exponent = Some(value),
            "pr" => material.roughness = Some(value),
            "pm" => material.metallic = Some(value),
            "tr" => material.transparency = Some((value, line)),
            _ => material.dissolve = Some(value),
        }
        Ok(())
    }

    /// One number stands for all three; spectra and CIE XYZ are not read.
    fn color(&mut self, line: usize, keyword: &str, rest: &str) -> Result<()> {
        let words: Vec<_> = without_comment(rest).split_whitespace().take(4).collect();
        let values: Option<Vec<f32>> = words.iter().take(3).map(|word| number(word)).collect();
        let color = match values.as_deref() {
            Some(&[grey]) => [grey; 3],
            Some(&[r, g, b]) => [r, g, b],
            _ => {
                let what = format_args!("{keyword} has {} instead of three numbers", shown(rest));
                return self.oddities.note(line, Kind::Value, what);
            }
        };
        self.stray(line, keyword, words.len(), 3)?;
        if color.iter().any(|x| *x < 0.0) {
            let what = format_args!("{keyword} has {}, which is below 0", shown(rest));
            return self.oddities.note(line, Kind::Value, what);
        }
        let material = self.current();
        match keyword.to_lowercase().as_str() {
            "kd" => material.diffuse = Some(color),
            _ => material.emissive = Some(color),
        }
        Ok(())
    }

    fn stray(&mut self, line: usize, keyword: &str, words: usize, most: usize) -> Result<()> {
        if words <= most {
            return Ok(());
        }
        let what = format_args!("{keyword} has more than {}", count(most, "number"));
        self.oddities.note(line, Kind::Stray, what)
    }

    fn texture(&mut self, line: usize, keyword: &str, rest: &str) -> Result<()> {
        let folder = self.file.parent().unwrap_or(Path::new(""));
        let exists = |name: &str| folder.join(portable(name)).is_file();
        let (texture, ignored) = TextureLine::parse(rest, &exists);
        if let Some(ignored) = ignored {
            self.oddities.note(line, Kind::TextureOption, format_args!("{keyword} has the {ignored}"))?;
        }
        let Some(mut texture) = texture else {
            return self.oddities.note(line, Kind::EmptyMap, format_args!("{keyword} without a file"));
        };
        let beside = texture.file.file_name().map(PathBuf::from).unwrap_or_default();
        let is_file = |path: &Path| folder.join(path).is_file();
        if !is_file(&texture.file) && is_file(&beside) {
            let what = format_args!("{} is not there", shown(&texture.file.to_string_lossy()));
            self.oddities.note(line, Kind::Moved, what)?;
            texture.file = beside;
        }
        let material = self.current();
        let slot = match keyword.to_lowercase().as_str() {
            "map_kd" => &mut material.color_map,
            "map_ke" => &mut material.emissive_map,
            "map_d" => &mut material.mask_map,
            "norm" => &mut material.normal_map,
            _ => &mut material.bump_map,
        };
        *slot = Some(texture);
        Ok(())
    }

    /// Settles what `d` and `Tr` mean, and notes names that are defined again.
    fn finish(&mut self) -> Result<()> {
        let mut lines = BTreeMap::new();
        for i in 0..self.definitions.len() {
            let Definition { name, line, .. } = &self.definitions[i];
            if let Some(before) = lines.insert(name.clone(), *line) {
                let what = format_args!("{} is defined in line {before} too", shown(name));
                self.oddities.note(*line, Kind::Twice, what)?;
            }
            self.definitions[i].alpha = self.alpha(i)?;
        }
        Ok(())
    }

    /// `d` decides where there is one. `Tr` alone is 1 - d to most programs, but to others d itself; since nobody means
    /// a material that is never seen, a `Tr` of 1 is opaque.
    fn alpha(&mut self, i: usize) -> Result<f32> {
        let Definition { dissolve, transparency, line, .. } = self.definitions[i];
        let name = shown(&self.definitions[i].name);
        match (dissolve, transparency) {
            (Some(d), Some((tr, line))) if d >= 1.0 && tr >= 1.0 => {
                let what = format_args!("material {name} has d {d} and Tr {tr}");
                self.oddities.note(line, Kind::Transparency, what)?;
            }
            (None, Some((tr, line))) if tr >= 1.0 => {
                let what =
                    format_args!("material {name} has Tr {tr} alone, which makes it invisible or opaque");
                self.oddities.note(line, Kind::Transparency, what)?;
                return Ok(1.0);
            }
            _ => {}
        }
        let alpha = dissolve.or(transparency.map(|(tr, _)| 1.0 - tr)).unwrap_or(1.0).clamp(0.0, 1.0);
        if alpha == 0.0 {
            let what = format_args!("material {name} is wholly transparent");
            self.oddities.note(line, Kind::Invisible, what)?;
        }
        Ok(alpha)
    }
}
