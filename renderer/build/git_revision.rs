//! Tells the program which revision of its sources it was built from, for the manifest of every run.

use std::path::Path;
use std::process::Command;

/// Sets `MANYLIGHT_GIT_REVISION` for the crate; `unknown` outside a repository.
pub fn run() {
    // HEAD changes on a checkout, its log on every commit; in a linked worktree both lie elsewhere.
    for name in ["HEAD", "logs/HEAD"] {
        if let Some(path) = git(&["rev-parse", "--git-path", name])
            && Path::new(&path).exists()
        {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    let revision = git(&["rev-parse", "HEAD"]).unwrap_or_else(|| "unknown".into());
    println!("cargo::rustc-env=MANYLIGHT_GIT_REVISION={revision}");
}

/// The output of a git command, `None` outside a repository or without git.
fn git(args: &[&str]) -> Option<String> {
    let output = Command::new("git").args(args).output().ok().filter(|output| output.status.success())?;
    let text = String::from_utf8(output.stdout).ok()?;
    Some(text.trim().to_owned()).filter(|text| !text.is_empty())
}
