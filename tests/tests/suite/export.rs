//! `manylight export`: results as one table.

use csv::ReaderBuilder;
use manylight_tests::manylight;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Output;

/// A row's cells by column.
type Cells = BTreeMap<String, String>;

/// Replays two frames by two methods under two lightings with two tests, twice timed.
fn replay(out: &Path) {
    let mut command = manylight();
    command.args(["replay", "--quiet", "--resolution", "64x36", "--frames", "300..381/80", "--runs", "2"]);
    command.args(["--method", "encl-ortho-4", "--method", "all-lights", "--lights", "50", "--lights", "60"]);
    command.args(["--test", "box,exact", "--out"]).arg(out);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn export(arguments: &[&str], directories: &[&Path], out: &Path) -> Output {
    manylight().arg("export").args(arguments).args(directories).arg("--out").arg(out).output().unwrap()
}

fn rows(table: &Path) -> Vec<Cells> {
    let mut reader = ReaderBuilder::new().from_path(table).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

fn refused(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(message.trim_end().lines().count(), 1, "{message}");
    message
}

#[test]
fn the_table_holds_what_was_measured_with_all_that_tells_rows_apart() {
    let dir = tempfile::tempdir().unwrap();
    let (results, table) = (dir.path().join("out"), dir.path().join("tables/all.csv"));
    replay(&results);
    let output = export(&[], &[&results], &table);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed = format!("6 runs, 12 rows\n{}\n", table.display());
    assert_eq!(String::from_utf8_lossy(&output.stdout), printed);

    let found = rows(&table);
    let of = |lighting: &str, method: &str, test: &str| -> Vec<&Cells> {
        let asked = [("lighting", lighting), ("method", method), ("test", test)];
        found.iter().filter(|row| asked.iter().all(|(column, value)| row[*column] == *value)).collect()
    };
    for (lighting, method, test) in
        [("50", "encl-ortho-4", "box"), ("60", "encl-ortho-4", "exact"), ("60", "all-lights", "")]
    {
        let rows_of_run = of(lighting, method, test);
        let measured = rows(&Path::new(&rows_of_run[0]["directory"]).join("frames.csv"));
        assert_eq!(rows_of_run.len(), measured.len());
        for (row, measured) in rows_of_run.into_iter().zip(measured) {
            assert!(measured.iter().all(|(column, cell)| row[column] == *cell), "{row:?}");
            let same = [
                ("scene", "street"),
                ("recording", "bistro-vive"),
                ("width", "64"),
                ("height", "36"),
                ("msaa", "1"),
            ];
            assert!(same.iter().all(|(column, value)| row[*column] == *value), "{row:?}");
            assert!(!row["device"].is_empty() && row["intensity"] == "100");
            let run = fs::read(Path::new(&row["directory"]).join("run.json")).unwrap();
            let run: serde_json::Value = serde_json::from_slice(&run).unwrap();
            let doubts = run["doubts"].as_array().unwrap().iter().map(|doubt| doubt.as_str().unwrap());
            assert_eq!(row["doubts"], doubts.collect::<Vec<_>>().join("; "));
            assert_eq!(row["cpu"], run["machine"]["host"]["cpu"].as_str().unwrap_or_default());
            assert_eq!(row["clusters_axis"], if method == "all-lights" { "" } else { "visible" });
        }
    }

    let output = export(&["--stages", "--json"], &[&results], &table);
    let printed: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let stages = rows(&table);
    assert_eq!(printed["rows"], stages.len());
    let first = Path::new(&stages[0]["directory"]).to_owned();
    let of_first = stages.iter().filter(|row| Path::new(&row["directory"]) == first);
    for (row, measured) in of_first.zip(rows(&first.join("timings.csv"))) {
        assert!(measured.iter().all(|(column, cell)| row[column] == *cell), "{row:?}");
        let counted = found
            .iter()
            .find(|frame| frame["directory"] == row["directory"] && frame["frame"] == row["frame"]);
        assert_eq!(row["light_indices"], counted.unwrap()["light_indices"]);
        assert!(!row["stage_kind"].contains('['));
    }
}

#[test]
fn directories_may_lie_within_each_other_and_what_is_wrong_is_said_in_a_line() {
    let dir = tempfile::tempdir().unwrap();
    let (results, table) = (dir.path().join("out"), dir.path().join("all.csv"));
    replay(&results);
    let run = results.join("all-lights_50");
    assert!(export(&[], &[&run, &results], &table).status.success());
    let whole = rows(&table);
    assert_eq!(whole.len(), 12);

    let message = refused(&export(&[], &[&dir.path().join("nowhere")], &table));
    assert!(message.contains("there is no such directory"), "{message}");
    let message = refused(&export(&[], &[&results], dir.path()));
    assert!(message.contains("is a directory: name a file to write"), "{message}");
    let frames = run.join("frames.csv");
    let text = fs::read_to_string(&frames).unwrap();
    fs::write(&frames, text.replacen("\n300,", "\nx,", 1)).unwrap();
    let message = refused(&export(&[], &[&results], &table));
    assert!(message.contains("frames.csv: line 2: frame `x` is no whole number"), "{message}");
    assert_eq!(rows(&table), whole, "an earlier table stays");
}
