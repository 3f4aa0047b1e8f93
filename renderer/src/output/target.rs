//! Where an output's path leads: files, behind links too, and pipes; nothing else is written.

use super::atomic::{cannot_write, parent_of};
use crate::{Error, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// What an output's path stands for.
pub enum Target {
    /// A file there or to be, which is no link.
    File(PathBuf),
    /// A pipe, such as standard output may be by its name.
    Pipe,
}

/// What stands at `path`, or may.
///
/// # Errors
/// Something that a file cannot replace, or links that lead nowhere.
pub fn target(path: &Path) -> Result<Target> {
    let Ok(found) = fs::metadata(path) else { return followed(path).map(Target::File) };
    let kind = found.file_type();
    if kind.is_file() {
        return fs::canonicalize(path).map(Target::File).map_err(|error| cannot_write(path, &error));
    }
    if is_pipe(kind) {
        return Ok(Target::Pipe);
    }
    let what = if kind.is_dir() { "a directory" } else { "neither a file nor a pipe" };
    Err(Error::file(path, format!("is {what}: name a file to write")))
}

#[cfg(unix)]
fn is_pipe(kind: fs::FileType) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&kind)
}

#[cfg(not(unix))]
fn is_pipe(_: fs::FileType) -> bool {
    false
}

/// Where the links that begin at `path` lead; what is there need not exist.
pub fn followed(path: &Path) -> Result<PathBuf> {
    /// As many as Linux follows.
    const MOST_LINKS: usize = 40;
    let mut place = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(next) = fs::read_link(&place) else { return Ok(place) };
        place = parent_of(&place).join(next);
    }
    Err(Error::file(path, "cannot be written: its links lead in a circle"))
}

#[cfg(all(test, unix))]
mod tests {
    use super::super::atomic::{prepare_file, write_whole};
    use super::*;
    use std::io::Write;
    use std::os::unix::fs::symlink;

    #[test]
    fn links_stay_and_what_they_lead_to_is_written() {
        let dir = tempfile::tempdir().unwrap();
        let (near, far) = (dir.path().join("near"), dir.path().join("far"));
        fs::create_dir(&far).unwrap();
        fs::write(far.join("old.csv"), "old").unwrap();
        symlink("far/old.csv", &near).unwrap();
        symlink("near", dir.path().join("second")).unwrap();
        write_whole(&dir.path().join("second"), |file| file.write_all(b"new")).unwrap();
        assert_eq!(fs::read_to_string(far.join("old.csv")).unwrap(), "new");
        assert_eq!(fs::read_link(&near).unwrap(), Path::new("far/old.csv"));
        // A link to what is not there yet.
        fs::remove_file(far.join("old.csv")).unwrap();
        write_whole(&near, |file| file.write_all(b"again")).unwrap();
        assert_eq!(fs::read_to_string(far.join("old.csv")).unwrap(), "again");
        assert_eq!(fs::read_dir(&far).unwrap().count(), 1, "nothing temporary stays");

        let circle = dir.path().join("circle");
        symlink("circle", &circle).unwrap();
        let error = write_whole(&circle, |_| Ok(())).unwrap_err().to_string();
        assert!(error.contains("in a circle"), "{error}");
    }

    #[test]
    fn what_is_no_file_is_refused_and_stays() {
        let dir = tempfile::tempdir().unwrap();
        // To the file system a socket is what a device is, and nobody misses it where this fails.
        let socket = dir.path().join("socket");
        let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        for (path, what) in [(socket.as_path(), "neither a file nor a pipe"), (dir.path(), "a directory")] {
            for error in [write_whole(path, |_| Ok(())).unwrap_err(), prepare_file(path).unwrap_err()] {
                assert_eq!(error.to_string(), format!("{}: is {what}: name a file to write", path.display()));
                assert_eq!(error.exit_code(), 2);
            }
        }
        assert!(!fs::metadata(&socket).unwrap().is_file());
    }
}
