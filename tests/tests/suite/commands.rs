//! Every command but a replay as its users meet it.

use manylight_tests::manylight;
use manylight_tests::program::{output, read, refused, small, stderr, succeed};
use std::fs;
use std::path::Path;

#[test]
fn devices_and_scenes_are_described() {
    let devices = succeed(manylight().args(["devices", "--json"]));
    let devices: serde_json::Value = serde_json::from_slice(&devices.stdout).unwrap();
    assert!(!devices.as_array().unwrap().is_empty(), "{devices}");
    for (name, least, most) in [("street", 40_000, 60_000), ("hall", 240_000, 260_000)] {
        let scene = succeed(manylight().args(["scene", name, "--json"]));
        let scene: serde_json::Value = serde_json::from_slice(&scene.stdout).unwrap();
        assert_eq!(scene["name"], name);
        let triangles = scene["triangles"].as_u64().unwrap();
        assert!((least..most).contains(&triangles), "{name}: {triangles} triangles");
    }
}

#[test]
fn recordings_are_imported_and_baked_and_flown() {
    let directory = tempfile::tempdir().unwrap();
    let imported = directory.path().join("imported.json");
    let source = manylight_tests::data("replay_bistro.bin");
    succeed(manylight().arg("import-recording").arg(source).args(["--hmd", "vive", "--out"]).arg(&imported));
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("../recordings/bistro-vive.json");
    assert_eq!(read(&imported), read(bundled));
    let mirrored = |plane| {
        let mut command = manylight();
        command
            .arg("import-recording")
            .arg(manylight_tests::data("replay_bistro.bin"))
            .arg("--out")
            .arg(&imported);
        command.args(["--hmd", "vive", "--mirror", plane]);
        command
    };
    succeed(&mut mirrored("0,2,0,0.04"));
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("../recordings/bistro-mirror.json");
    assert_eq!(read(&imported), read(bundled));
    assert!(refused(&mut mirrored("0,0,0,1")).contains("has no direction"));
    assert!(refused(&mut mirrored("0,-1,0")).contains("no plane NX,NY,NZ,D"));

    let waypoints = directory.path().join("waypoints.json");
    fs::write(
        &waypoints,
        r#"{"format": "manylight.waypoints/1", "dt_s": 0.05, "near": 0.4, "far": 100, "fov": 1.2, "waypoints": [
            {"position": [0, 20, 0], "target": [10, 0, 10], "time_s": 0},
            {"position": [5, 22, 0], "target": [10, 0, 10], "time_s": 0.5}]}"#,
    )
    .unwrap();
    let baked = directory.path().join("baked.json");
    succeed(manylight().arg("bake-recording").arg(&waypoints).arg("--out").arg(&baked));
    let out = directory.path().join("out");
    succeed(small(&out).args(["--frames", "0..2", "--recording"]).arg(&baked));
}

#[test]
fn completions_are_written_for_a_shell() {
    let script = succeed(manylight().args(["completions", "bash"]));
    assert!(String::from_utf8_lossy(&script.stdout).contains("--displaced-volume"));
}

#[test]
fn results_are_compared_and_a_difference_is_an_exit_code() {
    let root = tempfile::tempdir().unwrap();
    let out = |name: &str| root.path().join(name);
    let compare = |a: &str, b: &str| output(manylight().arg("compare").args([out(a), out(b)]));
    succeed(small(&out("a")).args(["--runs", "2"]));
    succeed(&mut small(&out("b")));
    succeed(small(&out("fewer")).args(["--frames", "300", "--runs", "0"]));
    let same = compare("a", "b");
    assert_eq!(same.status.code(), Some(0), "{}", String::from_utf8_lossy(&same.stdout));
    let differs = compare("a", "fewer");
    assert_eq!(differs.status.code(), Some(1));
    assert_eq!(stderr(&differs).lines().count(), 1, "{}", stderr(&differs));
    assert!(String::from_utf8_lossy(&differs.stdout).contains("missing in B: frames 380"));
    let json = output(manylight().args(["compare", "--json"]).args([out("a"), out("a")]));
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_ne!(json["runs"][0]["times"][0]["verdict"], "slower");
    let page = out("page.html");
    let mut markdown = manylight();
    markdown.args(["compare", "--markdown", "--fail-slower", "5", "--html"]);
    let markdown = succeed(markdown.arg(&page).args([out("a"), out("a"), out("a")]));
    assert!(String::from_utf8_lossy(&markdown.stdout).starts_with("### manylight compare: 0 slower, "));
    assert!(read(page).contains("manylight compare"));
    assert!(refused(manylight().args(["compare", "a", "b", "--threshold=-1"])).contains("percentage"));
    assert!(refused(manylight().arg("compare").args([out("a"), out("nowhere")])).contains("nowhere"));
}

#[test]
fn a_still_is_written_as_png_and_exr() {
    let out = tempfile::tempdir().unwrap();
    let still = |args: &[&str]| {
        let mut command = manylight();
        command.args(["still", "--quiet", "--resolution", "64x40", "--frame", "300", "--lights", "100"]);
        command.args(["--method", "encl-ortho-4", "--out"]).arg(out.path()).args(args);
        command
    };
    let written = succeed(&mut still(&["--view", "birdseye", "--show", "clusters,frusta", "--validate"]));
    assert!(String::from_utf8_lossy(&written.stdout).contains("visible clusters"));
    for extension in ["png", "exr"] {
        assert!(out.path().join(format!("000300_encl-ortho-4_birdseye.{extension}")).is_file());
    }
    succeed(&mut still(&["--eye", "-9,1.8,9", "--target", "-4,3,-8", "--fov", "1.4", "--validate"]));
    assert!(out.path().join("000300_encl-ortho-4_eye.png").is_file());
    let written = succeed(&mut still(&["--show", "used-clusters,light-clusters", "--light", "7"]));
    assert!(String::from_utf8_lossy(&written.stdout).contains("light 7: a point at ("));
    for (args, expected) in [
        (&["--runs", "2"][..], "--runs"),
        (&["--view", "above"], "birdseye"),
        (&["--show", "light-clusters"], "--light N"),
        (&["--show", "light-clusters", "--light", "100"], "there is no light 100"),
        (&["--light", "7"], "--show light-clusters"),
        (&["--show", "clusters,light-count"], "exclude each other"),
        (&["--show", "gbuffer"], "--pipeline deferred"),
        (&["--pipeline", "deferred", "--msaa", "4", "--marking", "geometry"], "no sample need lie"),
        (&["--method", "indi-persp-64"], "once"),
        (&["--frame", "9000"], "reach beyond"),
        (&["--eye", "1,2,3"], "--target"),
        (&["--target", "1,2,3"], "--eye"),
        (&["--fov", "1"], "--eye"),
        (&["--eye", "1,2", "--target", "0,0,0"], "no place X,Y,Z"),
        (&["--eye", "-1,2,-3", "--target", "-1,2,-3"], "target: it is where the eye is"),
        (&["--eye", "1,inf,3", "--target", "0,0,0"], "eye: 1,inf,3 is not within"),
        (&["--eye", "1,2,3", "--target", "0,0,0", "--fov", "-1"], "radians"),
        (&["--eye", "1,2,3", "--target", "0,0,0", "--view", "mono"], "cannot be used with"),
    ] {
        let message = refused(&mut still(args));
        assert!(message.contains(expected), "{message}");
    }
}
