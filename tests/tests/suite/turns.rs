//! Temporal runs in turn and one after the other: what is written, what failing and stopping leave.

use manylight_tests::{copy_shaders, manylight};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const RUNS: [&str; 4] = ["indi-ortho-16_50", "encl-persp-32_50", "indi-ortho-16_90", "encl-persp-32_90"];

/// Two methods under two lightings in two frames.
fn small(out: &Path) -> Command {
    let mut command = manylight();
    command.args([
        "replay",
        "--resolution",
        "48x32",
        "--frames",
        "300..381/80",
        "--lights",
        "50",
        "--lights",
        "90",
    ]);
    command.args(["--method", "indi-ortho-16", "--method", "encl-persp-32", "--out"]).arg(out);
    command
}

fn output(command: &mut Command) -> Output {
    command.output().expect("the program starts")
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn succeed(command: &mut Command) -> String {
    let output = output(command);
    assert!(output.status.success(), "{}", stderr(&output));
    stderr(&output)
}

fn read(path: impl AsRef<Path>) -> String {
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.as_ref().display()))
}

fn manifest(run: &Path) -> Value {
    serde_json::from_str(&read(run.join("run.json"))).unwrap()
}

/// The numbers of the temporal runs in a run's table of times.
fn numbers(run: &Path) -> BTreeSet<u64> {
    let table = read(run.join("timings.csv"));
    table.lines().skip(1).map(|line| line.split(',').next().unwrap().parse().unwrap()).collect()
}

fn names_in(out: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(out).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn both_orders_count_alike_and_write_everything() {
    let [turns, sequence] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    succeed(small(turns.path()).args(["--runs", "2", "--trace"]));
    succeed(small(sequence.path()).args(["--runs", "2", "--trace", "--order", "sequential"]));
    for name in RUNS {
        let [a, b] = [&turns, &sequence].map(|out| out.path().join(name));
        assert_eq!(names_in(&a), names_in(&b));
        for table in ["clusterings.csv", "histograms.csv"] {
            assert_eq!(read(a.join(table)), read(b.join(table)), "{name} {table}");
        }
        let counts = |run: &Path| -> Vec<String> {
            let table = read(run.join("frames.csv"));
            let columns = table.split(',').position(|column| column == "gpu_ms_frame").unwrap();
            let of = |line: &str| line.split(',').take(columns).collect::<Vec<_>>().join(",");
            table.lines().map(of).collect()
        };
        assert_eq!(counts(&a), counts(&b), "{name}");
        assert!(counts(&a)[0].contains("lighting_computations"), "{}", counts(&a)[0]);
        assert_eq!((numbers(&a), numbers(&b)), (BTreeSet::from([0, 1]), BTreeSet::from([0, 1])));
        let [of_a, of_b] = [&a, &b].map(|run| manifest(run)["timing"].clone());
        assert_eq!((&of_a["order"], &of_b["order"]), (&"interleaved".into(), &"sequential".into()));
        assert_eq!((&of_a["group"], &of_b["group"]), (&RUNS.as_slice().into(), &[name].as_slice().into()));
        assert_eq!((&of_a["runs"], of_a.get("reached")), (&2.into(), None));
    }
    let row = |out: &Path| read(out.join("summary.csv")).lines().count();
    assert_eq!((row(turns.path()), row(sequence.path())), (5, 5));
}

#[test]
fn what_is_complete_is_not_timed_with_the_rest() {
    let out = tempfile::tempdir().unwrap();
    succeed(small(out.path()).args(["--runs", "1", "--only", RUNS[1]]));
    let first = read(out.path().join(RUNS[1]).join("run.json"));
    succeed(small(out.path()).args(["--runs", "1"]));
    assert_eq!(read(out.path().join(RUNS[1]).join("run.json")), first);
    let timing = &manifest(&out.path().join(RUNS[3]))["timing"];
    assert_eq!(timing["group"], serde_json::json!([RUNS[0], RUNS[2], RUNS[3]]));
}

/// Replaces a text in a file that has it.
fn replace(path: &Path, from: &str, to: &str) {
    let text = read(path);
    assert!(text.contains(from), "{} lacks {from}", path.display());
    fs::write(path, text.replace(from, to)).unwrap();
}

#[test]
fn methods_that_fail_when_counted_and_when_timed_leave_the_others() {
    let directory = tempfile::tempdir().unwrap();
    let (shaders, out) = (directory.path().join("shaders"), directory.path().join("out"));
    copy_shaders(&shaders);
    // No fragment of all-lights finds its lights, and lists of boxes are longer than any device holds once nothing is counted.
    replace(&shaders.join("lookup/all_lights.glsl"), "return true;", "return false;");
    let lists = "new_state.index_total = total;";
    let too_long =
        "#if !COUNTERS && SPACE == SPACE_ORTHOGRAPHIC\nnew_state.index_total = 0xFFFFFFFFu;\n#endif";
    replace(&shaders.join("lib/scan_items.glsl"), lists, &format!("{lists}\n{too_long}"));
    let mut command = small(&out);
    command.args(["--runs", "2", "--method", "all-lights", "--shaders"]).arg(&shaders);
    let output = output(&mut command);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("4 of 6 runs failed"), "{}", stderr(&output));
    for (lights, name) in [("50", RUNS[1]), ("90", RUNS[3])] {
        assert_eq!(numbers(&out.join(name)), BTreeSet::from([0, 1]), "{name}");
        let error = |method: &str| read(out.join(format!("{method}_{lights}.error.json")));
        assert!(error("all-lights").contains("no visible cluster"), "{}", error("all-lights"));
        assert!(error("indi-ortho-16").contains("buffer light_indices"), "{}", error("indi-ortho-16"));
    }
    let left = [RUNS[1], "encl-persp-32_90", "summary.csv"];
    assert_eq!(names_in(&out).iter().filter(|name| !name.ends_with(".error.json")).collect::<Vec<_>>(), left);
}

