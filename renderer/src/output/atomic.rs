//! Whole or not at all: files and directories appear under their names only when complete.

use super::target::{Target, followed, target};
use crate::{Error, Result};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Writes a file under a temporary name beside `path`, then renames it over `path`. Missing parent directories
/// are made, links are followed, and a pipe is written as it is.
///
/// # Errors
/// The directory or the file cannot be written; nothing of it is left then. What stands at `path` is a directory or a
/// device, which a file would replace.
pub fn write_whole(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<()> {
    let written = match target(path)? {
        Target::Pipe => write_pipe(path, write),
        Target::File(file) => {
            let parent = parent_of(&file);
            make_directory(parent)?;
            replace_file(&file, parent, write)
        }
    };
    written.map_err(|error| cannot_write(path, &error))
}

/// Tries where a file will be written, so that an hour's work does not end at a wall.
///
/// # Errors
/// As [`write_whole`].
pub fn prepare_file(path: &Path) -> Result<()> {
    match target(path)? {
        Target::Pipe => Ok(()),
        Target::File(file) => prepare_output(parent_of(&file)),
    }
}

/// Makes a directory and tries it, so that a run of an hour does not end at a wall.
///
/// # Errors
/// The directory cannot be made or written to.
pub fn prepare_output(out: &Path) -> Result<()> {
    make_directory(out)?;
    tempfile::tempfile_in(out)
        .and_then(|mut file| file.write_all(b"manylight").and_then(|()| file.sync_all()))
        .map_err(|error| cannot_write(out, &error))
}

/// Writes what cannot be written beside and renamed.
fn write_pipe(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::new(File::options().write(true).open(path)?);
    write(&mut writer)?;
    writer.flush()
}

fn replace_file(
    path: &Path,
    parent: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let temporary = locked(|| {
        let temporary = builder(PREFIX, 0o666).tempfile_in(parent)?;
        let lock = temporary.as_file().try_clone()?;
        Ok((temporary, lock))
    })?;
    let (temporary, _lock) = temporary;
    fill(temporary.as_file().try_clone()?, write)?;
    temporary.persist(path).map(drop).map_err(|error| error.error)
}

/// Writes and flushes: a full disk shows here.
fn fill(file: File, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::new(file);
    write(&mut writer)?;
    writer.flush()?;
    writer.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()
}

/// Makes a directory and its parents.
pub(super) fn make_directory(path: &Path) -> Result<()> {
    fs::create_dir_all(path)
        .map_err(|error| Error::file(path, format!("the directory cannot be made: {}", cause(&error))))
}

/// A directory that is filled beside its final place and put there when whole.
#[derive(Debug)]
pub(super) struct StagedDirectory {
    target: PathBuf,
    staged: TempDir,
    /// Tells the living from the abandoned: see [`remove_abandoned`].
    _lock: Option<File>,
}

impl StagedDirectory {
    /// Stages `target`; its parents are made. `marker` is a file by which an older result is known: a directory
    /// at `target` that is neither empty nor holds it is somebody else's, and is refused.
    pub fn create(target: &Path, marker: &str) -> Result<Self> {
        let target = &followed(target)?;
        let parent = parent_of(target);
        make_directory(parent)?;
        if let Ok(entries) = fs::read_dir(target) {
            if entries.count() > 0 && !target.join(marker).is_file() {
                return Err(Error::file(
                    target,
                    format!(
                        "exists without a {marker}, so it is no earlier result: move it, or choose another output directory"
                    ),
                ));
            }
        } else if fs::symlink_metadata(target).is_ok() {
            return Err(Error::file(
                target,
                "exists and is no directory: move it, or choose another output directory",
            ));
        }
        let (staged, lock) = directory_in(parent).map_err(|error| cannot_write(parent, &error))?;
        Ok(Self { target: target.to_owned(), staged, _lock: lock })
    }

    /// Where to write until [`Self::commit`].
    pub fn path(&self) -> &Path {
        self.staged.path()
    }

    /// An error about a file of the staged directory, by the name that the file was to have.
    pub fn told(&self, error: Error) -> Error {
        match error {
            Error::File { path, message } => {
                let path = path
                    .strip_prefix(self.path())
                    .map_or_else(|_| path.clone(), |below| self.target.join(below));
                Error::File { path, message }
            }
            other => other,
        }
    }

    /// Puts the directory in its place; an older one there is deleted only after that.
    pub fn commit(self) -> Result<()> {
        let Self { target, staged, _lock } = self;
        let swap = || -> io::Result<Option<(TempDir, Option<File>)>> {
            sync_directory(staged.path())?;
            if fs::symlink_metadata(&target).is_err() {
                fs::rename(staged.path(), &target)?;
                sync_directory(parent_of(&target))?;
                return Ok(None);
            }
            let old = directory_in(parent_of(&target))?;
            let parked = old.0.path().join("old");
            fs::rename(&target, &parked)?;
            fs::rename(staged.path(), &target).inspect_err(|_| {
                // Back to how it was; the first failure is the one to report.
                let _ = fs::rename(&parked, &target);
            })?;
            sync_directory(parent_of(&target))?;
            Ok(Some(old))
        };
        let old = swap().map_err(|error| cannot_write(&target, &error))?;
        // What was staged has moved: there is nothing left to clean up under its temporary name.
        let _ = staged.keep();
        drop(old);
        Ok(())
    }
}

/// Every temporary name begins so.
const PREFIX: &str = ".manylight-";
/// And ends so.
const SUFFIX: &str = ".tmp";

/// A temporary directory in `parent`, locked where the system can.
fn directory_in(parent: &Path) -> io::Result<(TempDir, Option<File>)> {
    let made = || builder(PREFIX, 0o777).tempdir_in(parent);
    // Elsewhere a directory cannot be opened, and what was abandoned stays.
    if !cfg!(unix) {
        return Ok((made()?, None));
    }
    let (directory, lock) = locked(|| {
        let directory = made()?;
        let lock = File::open(directory.path())?;
        Ok((directory, lock))
    })?;
    Ok((directory, Some(lock)))
}

/// Makes something temporary and takes its lock, again until it has both: between the two, [`remove_abandoned`] of
/// another process may have removed it.
fn locked<T: AsRef<Path>>(make: impl Fn() -> io::Result<(T, File)>) -> io::Result<(T, File)> {
    loop {
        let (made, lock) = make()?;
        // A file system without locks has no `remove_abandoned` either.
        let has_locks = lock.lock_shared().is_ok();
        if !has_locks || made.as_ref().exists() {
            return Ok((made, lock));
        }
    }
}

/// Removes what processes that were killed left in `directory`: everything under a temporary name whose lock nobody
/// holds. What living processes, other shards among them, are writing stays.
pub fn remove_abandoned(directory: &Path) {
    let Ok(entries) = fs::read_dir(directory) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        if !name.to_str().is_some_and(|name| name.starts_with(PREFIX) && name.ends_with(SUFFIX)) {
            continue;
        }
        let path = entry.path();
        let Ok(file) = File::open(&path) else { continue };
        if file.try_lock().is_ok() {
            // What cannot be removed is only in nobody's way.
            let _ = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
        }
    }
}

