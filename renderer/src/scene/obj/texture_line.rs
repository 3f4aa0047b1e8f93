//! The file and the options of an MTL texture line.

use std::path::PathBuf;

use super::super::{Sampler, TextureRef, Wrap};
use super::lines::{name_without_comment, number, portable, unquoted};
use super::oddities::shown;

/// A texture line without its keyword: `[-option value...]... file`, or the options behind the file.
#[derive(Debug, PartialEq)]
pub(super) struct TextureLine {
    /// Path of the image as written, with forward slashes.
    pub file: PathBuf,
    /// Strength of bumps, `-bm`.
    pub bump: f32,
    sampler: Sampler,
    uv_transform: [[f32; 3]; 2],
}

/// What options say.
#[derive(Debug)]
struct Options {
    bump: f32,
    wrap: Wrap,
    scale: [f32; 2],
    offset: [f32; 2],
    /// The first that is not drawn.
    ignored: Option<String>,
}

/// What follows the name of an option.
#[derive(Debug, Clone, Copy)]
enum Values {
    /// Takes at most so many numbers.
    Numbers(usize),
    /// Takes `on` or `off`.
    Switch,
    /// Takes any word.
    Word,
}

impl TextureLine {
    /// Reads a line; `exists` tells which of the names that it may mean is a file. `None` where no name is left. Also
    /// the first option that is not drawn.
    pub fn parse(line: &str, exists: &dyn Fn(&str) -> bool) -> (Option<Self>, Option<String>) {
        let mut options = Options::default();
        let name = options.take_front(line.trim());
        let Some(file) = options.choose(name, exists) else { return (None, options.ignored) };
        let Options { bump, wrap, scale, offset, ignored } = options;
        // The options count v up the image, textures count it down: v' = 1 - (scale * (1 - v) + offset).
        let v_offset = 1.0 - scale[1] - offset[1];
        let this = Self {
            file: portable(file).into(),
            bump,
            sampler: Sampler { wrap: [wrap; 2], nearest: false },
            uv_transform: [[scale[0], 0.0, offset[0]], [0.0, scale[1], v_offset]],
        };
        (Some(this), ignored)
    }

    /// The texture, given the place of its image in the scene.
    pub fn reference(&self, image: u32) -> TextureRef {
        TextureRef { image, sampler: self.sampler, uv_set: 0, uv_transform: self.uv_transform }
    }
}

impl Default for Options {
    fn default() -> Self {
        Self { bump: 1.0, wrap: Wrap::Repeat, scale: [1.0; 2], offset: [0.0; 2], ignored: None }
    }
}

impl Options {
    /// Reads the known options in front; what is left begins with the name.
    fn take_front<'a>(&mut self, mut rest: &'a str) -> &'a str {
        while let (Some(option), after) = first_word(rest) {
            let Some((name, values)) = known(option) else { break };
            let (values, after) = take_values(after, values);
            self.set(&name, &values);
            rest = after;
        }
        rest
    }

    /// The name within what the options in front leave, which may be followed by options or a comment and, where an
    /// unknown option stands before it, be its end only. Of the names that this allows, the first that exists is meant.
    fn choose<'a>(&mut self, rest: &'a str, exists: &dyn Fn(&str) -> bool) -> Option<&'a str> {
        let whole = unquoted(rest);
        if whole.is_empty() {
            return None;
        }
        if exists(whole) {
            return Some(whole);
        }
        let (name, behind) = split_behind(name_without_comment(rest));
        let mut name = unquoted(name);
        if name.starts_with('-') && !exists(name) {
            name = self.after_unknown(name, exists);
        }
        let left = self.take_front(behind);
        if !left.is_empty() {
            self.ignored.get_or_insert_with(|| shown(left));
        }
        (!name.is_empty()).then_some(name)
    }

    /// The name after an unknown option and its values: the longest end of the line that exists, else what stands
    /// after one value.
    fn after_unknown<'a>(&mut self, rest: &'a str, exists: &dyn Fn(&str) -> bool) -> &'a str {
        const MOST_VALUES: usize = 4;
        let (Some(option), after) = first_word(rest) else { return rest };
        if after.is_empty() {
            return rest;
        }
        self.ignored.get_or_insert_with(|| format!("option {}", shown(option)));
        let mut ends = vec![after];
        while let (Some(_), end) = first_word(ends[ends.len() - 1])
            && !end.is_empty()
            && ends.len() <= MOST_VALUES
        {
            ends.push(end);
        }
        let found = ends.iter().find(|end| exists(unquoted(end)));
        unquoted(found.or(ends.get(1)).unwrap_or(&after))
    }

    fn set(&mut self, option: &str, values: &[&str]) {
        let value = |i: usize| values.get(i).and_then(|value| number(value));
        match option {
            "bm" => self.bump = value(0).unwrap_or(self.bump),
            "clamp" if values.first() == Some(&"on") => self.wrap = Wrap::Clamp,
            "s" => self.scale = [value(0).unwrap_or(1.0), value(1).unwrap_or(1.0)],
            "o" => self.offset = [value(0).unwrap_or(0.0), value(1).unwrap_or(0.0)],
            "mm" if value(0).unwrap_or(0.0) == 0.0 && value(1).unwrap_or(1.0) == 1.0 => {}
            "t" if (0..3).all(|i| value(i).unwrap_or(0.0) == 0.0) => {}
            "cc" if values.first() != Some(&"on") => {}
            "mm" | "t" | "cc" | "type" => {
                self.ignored.get_or_insert_with(|| format!("option `-{option}`"));
            }
            _ => {}
        }
    }
}

