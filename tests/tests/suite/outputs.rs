//! Where results go and cannot go: full disks, readers that go away, links, pipes, paths that are no text, no driver.
#![cfg(unix)]

use manylight_tests::manylight;
use manylight_tests::program::{output, refused, refused_with, succeed, text};
use std::ffi::OsStr;
use std::fs::{self, File};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Stdio};

const WAYPOINTS: &str = r#"{"format": "manylight.waypoints/1", "dt_s": 0.05, "near": 0.4, "far": 100, "fov": 1.2,
    "waypoints": [{"position": [0, 20, 0], "target": [10, 0, 10], "time_s": 0},
        {"position": [5, 22, 0], "target": [10, 0, 10], "time_s": 0.1}]}"#;

fn command(arguments: &[&str]) -> Command {
    let mut command = manylight();
    command.args(arguments);
    command
}

/// A replay as small as can be.
fn replay(out: &Path, more: &[&str]) -> Command {
    let mut command = command(&["replay", "--resolution", "32x20", "--frames", "300", "--runs", "1"]);
    command.args(["--lights", "50", "--method", "indi-ortho-16", "--out"]).arg(out).args(more);
    command
}

/// A device that is always full.
fn full() -> Stdio {
    File::options().write(true).open("/dev/full").expect("Linux has it").into()
}

/// A pipe that nobody reads.
fn unread() -> Stdio {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    writer.into()
}

/// Every command that prints, on results in `out`.
fn printing(out: &Path) -> Vec<Command> {
    let out = out.to_str().unwrap();
    let frame = ["--resolution", "32x20", "--lights", "50", "--method", "indi-ortho-16"];
    let with_frame = |start: &[&str]| command(&[start, &frame[..]].concat());
    vec![
        command(&["--help"]),
        command(&["replay", "--help"]),
        command(&["--version"]),
        command(&["completions", "bash"]),
        command(&["devices"]),
        command(&["scene", "street"]),
        command(&["compare", out, out]),
        command(&["report", out]),
        replay(Path::new(out), &["--list-runs"]),
        replay(Path::new(out), &["--summarize"]),
        replay(Path::new(out), &[]),
        with_frame(&["still", "--frame", "300", "--out", out]),
        with_frame(&[
            "bench",
            "assign",
            "--frame",
            "300",
            "--repeats",
            "1",
            "--out",
            &format!("{out}/b.csv"),
        ]),
        with_frame(&["bench", "scopes", "--frames", "300", "--runs", "1"]),
    ]
}

#[test]
fn what_cannot_be_printed_is_an_error() {
    let out = tempfile::tempdir().unwrap();
    succeed(&mut replay(out.path(), &[]));
    for mut command in printing(out.path()) {
        let message = refused(command.arg("--quiet").stdout(full()));
        let expected = "error: standard output: cannot be written: No space left on device\n";
        assert_eq!(message, expected, "{command:?}");
    }
    for mut command in printing(out.path()) {
        let message = refused_with(command.arg("--json").stdout(full()), 2);
        let message: serde_json::Value = serde_json::from_str(&message).unwrap();
        assert_eq!(message["error"]["exit_code"], 2, "{command:?}");
    }
}

#[test]
fn a_reader_that_goes_away_ends_a_command_quietly_with_a_code_of_its_own() {
    let out = tempfile::tempdir().unwrap();
    succeed(&mut replay(out.path(), &[]));
    for mut command in printing(out.path()) {
        let output = output(command.arg("--quiet").stdout(unread()));
        assert_eq!(output.status.code(), Some(141), "{command:?}");
        assert_eq!(text(&output.stderr), "", "{command:?}");
    }
    // What is wrong is more than that nobody read it.
    let other = tempfile::tempdir().unwrap();
    succeed(&mut replay(other.path(), &["--lights", "60"]));
    let output = output(command(&["compare"]).args([out.path(), other.path()]).stdout(unread()));
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("the results differ"));
}