/// Stops a replay of many frames when a file is there; its exit code and what it said.
#[cfg(unix)]
fn stopped_at(mut command: Command, file: &Path) -> (Option<i32>, String) {
    let mut child = command.stderr(std::process::Stdio::piped()).spawn().unwrap();
    while !file.exists() {
        assert!(child.try_wait().unwrap().is_none(), "the replay ended before it was stopped");
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    (output.status.code(), stderr(&output))
}

#[test]
#[cfg(unix)]
fn an_interruption_in_the_last_turn_keeps_what_is_whole() {
    let out = tempfile::tempdir().unwrap();
    let mut command = manylight();
    command.args([
        "replay",
        "--resolution",
        "64x40",
        "--frames",
        "0..60",
        "--runs",
        "3",
        "--lights",
        "200",
        "--out",
    ]);
    command.arg(out.path()).args([
        "--method",
        "indi-ortho-8",
        "--method",
        "encl-ortho-8",
        "--method",
        "indi-ortho-9",
    ]);
    let (code, told) = stopped_at(command, &out.path().join("indi-ortho-8/run.json"));
    assert!(code == Some(130) && told.contains("(1 of 3)"), "{code:?} {told}");
    assert_eq!(names_in(out.path()), ["indi-ortho-8", "summary.csv"]);
    assert_eq!(numbers(&out.path().join("indi-ortho-8")).len(), 3);
}

#[test]
fn as_many_runs_are_made_as_precision_asks_for_and_both_are_told() {
    let out = tempfile::tempdir().unwrap();
    let auto = |precision: &str, most: &str| {
        let mut command = small(out.path());
        command.args(["--force", "--runs", "auto", "--precision", precision, "--max-runs", most]);
        succeed(&mut command)
    };
    // So much that any noise fits in: the fewest runs are enough.
    let told = auto("1e9", "12");
    assert!(told.contains("5 temporal runs of each of 4 runs: all within 1000000000 %"), "{told}");
    for name in RUNS {
        let (run, base) = (out.path().join(name), name.replace("encl-persp-32", "indi-ortho-16"));
        let timing = &manifest(&run)["timing"];
        assert_eq!((&timing["runs"], numbers(&run).len()), (&5.into(), 5));
        let reached = &timing["reached"];
        assert_eq!((&reached["precise"], &reached["base"]), (&true.into(), &Value::from(base)));
        assert!(reached["mean_percent"].as_f64().is_some() && reached["ratio_percent"].as_f64().is_some());
    }
    // So little that none does.
    let told = auto("1e-9", "3");
    assert!(told.contains("3 temporal runs of each of 4 runs: 0 within 0.000000001 %"), "{told}");
    let run = out.path().join(RUNS[1]);
    assert_eq!((&manifest(&run)["timing"]["reached"]["precise"], numbers(&run).len()), (&false.into(), 3));
    // What was reached is what there is: the run is complete, and its tables are checked against that.
    let skipped = {
        let mut command = small(out.path());
        command.args(["--runs", "auto", "--precision", "1e-9", "--max-runs", "3"]);
        succeed(&mut command)
    };
    assert!(skipped.contains("4 of 4 runs were complete and unchanged"), "{skipped}");
}

#[test]
fn precisions_and_orders_that_make_no_sense_are_refused() {
    let out = tempfile::tempdir().unwrap();
    for (flags, named) in [
        (["--runs", "often"], "neither a whole number nor `auto`"),
        (["--precision", "0"], "precision: 0 percent"),
        (["--max-runs", "1"], "max_runs: 1"),
    ] {
        let output = output(small(&out.path().join("out")).args(flags));
        assert_eq!(output.status.code(), Some(2), "{flags:?}");
        assert!(stderr(&output).contains(named), "{flags:?}: {}", stderr(&output));
    }
}