/// The name and the values of an option that MTL has, or that its exporters have added.
fn known(word: &str) -> Option<(String, Values)> {
    let name = word.strip_prefix('-')?.to_lowercase();
    let values = match name.as_str() {
        "o" | "s" | "t" => Values::Numbers(3),
        "mm" => Values::Numbers(2),
        "bm" | "boost" | "texres" => Values::Numbers(1),
        "blendu" | "blendv" | "cc" | "clamp" => Values::Switch,
        "imfchan" | "type" | "colorspace" => Values::Word,
        _ => return None,
    };
    Some((name, values))
}

/// The name, and the options that stand behind it.
fn split_behind(rest: &str) -> (&str, &str) {
    let dashes = rest.match_indices('-').map(|(at, _)| at);
    let begins = |at: &usize| {
        rest[..*at].ends_with(char::is_whitespace)
            && known(first_word(&rest[*at..]).0.unwrap_or_default()).is_some()
    };
    let at = dashes.skip_while(|&at| at == 0).find(begins).unwrap_or(rest.len());
    (rest[..at].trim_end(), &rest[at..])
}

/// The first word, and what follows it without space in front.
fn first_word(rest: &str) -> (Option<&str>, &str) {
    if rest.is_empty() {
        return (None, rest);
    }
    let (word, after) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
    (Some(word), after.trim_start())
}

/// The values of an option, and what follows them.
fn take_values(mut rest: &str, values: Values) -> (Vec<&str>, &str) {
    let (most, fits): (usize, fn(&str) -> bool) = match values {
        Values::Numbers(most) => (most, |word| word.parse::<f32>().is_ok()),
        Values::Switch => (1, |word| matches!(word, "on" | "off")),
        Values::Word => (1, |_| true),
    };
    let mut taken = Vec::new();
    while taken.len() < most
        && let (Some(word), after) = first_word(rest)
        && fits(word)
    {
        taken.push(word);
        rest = after;
    }
    (taken, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(line: &str, files: &[&str]) -> (Option<TextureLine>, Option<String>) {
        TextureLine::parse(line, &|name| files.contains(&name))
    }

    fn file(line: &str, files: &[&str]) -> Option<String> {
        parse(line, files).0.map(|line| line.file.to_str().unwrap().to_owned())
    }

    #[test]
    fn options_stand_before_or_behind_the_file() {
        let options = "-bm 0.5 -s 2 4 -o 0.25 0.5 0 -CLAMP on";
        let file = r"dir\my file.png";
        for line in
            [format!("{options} {file}"), format!("{file}  {options}"), format!("{options} \"{file}\"")]
        {
            let (Some(line), None) = parse(&line, &[]) else { panic!("{line}") };
            assert_eq!((line.file.to_str(), line.bump), (Some("dir/my file.png"), 0.5));
            assert_eq!(line.sampler.wrap, [Wrap::Clamp; 2]);
            assert_eq!(line.uv_transform, [[2.0, 0.0, 0.25], [0.0, 4.0, -3.5]]);
        }
    }

    #[test]
    fn scales_have_one_to_three_numbers() {
        for (line, scale) in
            [("-s 2 a.png", [2.0, 1.0]), ("-s 2 3 a.png", [2.0, 3.0]), ("-s 2 3 4 a.png", [2.0, 3.0])]
        {
            let line = parse(line, &[]).0.unwrap();
            assert_eq!(
                (line.file.to_str(), line.uv_transform[0][0], line.uv_transform[1][1]),
                (Some("a.png"), scale[0], scale[1])
            );
        }
        assert_eq!(file("-s 1 1 1 2.png", &[]).unwrap(), "2.png");
        assert_eq!(file("-bm a.png", &[]).unwrap(), "a.png");
        assert_eq!(file("-clamp a.png", &[]).unwrap(), "a.png");
        assert_eq!(parse("-texres 512 -imfchan m a.png", &[]).0.unwrap().uv_transform, TextureRef::IDENTITY);
    }

    #[test]
    fn names_may_look_like_options_or_hold_them() {
        assert_eq!(file("-texres 512 -unknown.png", &[]).unwrap(), "-unknown.png");
        assert_eq!(file("wall -s 2.png", &["wall -s 2.png"]).unwrap(), "wall -s 2.png");
        assert_eq!(file("wall-s.png", &[]).unwrap(), "wall-s.png");
        assert_eq!(file("a # b.png", &["a # b.png"]).unwrap(), "a # b.png");
        assert_eq!(file("a#1.png # old", &[]).unwrap(), "a#1.png");
    }

    #[test]
    fn unknown_options_are_skipped_and_told() {
        assert_eq!(file("-colorspace sRGB red.png", &[]).unwrap(), "red.png");
        for (line, files) in [
            ("-gamma 2.2 red.png", &[][..]),
            ("-flip my red.png", &["my red.png"]),
            ("-range 0 1 red.png", &["red.png"]),
        ] {
            let (Some(parsed), Some(ignored)) = parse(line, files) else { panic!("{line}") };
            assert!(parsed.file.to_str().unwrap().ends_with("red.png"), "{parsed:?}");
            assert!(ignored.starts_with("option `-"), "{ignored}");
        }
        assert_eq!(parse("-mm 0 1 -t 0 0 0 -cc off a.png", &[]).1, None);
        assert_eq!(parse("-mm 0.2 1 a.png", &[]).1.unwrap(), "option `-mm`");
    }

    #[test]
    fn no_name_is_no_texture() {
        for line in ["", "\"\"", "-s 1 1 1", "-bm 0.3 "] {
            assert_eq!(file(line, &[]), None, "{line}");
        }
    }
}
