//! The files a scene is read from: hashed in the order they are read.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::{Error, Result};

/// Reads files whole and hashes what it reads.
#[derive(Default)]
pub(super) struct SourceFiles {
    hasher: Sha256,
}

impl SourceFiles {
    /// The bytes of `path`.
    pub fn read(&mut self, path: &Path) -> Result<Vec<u8>> {
        let bytes = fs::read(path).map_err(|e| Error::file(path, format!("cannot be read: {e}")))?;
        self.hasher.update(&bytes);
        Ok(bytes)
    }

    /// Hex SHA-256 over everything read.
    pub fn sha256(self) -> String {
        self.hasher.finalize().iter().fold(String::with_capacity(64), |mut hex, byte| {
            let _ = write!(hex, "{byte:02x}");
            hex
        })
    }
}
