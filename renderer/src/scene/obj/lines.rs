//! The line structure that OBJ and MTL share: continuation, comments, names.

use std::borrow::Cow;

/// A statement: a line, with those that continue it.
#[derive(Debug, PartialEq)]
pub(super) struct Statement<'a> {
    /// First line of the statement, from 1.
    pub line: usize,
    text: Cow<'a, str>,
}

impl Statement<'_> {
    /// The first word, and all after it without space around.
    pub fn split(&self) -> (&str, &str) {
        let text = self.text.trim();
        let (keyword, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        (keyword, rest.trim_start())
    }
}

/// Where ZBrush hides the colours of vertices.
const POLYPAINT: &str = "#MRGB";

/// The statements of a text whose lines end with LF. Empty lines and comments are skipped.
pub(super) fn statements(text: &str) -> impl Iterator<Item = Statement<'_>> {
    let mut lines = text.split('\n').zip(1..);
    std::iter::from_fn(move || {
        loop {
            let (first, line) = lines.next()?;
            let start = first.trim();
            if start.is_empty() || start.starts_with('#') && !start.starts_with(POLYPAINT) {
                continue;
            }
            let Some(start) = continued(start) else {
                return Some(Statement { line, text: first.into() });
            };
            let mut joined = start.to_owned();
            for (next, _) in lines.by_ref() {
                joined.push(' ');
                match continued(next) {
                    Some(next) => joined.push_str(next),
                    None => {
                        joined.push_str(next);
                        break;
                    }
                }
            }
            return Some(Statement { line, text: joined.into() });
        }
    })
}

/// A line that the next one continues, without its backslash. At the end of a path it is part of the path, and so is
/// the one of a comment.
fn continued(line: &str) -> Option<&str> {
    let line = line.trim();
    let start = line.strip_suffix('\\')?;
    let keyword = line.split_whitespace().next().unwrap_or_default().to_lowercase();
    let names_file = keyword.starts_with("map_")
        || matches!(keyword.as_str(), "mtllib" | "bump" | "norm" | "disp" | "decal" | "refl");
    let is_path = names_file && !start.ends_with(char::is_whitespace);
    (!is_path && !line.starts_with('#')).then_some(start)
}

/// Numbers and indices without the comment behind them; `1.#IND` and its like are what some C libraries call numbers.
pub(super) fn without_comment(rest: &str) -> &str {
    let is_number = |at: usize| {
        let after = &rest[at + 1..];
        rest[..at].ends_with('.') && ["IN", "QNAN", "SNAN"].iter().any(|name| after.starts_with(name))
    };
    match rest.match_indices('#').find(|(at, _)| !is_number(*at)) {
        Some((at, _)) => rest[..at].trim_end(),
        None => rest,
    }
}

/// A name without the comment that may stand behind it; `#` within a word belongs to it.
pub(super) fn name_without_comment(name: &str) -> &str {
    let begins = |at: usize| name[..at].ends_with(char::is_whitespace);
    match name.match_indices('#').find(|(at, _)| begins(*at)) {
        Some((at, _)) => name[..at].trim_end(),
        None => name,
    }
}

/// A name without the quotes around it.
pub(super) fn unquoted(name: &str) -> &str {
    let inner = name.strip_prefix('"').and_then(|name| name.strip_suffix('"'));
    inner.map_or(name, str::trim)
}

/// File names written on Windows.
pub(super) fn portable(name: &str) -> String {
    name.replace('\\', "/")
}

/// Reads a finite number.
pub(super) fn number(word: &str) -> Option<f32> {
    word.parse().ok().filter(|number: &f32| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(text: &str) -> Vec<(usize, String, String)> {
        let owned = |statement: Statement| {
            let (keyword, rest) = statement.split();
            (statement.line, keyword.to_owned(), rest.to_owned())
        };
        statements(text).map(owned).collect()
    }

    fn one(line: usize, keyword: &str, rest: &str) -> (usize, String, String) {
        (line, keyword.into(), rest.into())
    }

    #[test]
    fn a_backslash_at_the_end_continues() {
        let text = "# c:\\models\\\nf 1 2 \\\n 3\\ \t\n4\n\n\tg\u{b}a b \n#MRGB ffff\nv 1 \\";
        let expected =
            [one(2, "f", "1 2  3 4"), one(6, "g", "a b"), one(7, "#MRGB", "ffff"), one(8, "v", "1")];
        assert_eq!(split(text), expected);
    }

    #[test]
    fn a_backslash_that_ends_a_path_does_not() {
        let text = "map_Kd C:\\tex\\\nnewmtl b\nmap_Kd -s 1 1 \\\n a.png\n";
        let expected =
            [one(1, "map_Kd", "C:\\tex\\"), one(2, "newmtl", "b"), one(3, "map_Kd", "-s 1 1   a.png")];
        assert_eq!(split(text), expected);
    }

    #[test]
    fn comments_end_numbers_and_names() {
        assert_eq!(without_comment("1 2 3 # red"), "1 2 3");
        assert_eq!(without_comment("1 2 3#4"), "1 2 3");
        assert_eq!(without_comment("1.#IND -1.#QNAN0 # x"), "1.#IND -1.#QNAN0");
        assert_eq!(name_without_comment("wall#2 # old"), "wall#2");
        assert_eq!(name_without_comment("#2"), "#2");
        assert_eq!((unquoted("\"a b\""), unquoted("\""), unquoted("a\"")), ("a b", "\"", "a\""));
    }
}
