//! Static lights from a CSV file.

use super::{Light, Spot};
use crate::{Error, Result, text};
use csv::{ReaderBuilder, StringRecord, Trim};
use sha2::{Digest, Sha256};
use std::path::Path;

/// Columns in the order of a [`Light`]'s values; those from [`OPTIONAL`] on may be missing.
const COLUMNS: [&str; 15] =
    ["x", "y", "z", "r", "g", "b", "i", "i0", "r0", "r1", "dx", "dy", "dz", "inner", "outer"];

/// The first column that may be missing.
const OPTIONAL: usize = 9;

/// The first of the columns of a spot's cone.
const CONE: usize = 10;

/// The column that makes a light a spot.
const OUTER: usize = 14;

/// Lights of a file, which is known by what it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct LightsFile {
    /// Lights in the order of the file's rows.
    pub lights: Vec<Light>,
    /// Hexadecimal SHA-256 of the file.
    pub sha256: String,
}

/// Reads lights from a CSV file with a header, one light a row: position `x,y,z` in metres, linear tint `r,g,b`,
/// intensity `i`, cut-off `i0`, near radius `r0` and influence radius `r1` in metres, columns in any order.
/// Where `r1` has no column or no value, it is sqrt(i/i0); where it is less than that, the light's cut-off is raised to
/// i/r1^2, so that the light still fades to nothing at `r1`.
///
/// A row with a value of `outer` is a spot light: direction `dx,dy,dz` of any length, half angles `inner` (0 where it has no value)
/// and `outer` in degrees. Without, the others are without meaning and have no value.
///
/// # Errors
/// [`Error::File`] with line and column where the file cannot be read, has not these columns, holds no light, or
/// a value is not what a light can have.
pub fn load_csv(path: impl AsRef<Path>) -> Result<LightsFile> {
    let path = path.as_ref();
    let bytes = std::fs::read(path).map_err(|error| Error::file(path, error))?;
    // Names and values in quotes may hold line breaks.
    let fail = |message: String| Error::file(path, message.replace(char::is_control, " "));
    let lights = read(&bytes).map_err(fail)?;
    let sha256 = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(LightsFile { lights, sha256 })
}

fn read(bytes: &[u8]) -> Result<Vec<Light>, String> {
    let text = text::decode(bytes)?;
    let mut reader = ReaderBuilder::new().trim(Trim::All).from_reader(text.as_bytes());
    let places = places(reader.headers().map_err(|error| error.to_string())?)?;
    let mut lights = Vec::new();
    let mut record = StringRecord::new();
    while reader.read_record(&mut record).map_err(|error| error.to_string())? {
        let light = light(&record, &places).map_err(|(column, message)| {
            format!("line {}, column {column}: {message}", record.position().map_or(0, |at| at.line()))
        })?;
        lights.push(light);
    }
    if lights.is_empty() {
        return Err("holds no lights; give at least one row below the header".to_owned());
    }
    Ok(lights)
}

/// Where each of [`COLUMNS`] stands in a row.
fn places(header: &StringRecord) -> Result<[Option<usize>; COLUMNS.len()], String> {
    let wanted = "x,y,z,r,g,b,i,i0,r0[,r1][,dx,dy,dz,inner,outer]";
    let mut places = [None; COLUMNS.len()];
    for (place, name) in header.iter().enumerate() {
        let Some(column) = COLUMNS.iter().position(|column| *column == name) else {
            return Err(format!("line 1: no column is called `{name}`; the header must be {wanted}"));
        };
        if places[column].replace(place).is_some() {
            return Err(format!("line 1: two columns are called `{name}`"));
        }
    }
    match places[..OPTIONAL].iter().position(Option::is_none) {
        Some(column) => {
            Err(format!("line 1: column `{}` is missing; the header must be {wanted}", COLUMNS[column]))
        }
        None => Ok(places),
    }
}

/// A row, and where its columns stand.
struct Row<'a> {
    record: &'a StringRecord,
    places: &'a [Option<usize>; COLUMNS.len()],
}

