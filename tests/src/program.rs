//! Running the program: what it prints, and that it succeeds or refuses.

use crate::manylight;
use std::path::Path;
use std::process::{Command, Output};

/// Runs a command to its end.
///
/// # Panics
/// Where the program does not start.
pub fn output(command: &mut Command) -> Output {
    command.output().expect("the program starts")
}

/// What the program printed, as text.
pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// What a command printed to standard error.
pub fn stderr(output: &Output) -> String {
    text(&output.stderr)
}

/// Runs a command that must succeed.
///
/// # Panics
/// Where it does not.
pub fn succeed(command: &mut Command) -> Output {
    let output = output(command);
    assert!(output.status.success(), "{command:?}: {}", stderr(&output));
    output
}

/// Runs a command that must succeed, and gives what it printed to standard output.
///
/// # Panics
/// Where it does not succeed.
pub fn printed(command: &mut Command) -> String {
    text(&succeed(command).stdout)
}

/// Runs a command that must refuse its input, and gives the one line on standard error.
///
/// # Panics
/// Where it does not end with exit code 2, or says more or less than one line that begins with `error: `.
pub fn refused(command: &mut Command) -> String {
    let message = refused_with(command, 2);
    assert!(message.starts_with("error: "), "{command:?}: {message}");
    message
}

/// Runs a command that must end with an exit code, and gives the one line on standard error.
///
/// # Panics
/// Where it ends otherwise, or says more or less than one line.
pub fn refused_with(command: &mut Command, code: i32) -> String {
    let output = output(command);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{command:?}: {message}");
    assert_eq!(message.lines().count(), 1, "{command:?}: {message}");
    message
}

/// The text of a file.
///
/// # Panics
/// Where it cannot be read; the message names the file.
pub fn read(path: impl AsRef<Path>) -> String {
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.as_ref().display()))
}

/// A replay into `out` that is small enough for a test, under rain.
pub fn small(out: &Path) -> Command {
    let mut command = small_unlit(out);
    command.args(["--lights", "200"]);
    command
}

/// A replay into `out` that is small enough for a test, before it is said where light comes from.
pub fn small_unlit(out: &Path) -> Command {
    let mut command = manylight();
    command.args(["replay", "--quiet", "--resolution", "64x40", "--frames", "300..381/80", "--runs", "1"]);
    command.args(["--method", "indi-persp-64", "--method", "encl-ortho-4"]);
    command.arg("--out").arg(out);
    command
}
