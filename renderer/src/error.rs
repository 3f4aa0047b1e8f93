//! The one error type, with the exit codes the command line documents.

use std::path::{Path, PathBuf};

/// A result whose error is already a sentence for the user.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// What went wrong, as one line for the user: what, where, and what to do.
#[derive(Debug, Clone, thiserror::Error)]
pub enum Error {
    /// Something the user gave is wrong: a flag, a file, a field, a value out of range.
    #[error("{0}")]
    Input(String),
    /// A file could not be read or written.
    #[error("{}: {message}", path.display())]
    File {
        /// The file or directory at fault.
        path: PathBuf,
        /// What is wrong with it, with line and field where known.
        message: String,
    },
    /// The machine lacks something: a loader, a device, a feature, memory.
    #[error("{0}")]
    Device(String),
    /// The program or the driver misbehaved: a validation message, a lost device.
    #[error("{0}")]
    Internal(String),
    /// Some runs of a sweep failed; the others are complete.
    #[error("{0}")]
    Failures(String),
    /// Two result sets that should be equal are not.
    #[error("{0}")]
    Difference(String),
    /// The device or its driver is not fit to be measured.
    #[error("{0}")]
    Unfit(String),
    /// The user interrupted; what was complete is kept.
    #[error("{0}")]
    Interrupted(String),
}

impl Error {
    /// An [`Error::Input`] from anything printable.
    pub fn input(message: impl Into<String>) -> Self {
        Self::Input(message.into())
    }

    /// An [`Error::File`] about `path`.
    pub fn file(path: impl AsRef<Path>, message: impl ToString) -> Self {
        Self::File { path: path.as_ref().to_owned(), message: message.to_string() }
    }

    /// The exit code: 2 for what the user can mend, 3 where some runs of a sweep failed, 130 after an interruption, 1 for anything else.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Input(_) | Self::File { .. } | Self::Device(_) => 2,
            Self::Internal(_) | Self::Difference(_) | Self::Unfit(_) => 1,
            Self::Failures(_) => 3,
            Self::Interrupted(_) => 130,
        }
    }
}