impl Row<'_> {
    fn field(&self, column: usize) -> &str {
        self.places[column].and_then(|place| self.record.get(place)).unwrap_or("")
    }

    fn number(&self, column: usize) -> Result<f32, Problem> {
        let field = self.field(column);
        field.parse().map_err(|_| (COLUMNS[column], format!("`{field}` is not a number")))
    }

    /// The cone of a spot.
    fn cone(&self) -> Result<Option<Spot>, Problem> {
        if self.field(OUTER).is_empty() {
            return match (CONE..OUTER).find(|&column| !self.field(column).is_empty()) {
                Some(column) => {
                    Err((COLUMNS[column], "a light without a value of `outer` has no cone".into()))
                }
                None => Ok(None),
            };
        }
        let direction = [self.number(CONE)?, self.number(CONE + 1)?, self.number(CONE + 2)?];
        let inner = if self.field(CONE + 3).is_empty() { 0.0 } else { self.number(CONE + 3)? };
        Ok(Some(Spot::new(direction, inner.to_radians(), self.number(OUTER)?.to_radians())))
    }
}

/// A column, and what is wrong there.
type Problem = (&'static str, String);

fn light(record: &StringRecord, places: &[Option<usize>; COLUMNS.len()]) -> Result<Light, Problem> {
    let row = Row { record, places };
    let number = |column| row.number(column);
    let position = [number(0)?, number(1)?, number(2)?];
    let tint = [number(3)?, number(4)?, number(5)?];
    let mut light = Light::new(position, tint, number(6)?, number(7)?, number(8)?);
    if !row.field(OPTIONAL).is_empty() {
        light = light.ending_at(number(OPTIONAL)?);
    }
    let light = light.shining(row.cone()?);
    light.check()?;
    Ok(light)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::attenuation;
    use crate::lights::Attenuation;

    const HEADER: &str = "x,y,z,r,g,b,i,i0,r0,r1\n";

    fn refusal(row: &str) -> String {
        read(format!("{HEADER}1,2,3,1,1,1,100,0.5,0.1,\n{row}\n").as_bytes()).unwrap_err()
    }

    #[test]
    fn every_spelling_of_the_text_is_the_same_lights() {
        let text = format!("{HEADER}1,2,3,1,1,1,100,0.5,0.1,\n4,5,6,1,1,1,8,0.5,0.25,\n");
        let expected = read(text.as_bytes()).unwrap();
        for bytes in text::tests::spellings(&text) {
            assert_eq!(read(&bytes).unwrap(), expected);
        }
    }

    #[test]
    fn rows_become_lights() {
        let text = format!("{HEADER}1, 2,-3.5,0.5,1,0,100,0.5,0.1,14\n4,5,6,1,1,1,8,0.5,0.25,\n");
        let lights = read(text.as_bytes()).unwrap();
        let first = Light {
            position: [1.0, 2.0, -3.5],
            tint: [0.5, 1.0, 0.0],
            intensity: 100.0,
            cutoff: 100.0 / (14.0 * 14.0),
            r0: 0.1,
            r1: 14.0,
            spot: None,
        };
        assert_eq!(lights[0], first);
        assert_eq!((lights[1].r0, lights[1].r1), (0.25, 4.0));
    }

    #[test]
    fn a_file_is_known_by_what_it_holds() {
        let directory = tempfile::tempdir().unwrap();
        let [a, b, c] = ["a.csv", "b.csv", "c.csv"].map(|name| directory.path().join(name));
        let text = format!("{HEADER}1,2,3,1,1,1,100,0.5,0.1,\n");
        std::fs::write(&a, &text).unwrap();
        std::fs::write(&b, &text).unwrap();
        std::fs::write(&c, text.replace("100", "101")).unwrap();
        let hash = |path: &Path| load_csv(path).unwrap().sha256;
        assert_eq!(hash(&a), hash(&b));
        assert_ne!(hash(&a), hash(&c));
        assert_eq!(hash(&a).len(), 64);
    }

    #[test]
    fn a_light_fades_to_nothing_at_its_r1() {
        let text =
            format!("{HEADER}1,2,3,1,1,1,8,0.5,0.25,2\n1,2,3,1,1,1,8,0.5,0.25,4\n1,2,3,1,1,1,8,0.5,0.25,6\n");
        let lights = read(text.as_bytes()).unwrap();
        assert_eq!(
            lights.iter().map(|l| (l.r1, l.cutoff)).collect::<Vec<_>>(),
            [(2.0, 2.0), (4.0, 0.5), (6.0, 0.5)]
        );
        for light in &lights {
            let edge = attenuation(Attenuation::PhyRed2, light, f64::from(light.r1) - 1e-9);
            assert!(edge.abs() < 1e-6, "{light:?} ends in an edge of {edge}");
        }
    }

    #[test]
    fn r1_may_be_left_out_and_columns_may_change_places() {
        let lights = read(b"r0,i0,i,b,g,r,z,y,x\n0.1,0.5,8,0.3,0.2,0.1,3,2,1\n").unwrap();
        assert_eq!(lights[0].position, [1.0, 2.0, 3.0]);
        assert_eq!(lights[0].tint, [0.1, 0.2, 0.3]);
        assert_eq!(lights[0].r1, 4.0);
    }

    #[test]
    fn a_value_that_no_light_has_is_named_with_line_and_column() {
        for (row, start) in [
            ("NaN,2,3,1,1,1,100,0.5,0.1,", "line 3, column x: NaN"),
            ("1,2,inf,1,1,1,100,0.5,0.1,", "line 3, column z: inf"),
            ("1,two,3,1,1,1,100,0.5,0.1,", "line 3, column y: `two`"),
            ("1,2,3,1,-1,1,100,0.5,0.1,", "line 3, column g: -1"),
            ("1,2,3,1,1,1,0,0.5,0.1,", "line 3, column i: 0"),
            ("1,2,3,1,1,1,100,-0.5,0.1,", "line 3, column i0: -0.5"),
            ("1,2,3,1,1,1,100,0.5,0,", "line 3, column r0: 0"),
            ("1,2,3,1,1,1,100,0.5,15,", "line 3, column r0: 15"),
            ("1,2,3,1,1,1,100,0.5,0.1,0", "line 3, column r1: 0"),
            ("1,2,3,1,1,1,100,,0.1,", "line 3, column i0: ``"),
        ] {
            let message = refusal(row);
            assert!(message.starts_with(start), "{row}: {message}");
        }
        assert!(refusal("1,2,3").contains("line: 3"), "{}", refusal("1,2,3"));
    }

    #[test]
    fn rows_with_an_outer_angle_are_spots() {
        let header = "x,y,z,r,g,b,i,i0,r0,dx,dy,dz,inner,outer\n";
        let read_row = |row: &str| read(format!("{header}{row}\n").as_bytes());
        let start = "1,2,3,1,1,1,100,0.5,0.1";
        assert_eq!(read_row(&format!("{start},,,,,")).unwrap()[0].spot, None);
        let spot = read_row(&format!("{start},0,-2,0,10,20")).unwrap()[0].spot.unwrap();
        assert_eq!(spot.direction, [0.0, -1.0, 0.0]);
        assert!(
            (spot.inner.to_degrees() - 10.0).abs() < 1e-4 && (spot.outer.to_degrees() - 20.0).abs() < 1e-4
        );
        assert_eq!(read_row(&format!("{start},0,-2,0,,20")).unwrap()[0].spot.unwrap().inner, 0.0);
        for (cone, told) in [
            ("0,0,0,10,20", "column dx: 0,0,0 is no direction"),
            ("0,1,,10,20", "column dz: `` is not a number"),
            ("0,1,0,30,20", "column inner: 30"),
            ("0,1,0,0,95", "column outer: 95"),
            ("0,1,0,,", "column dx: a light without a value of `outer` has no cone"),
        ] {
            let message = read_row(&format!("{start},{cone}")).unwrap_err();
            assert!(message.contains(told), "{message}");
        }
    }

    #[test]
    fn files_without_header_or_lights_are_refused() {
        assert!(read(b"").unwrap_err().contains("`x` is missing"));
        assert!(read(b"1,2,3,1,1,1,100,0.5,0.1\n").unwrap_err().contains("called `1`"));
        assert!(read(b"x,x,z,r,g,b,i,i0,r0\n").unwrap_err().contains("two columns"));
        assert!(read(HEADER.as_bytes()).unwrap_err().contains("no lights"));
        assert!(read(b"x,y,z,r,g,b,i,i0,r0\n\xff,2,3,1,1,1,1,1,0.1\n").is_err());
        assert!(
            load_csv("/nowhere/lights.csv").unwrap_err().to_string().starts_with("/nowhere/lights.csv: ")
        );
    }
}
