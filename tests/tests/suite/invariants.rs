//! What must never happen fails the run where it happens: here, shaders that mark too little.

use manylight_tests::{copy_shaders, manylight};
use std::fs;

#[test]
fn a_run_whose_fragments_lack_their_cluster_fails() {
    let directory = tempfile::tempdir().unwrap();
    let shaders = directory.path().join("shaders");
    copy_shaders(&shaders);
    let marking = shaders.join("cluster/mark_depth.comp");
    let text = fs::read_to_string(&marking).unwrap();
    assert!(text.contains("if (depth > 0.0)"));
    fs::write(&marking, text.replace("if (depth > 0.0)", "if (depth > 0.0 && pixel.x >= 16u)")).unwrap();

    let out = directory.path().join("out");
    let mut command = manylight();
    command.args([
        "replay",
        "--recording",
        "bistro",
        "--frames",
        "300",
        "--runs",
        "0",
        "--resolution",
        "32x18",
    ]);
    command.args(["--method", "all-lights", "--method", "indi-persp-16", "--lights", "100"]);
    let output = command.arg("--shaders").arg(&shaders).arg("--out").arg(&out).output().unwrap();

    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains(" shaded fragments found no visible cluster, which must never happen"), "{said}");
    assert!(said.contains("frame 300: "), "{said}");
    assert!(
        fs::read_to_string(out.join("indi-persp-16.error.json"))
            .unwrap()
            .contains("found no visible cluster")
    );
    assert!(!out.join("indi-persp-16").exists(), "a run that is wrong is not kept");
    assert!(out.join("all-lights/run.json").exists(), "a run without clusters is right");
}