#[test]
fn an_unwritable_standard_error_changes_nothing() {
    let out = tempfile::tempdir().unwrap();
    let warned = out.path().join("warned.obj");
    fs::write(&warned, "mtllib missing.mtl\nusemtl stone\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    assert!(text(&succeed(command(&["scene"]).arg(&warned)).stderr).contains("WARN"));
    for (code, arguments) in [
        (0, vec!["scene", warned.to_str().unwrap()]),
        (2, vec!["scene", "nowhere.obj"]),
        (2, vec!["replay", "--mssa", "4"]),
        (2, vec![]),
    ] {
        let (silent, heard) =
            (output(command(&arguments).stderr(full())), output(command(&arguments).stderr(Stdio::null())));
        assert_eq!(silent.status.code(), Some(code), "{arguments:?}");
        assert_eq!((silent.status, silent.stdout), (heard.status, heard.stdout), "{arguments:?}");
    }
    // Notes: of a picture that fits no eye, of results, of runs that are there.
    for _ in 0..2 {
        assert!(output(replay(out.path(), &["--exr", "all"]).stderr(full())).status.success());
    }
    assert_eq!(output(command(&["devices"]).stdout(full()).stderr(full())).status.code(), Some(2));
}

#[test]
fn files_are_written_through_links_and_into_pipes() {
    let directory = tempfile::tempdir().unwrap();
    let [way, real, link, pipe] =
        ["way.json", "real.json", "link.json", "pipe"].map(|name| directory.path().join(name));
    fs::write(&way, WAYPOINTS).unwrap();
    symlink("real.json", &link).unwrap();
    let bake = |out: &Path| {
        let mut bake = command(&["bake-recording", "--quiet"]);
        bake.arg(&way).arg("--out").arg(out);
        bake
    };
    succeed(&mut bake(&link));
    assert_eq!(fs::read_link(&link).unwrap(), Path::new("real.json"));
    let baked = fs::read(&real).unwrap();
    assert!(baked.starts_with(b"{"));

    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let mut writer = bake(&pipe).spawn().unwrap();
    assert_eq!(fs::read(&pipe).unwrap(), baked);
    assert!(writer.wait().unwrap().success());
    assert_eq!(succeed(&mut bake(Path::new("/dev/stdout"))).stdout, baked);
}

#[test]
fn what_no_file_can_replace_is_refused_before_anything_is_measured() {
    let directory = tempfile::tempdir().unwrap();
    let [way, socket] = ["way.json", "socket"].map(|name| directory.path().join(name));
    fs::write(&way, WAYPOINTS).unwrap();
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    let recording = manylight_tests::data("replay_bistro.bin");
    for out in [socket.as_path(), directory.path()] {
        let commands = [
            command(&["bake-recording", way.to_str().unwrap()]),
            command(&["import-recording", recording.to_str().unwrap()]),
            // Longer than any test: it must not begin.
            command(&["bench", "assign", "--repeats", "100000", "--quiet"]),
        ];
        for mut command in commands {
            let message = refused(command.arg("--out").arg(out));
            assert!(message.contains(out.to_str().unwrap()) && message.contains("name a file"), "{message}");
        }
    }
    assert!(!fs::metadata(&socket).unwrap().is_file());
}

#[test]
fn a_path_that_is_no_text_is_named_or_works() {
    let odd = OsStr::from_bytes(b"l\xe9");
    for flag in ["--out", "--lights-file", "--shaders", "--scene", "--recording", "--device"] {
        for json in [false, true] {
            let mut command = command(&["replay", "--frames", "300", "--runs", "0"]);
            command.args(json.then_some("--json")).arg(flag).arg(odd);
            let message = refused_with(&mut command, 2);
            assert!(message.contains("xE9") && message.contains("UTF-8"), "{flag}: {message}");
        }
    }
    let directory = tempfile::tempdir().unwrap();
    let results = directory.path().join(odd);
    succeed(&mut replay(&directory.path().join("plain"), &[]));
    fs::rename(directory.path().join("plain"), &results).unwrap();
    succeed(command(&["report", "--json"]).arg(&results));
    succeed(command(&["compare", "--json"]).args([&results, &results]));
    assert!(results.join("report/index.html").is_file());
}

#[test]
fn without_a_driver_or_a_device_it_is_said_what_to_install() {
    let refused = refused(command(&["devices"]).env("VK_DRIVER_FILES", "/nonexistent"));
    assert!(refused.contains("apt install mesa-vulkan-drivers"), "{refused}");
    // Drivers of devices that this machine may lack.
    let Ok(drivers) = fs::read_dir("/usr/share/vulkan/icd.d") else { return };
    for driver in drivers.map(|entry| entry.unwrap().path()) {
        let mut command = command(&["devices", "--quiet"]);
        let output = output(command.env_remove("VK_DRIVER_FILES").env("VK_ICD_FILENAMES", &driver));
        match output.status.code() {
            Some(0) => {}
            code => {
                assert_eq!(code, Some(2), "{}: {}", driver.display(), text(&output.stderr));
                assert!(
                    text(&output.stderr).contains("apt install mesa-vulkan-drivers"),
                    "{}",
                    driver.display()
                );
            }
        }
    }
}
