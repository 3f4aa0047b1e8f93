//! OBJ text made safe: every line checked, and what tobj misreads rewritten.

use std::collections::BTreeSet;

/// Checked text and what it refers to.
#[derive(Debug, PartialEq)]
pub(super) struct Source {
    /// For tobj: one `mtllib` line first, then vertices, faces, groups and `usemtl`.
    pub text: String,
    /// `mtllib` names in order.
    pub libraries: Vec<String>,
    /// `usemtl` names.
    pub materials: BTreeSet<String>,
}

/// Which of coordinates and normals the corners of a face have.
type Format = [bool; 2];

/// Checks OBJ text.
///
/// Comments, lines (`l`, which tobj would take for faces) and what no renderer reads are dropped. A group is
/// begun wherever the format of the faces changes, because tobj keeps coordinates and normals in step with
/// positions only where all corners of a group have them.
///
/// # Errors
/// Line number and what is wrong with that line.
pub(super) fn clean(bytes: &[u8]) -> Result<Source, String> {
    let text = String::from_utf8_lossy(bytes);
    let mut cleaner = Cleaner {
        source: Source {
            text: String::with_capacity(text.len() + 16),
            libraries: Vec::new(),
            materials: BTreeSet::new(),
        },
        counts: [0; 3],
        format: None,
        colored: None,
    };
    cleaner.keep("mtllib all");
    for (i, line) in text.lines().enumerate() {
        cleaner.line(line.trim()).map_err(|message| format!("line {}: {message}", i + 1))?;
    }
    Ok(cleaner.source)
}

struct Cleaner {
    source: Source,
    /// `v`, `vt`, `vn` so far.
    counts: [usize; 3],
    /// Of the faces of the group so far.
    format: Option<Format>,
    /// Whether vertices have colours.
    colored: Option<bool>,
}

