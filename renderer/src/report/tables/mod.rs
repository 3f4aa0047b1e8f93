//! Tables over several ways of building light lists: Indi against Encl by each, and the tests against the exact one.

mod stereo;
mod tests_of_lights;

use super::results::{Run, metric};
use crate::stats::{self, Interval, Measured};
use std::io::{self, Write};

/// A table of numbers under grouped headings.
#[derive(Debug, Clone)]
pub struct Table {
    /// Name of its file.
    pub id: &'static str,
    /// One line.
    pub title: &'static str,
    /// What is in it.
    pub caption: &'static str,
    /// Headings of the columns of words.
    pub labels: &'static [&'static str],
    /// Headings of the columns of numbers, each over so many columns.
    pub groups: Vec<(&'static str, &'static [&'static str])>,
    /// Rows; those of one setting stand together.
    pub rows: Vec<Row>,
}

/// One line of a table.
#[derive(Debug, Clone)]
pub struct Row {
    /// What the rows of a block share.
    pub setting: String,
    /// Words.
    pub labels: Vec<String>,
    /// Numbers; `None` where there are no data.
    pub numbers: Vec<Option<f64>>,
}

/// Every table that has rows.
pub fn all(set: &super::results::ResultSet) -> Vec<Table> {
    [stereo::table(set), tests_of_lights::table(set)]
        .into_iter()
        .filter(|table| !table.rows.is_empty())
        .collect()
}

impl Table {
    /// One line a row, under the headings joined with their groups'.
    ///
    /// # Errors
    /// The writer fails.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        let numbers = self.groups.iter().flat_map(|(group, columns)| {
            columns.iter().map(move |column| format!("{group} {column}").trim().to_owned())
        });
        let words = ["setting"].into_iter().chain(self.labels.iter().copied()).map(str::to_owned);
        csv.write_record(words.chain(numbers).map(|heading| heading.replace(' ', "_")))?;
        for row in &self.rows {
            let cells = row.numbers.iter().map(|cell| cell.map_or(String::new(), |value| value.to_string()));
            csv.write_record([row.setting.clone()].into_iter().chain(row.labels.clone()).chain(cells))?;
        }
        csv.flush()
    }
}

fn mean(run: &Run, metric: &str) -> Option<f64> {
    stats::mean(run.frames.values(metric))
}

/// Mean time from the list of visible clusters to the finished light lists, milliseconds.
fn assignment(run: &Run) -> Option<f64> {
    Some(mean(run, metric::CLUSTER)? - mean(run, metric::VISIBILITY)?)
}

/// The ends of its 95 % interval, milliseconds.
fn assignment_interval(run: &Run) -> [Option<f64>; 2] {
    let parts = [metric::CLUSTER, metric::VISIBILITY].map(|metric| run.measured(metric));
    let [Some(cluster), Some(visibility)] = parts else { return [None, None] };
    let difference = Measured::combine([&cluster, &visibility], |[cluster, visibility]| cluster - visibility);
    let interval = difference.interval();
    Interval::ends(interval)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::testing::{run, set};
    use crate::report::way::Way;

    /// A run by a way whose metrics all are `value`.
    fn by(way: [&str; 2], method: &str, views: u32, value: f64) -> Run {
        let mut made = run(method, views, 1000, move |name, _| {
            Some(if name == metric::VISIBILITY { value / 4.0 } else { value })
        });
        made.setting.way = Way::named(way[0], way[1], made.method);
        made
    }

    #[test]
    fn indi_and_encl_are_paired_within_a_way_alone() {
        let runs = vec![
            by(["brute", "hs"], "indi-persp-64", 2, 8.0),
            by(["brute", "hs"], "encl-persp-64", 2, 4.0),
            by(["hierarchy", "hs"], "indi-persp-64", 2, 8.0),
            by(["hierarchy", "hs"], "encl-persp-64", 2, 6.0),
            by(["scatter", "hs"], "encl-persp-64", 2, 1.0),
            by(["brute", "hs"], "indi-ortho-4", 1, 8.0),
        ];
        let table = stereo::table(&set(runs));
        let rows: Vec<(&str, Option<f64>)> =
            table.rows.iter().map(|row| (row.labels[2].as_str(), row.numbers[2])).collect();
        assert_eq!(rows, [("brute force", Some(0.5)), ("hierarchy", Some(0.75))]);
        assert!(table.rows[0].setting == table.rows[1].setting);
    }

    #[test]
    fn false_positives_are_what_is_listed_beyond_the_exact() {
        let method = "indi-persp-64";
        let runs = vec![
            by(["brute", "exact"], method, 1, 8.0),
            by(["brute", "hs"], method, 1, 12.0),
            by(["scatter", "hs"], method, 1, 12.0),
            by(["brute", "hs"], "indi-ortho-4", 1, 12.0),
        ];
        let table = tests_of_lights::table(&set(runs));
        let rows: Vec<(Vec<&str>, Option<f64>)> = table
            .rows
            .iter()
            .map(|row| (row.labels[2..].iter().map(String::as_str).collect(), row.numbers[1]))
            .collect();
        let expected = [
            (vec!["hs", "brute"], Some(50.0)),
            (vec!["exact", "brute"], Some(0.0)),
            (vec!["hs", "scatter"], Some(50.0)),
        ];
        assert_eq!(rows, expected);
        assert_eq!(table.rows[0].numbers[3], Some(9.0), "clustering less visibility");
    }

    #[test]
    fn the_csv_has_a_heading_a_column() {
        let runs = ["indi-ortho-4", "encl-ortho-4"].map(|method| by(["brute", "box"], method, 2, 2.0));
        let mut csv = vec![];
        stereo::table(&set(runs.to_vec())).write_csv(&mut csv).unwrap();
        let text = String::from_utf8(csv).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert!(
            lines[0].starts_with("setting,method,lighting,assigned_by,visible_clusters_Indi,"),
            "{}",
            lines[0]
        );
        assert!(lines[1].contains(",Ortho 4,1000 lights,brute force,2,2,1,"), "{}", lines[1]);
        assert_eq!(lines.len(), 2);
    }
}