/// Makes the names in a directory outlast a power cut, where the system can.
fn sync_directory(path: &Path) -> io::Result<()> {
    if cfg!(unix) { File::open(path)?.sync_all() } else { Ok(()) }
}

/// An error that says which file cannot be written, and why.
pub(super) fn cannot_write(path: &Path, error: &io::Error) -> Error {
    Error::file(path, format!("cannot be written: {}", cause(error)))
}

/// The cause without the number the system has for it.
pub(crate) fn cause(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_owned()
}

pub(super) fn parent_of(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Temporary names for results, with the permissions that results have (`mode` less the user's mask).
fn builder(prefix: &str, mode: u32) -> tempfile::Builder<'_, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(prefix).suffix(SUFFIX);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(mode));
    #[cfg(not(unix))]
    let _ = mode;
    builder
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(path: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(path)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a/b.csv");
        write_whole(&path, |file| file.write_all(b"old")).unwrap();
        let error = write_whole(&path, |file| {
            file.write_all(b"half")?;
            Err(io::ErrorKind::StorageFull.into())
        })
        .unwrap_err();
        assert_eq!(error.to_string(), format!("{}: cannot be written: no storage space", path.display()));
        assert_eq!(error.exit_code(), 2);
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(path.parent().unwrap()), ["b.csv"]);
    }

    #[test]
    fn a_full_device_is_seen() {
        if !Path::new("/dev/full").exists() {
            return;
        }
        let full = File::options().write(true).open("/dev/full").unwrap();
        let error = fill(full, |file| file.write_all(b"x")).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        assert_eq!(cause(&error), "No space left on device");
    }

    #[cfg(unix)]
    #[test]
    fn a_run_behind_a_link_is_replaced_where_it_lies() {
        let dir = tempfile::tempdir().unwrap();
        let (link, far) = (dir.path().join("run"), dir.path().join("far"));
        fs::create_dir(&far).unwrap();
        fs::write(far.join("run.json"), "old").unwrap();
        std::os::unix::fs::symlink("far", &link).unwrap();
        let staged = StagedDirectory::create(&link, "run.json").unwrap();
        fs::write(staged.path().join("run.json"), "new").unwrap();
        staged.commit().unwrap();
        assert_eq!(fs::read_to_string(far.join("run.json")).unwrap(), "new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }

    #[test]
    fn a_path_under_a_file_is_refused_with_its_name() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("file");
        fs::write(&file, "").unwrap();
        let error = write_whole(&file.join("out/run.json"), |_| Ok(())).unwrap_err();
        let expected =
            format!("{}: the directory cannot be made: Not a directory", file.join("out").display());
        assert_eq!(error.to_string(), expected);
    }

    #[test]
    fn a_staged_directory_replaces_the_old_one_whole() {
        let dir = tempfile::tempdir().unwrap();
        let target = dir.path().join("run");
        for content in ["table1", "table2"] {
            let staged = StagedDirectory::create(&target, "run.json").unwrap();
            fs::write(staged.path().join("run.json"), content).unwrap();
            fs::write(staged.path().join(content), "").unwrap();
            staged.commit().unwrap();
            assert_eq!(names(&target), ["run.json", content]);
        }
        assert_eq!(fs::read_to_string(target.join("run.json")).unwrap(), "table2");
        assert_eq!(names(dir.path()), ["run"]);
    }

    #[test]
    fn an_abandoned_directory_leaves_nothing() {
        let dir = tempfile::tempdir().unwrap();
        let staged = StagedDirectory::create(&dir.path().join("run"), "run.json").unwrap();
        fs::write(staged.path().join("half"), "x").unwrap();
        drop(staged);
        assert!(names(dir.path()).is_empty());
    }

    #[test]
    fn foreign_directories_and_files_are_refused() {
        let dir = tempfile::tempdir().unwrap();
        let target = dir.path().join("run");
        fs::create_dir(&target).unwrap();
        fs::write(target.join("thesis.doc"), "").unwrap();
        let error = StagedDirectory::create(&target, "run.json").unwrap_err().to_string();
        assert!(error.contains("exists without a run.json"), "{error}");
        let error = StagedDirectory::create(&target.join("thesis.doc"), "run.json").unwrap_err().to_string();
        assert!(error.contains("is no directory"), "{error}");
        assert_eq!(names(dir.path()), ["run"]);
    }

    #[cfg(unix)]
    #[test]
    fn what_was_abandoned_goes_and_what_is_being_written_stays() {
        let dir = tempfile::tempdir().unwrap();
        let living = StagedDirectory::create(&dir.path().join("run"), "run.json").unwrap();
        let dead = dir.path().join(".manylight-dead.tmp");
        fs::create_dir(&dead).unwrap();
        fs::write(dead.join("half"), "x").unwrap();
        fs::write(dir.path().join(".manylight-file.tmp"), "x").unwrap();
        fs::write(dir.path().join("other.tmp"), "x").unwrap();
        remove_abandoned(dir.path());
        let living_name = living.path().file_name().unwrap().to_str().unwrap().to_owned();
        assert_eq!(names(dir.path()), [living_name, "other.tmp".into()]);
        living.commit().unwrap();
        assert_eq!(names(dir.path()), ["other.tmp", "run"]);
    }

    #[cfg(unix)]
    #[test]
    fn results_have_ordinary_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let dir = tempfile::tempdir().unwrap();
        let (plain_path, path) = (dir.path().join("plain"), dir.path().join("whole"));
        fs::write(&plain_path, "").unwrap();
        write_whole(&path, |_| Ok(())).unwrap();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&plain_path), mode(&path));
    }
}