impl Cleaner {
    fn line(&mut self, line: &str) -> Result<(), String> {
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        match keyword {
            "v" => self.vertex(without_comment(rest)),
            "vt" => self.numbers(1, "vt", without_comment(rest), 2..=3),
            "vn" => self.numbers(2, "vn", without_comment(rest), 3..=3),
            "f" => self.face(without_comment(rest)),
            "g" | "o" => {
                self.format = None;
                self.keep("g");
                Ok(())
            }
            "usemtl" if rest.is_empty() => Err("usemtl without a name".into()),
            "usemtl" => {
                self.source.materials.insert(rest.to_owned());
                self.source.text.extend(["usemtl ", rest, "\n"]);
                Ok(())
            }
            "mtllib" => {
                self.source.libraries.push(rest.to_owned());
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn keep(&mut self, line: &str) {
        self.source.text.push_str(line);
        self.source.text.push('\n');
    }

    fn vertex(&mut self, rest: &str) -> Result<(), String> {
        let count = rest.split_whitespace().count();
        let colored = count >= 6;
        if *self.colored.get_or_insert(colored) != colored {
            return Err("some vertices have colours and some have none".into());
        }
        if count == 5 {
            return Err("v has 5 numbers; x y z, x y z w or x y z r g b are read".into());
        }
        if count == 4 && rest.split_whitespace().nth(3).and_then(|w| w.parse().ok()) == Some(0.0_f32) {
            return Err("v has a weight of 0".into());
        }
        self.numbers(0, "v", rest, 3..=6)
    }

    fn numbers(
        &mut self,
        kind: usize,
        keyword: &str,
        rest: &str,
        counts: std::ops::RangeInclusive<usize>,
    ) -> Result<(), String> {
        let mut count = 0;
        for word in rest.split_whitespace() {
            count += 1;
            let number: f32 = word.parse().unwrap_or(f32::NAN);
            if !number.is_finite() {
                return Err(format!("{keyword} has {word}, which is not a finite number"));
            }
        }
        if !counts.contains(&count) {
            return Err(format!("{keyword} has {count} numbers; {} are expected", counts.start()));
        }
        self.counts[kind] += 1;
        let text = &mut self.source.text;
        text.extend([keyword, " ", rest, "\n"]);
        Ok(())
    }

    fn face(&mut self, rest: &str) -> Result<(), String> {
        let mut corners = 0;
        let mut format = None;
        for corner in rest.split_whitespace() {
            let here = self.corner(corner).map_err(|m| format!("face corner {corner} {m}"))?;
            if *format.get_or_insert(here) != here {
                return Err("some corners of the face have coordinates or normals that others lack".into());
            }
            corners += 1;
        }
        let format = format.filter(|_| corners >= 3).ok_or_else(|| format!("a face of {corners} corners"))?;
        if *self.format.get_or_insert(format) != format {
            self.keep("g");
            self.format = Some(format);
        }
        self.source.text.extend(["f ", rest, "\n"]);
        Ok(())
    }

    fn corner(&self, corner: &str) -> Result<Format, String> {
        let mut present = [false; 3];
        for (kind, index) in corner.split('/').enumerate() {
            let name = ["v", "vt", "vn"].get(kind).ok_or("has more than three indices")?;
            if index.is_empty() {
                continue;
            }
            let number: i64 = index.parse().map_err(|_| format!("has the index {index}"))?;
            let count = self.counts[kind];
            if number == 0 || number.unsigned_abs() > count as u64 {
                return Err(format!("refers to {name} {number}; {count} are defined so far"));
            }
            present[kind] = true;
        }
        let [position, coordinates, normal] = present;
        if position { Ok([coordinates, normal]) } else { Err("has no position".into()) }
    }
}

fn without_comment(rest: &str) -> &str {
    rest.split('#').next().unwrap_or_default().trim_end()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(obj: &str) -> String {
        clean(obj.as_bytes()).unwrap().text
    }

    #[test]
    fn keeps_geometry_and_drops_the_rest() {
        let source = "# a cube\nmtllib a b.mtl\no cube\n v\t0 0 0 # first\nv 1 0 0\nv 0 1 0\ns 1\nl 1 2 3\n\
            usemtl red paint\nf 1 2 -1\n";
        let clean = clean(source.as_bytes()).unwrap();
        assert_eq!(clean.text, "mtllib all\ng\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red paint\nf 1 2 -1\n");
        assert_eq!(clean.libraries, ["a b.mtl"]);
        assert_eq!(clean.materials, BTreeSet::from(["red paint".to_owned()]));
    }

    #[test]
    fn a_change_of_face_format_begins_a_group() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
        let faces = "f 1 2 3\nf 1/1 2/1 3/1\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\n";
        let expected = "f 1 2 3\ng\nf 1/1 2/1 3/1\nf 1/1 2/1 3/1\ng\nf 1//1 2//1 3//1\n";
        assert_eq!(text(&format!("{vertices}{faces}")), format!("mtllib all\n{vertices}{expected}"));
    }

    #[test]
    fn errors_name_the_line() {
        let cases = [
            ("v 0 0", "line 1: v has 2 numbers; 3 are expected"),
            ("v 0 0 x", "line 1: v has x, which is not a finite number"),
            ("v 0 nan 0", "line 1: v has nan"),
            ("vn 0 1e99 0", "line 1: vn has 1e99"),
            ("v 0 0 0 0", "line 1: v has a weight of 0"),
            ("v 0 0 0 1 1", "line 1: v has 5 numbers"),
            ("v 0 0 0 1 1 1\nv 0 0 0", "line 2: some vertices have colours"),
            ("v 0 0 0\n\nf 1 1 2", "line 3: face corner 2 refers to v 2; 1 are defined so far"),
            ("v 0 0 0\nf 1 1 -2", "line 2: face corner -2 refers to v -2"),
            ("v 0 0 0\nf 1 1 0", "line 2: face corner 0 refers to v 0"),
            ("v 0 0 0\nf 1/1 1/1 1/1", "line 2: face corner 1/1 refers to vt 1; 0"),
            ("v 0 0 0\nf 1/-9223372036854775808 1 1", "line 2: face corner 1/-9223372036854775808"),
            ("v 0 0 0\nf 1 1", "line 2: a face of 2 corners"),
            ("v 0 0 0\nf 1 a 1", "line 2: face corner a has the index a"),
            ("v 0 0 0\nvt 0 0\nf 1/1 1 1", "line 3: some corners of the face"),
            ("vt 0", "line 1: vt has 1 numbers"),
            ("usemtl", "line 1: usemtl without a name"),
        ];
        for (obj, expected) in cases {
            let message = clean(obj.as_bytes()).unwrap_err();
            assert!(message.starts_with(expected), "{obj:?}: {message}");
        }
    }
}
