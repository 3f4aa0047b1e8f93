//! Compiled shaders on disk, so that only changed ones are compiled at start.

use sha2::{Digest, Sha256};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

/// SHA-256 over everything that the SPIR-V depends on.
pub(super) type Key = [u8; 32];

/// Start of every file; the number counts changes of the format.
const MAGIC: &[u8; 8] = b"MLSPIRV1";
const HASH_BYTES: usize = 32;
/// First word of every SPIR-V module.
const SPIRV_MAGIC: u32 = 0x0723_0203;

/// A directory of files `<key>.spv`: magic, SHA-256 of the words, the words (little-endian).
///
/// It is never worth an error: what cannot be read or does not fit its hash is compiled anew, what cannot be written
/// is not kept.
pub(super) struct DiskCache {
    directory: PathBuf,
}

impl DiskCache {
    /// The cache in `directory`, which is made when first written to.
    pub fn new(directory: PathBuf) -> Self {
        Self { directory }
    }

    /// The user's cache: `$XDG_CACHE_HOME/manylight/spirv`, else `~/.cache/manylight/spirv`; `None` without a home.
    pub fn of_user() -> Option<Self> {
        let variable = |name| std::env::var_os(name).map(PathBuf::from);
        user_directory(variable("XDG_CACHE_HOME"), variable("HOME")).map(Self::new)
    }

    /// The words kept under `key`, if whole.
    pub fn load(&self, key: &Key) -> Option<Vec<u32>> {
        let path = self.path(key);
        let bytes = fs::read(&path).ok()?;
        let words = decode(&bytes);
        if words.is_none() {
            tracing::debug!("{}: a damaged cache entry is compiled anew", path.display());
        }
        words
    }

    /// Keeps `words` under `key`; readers see the whole file or none.
    pub fn store(&self, key: &Key, words: &[u32]) {
        if let Err(error) = write(&self.directory, &self.path(key), &encode(words)) {
            tracing::debug!("{}: shaders are not cached: {error}", self.directory.display());
        }
    }

    fn path(&self, key: &Key) -> PathBuf {
        let hex: String = key.iter().map(|byte| format!("{byte:02x}")).collect();
        self.directory.join(hex + ".spv")
    }
}

/// The XDG Base Directory Specification's rule: a relative path is as good as none.
fn user_directory(cache_home: Option<PathBuf>, home: Option<PathBuf>) -> Option<PathBuf> {
    let absolute = |path: Option<PathBuf>| path.filter(|path| path.is_absolute());
    let base = absolute(cache_home).or_else(|| absolute(home).map(|home| home.join(".cache")))?;
    Some(base.join("manylight/spirv"))
}

fn write(directory: &Path, path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    fs::create_dir_all(directory)?;
    let mut file = tempfile::NamedTempFile::new_in(directory)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

fn encode(words: &[u32]) -> Vec<u8> {
    let body: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let hash = Sha256::digest(&body);
    [MAGIC.as_slice(), hash.as_slice(), &body].concat()
}

fn decode(bytes: &[u8]) -> Option<Vec<u32>> {
    let (hash, body) = bytes.strip_prefix(MAGIC)?.split_at_checked(HASH_BYTES)?;
    let whole = body.len() % 4 == 0 && Sha256::digest(body).as_slice() == hash;
    let words: Vec<u32> =
        body.chunks_exact(4).map(|c| u32::from_le_bytes([c[0], c[1], c[2], c[3]])).collect();
    (whole && words.first() == Some(&SPIRV_MAGIC)).then_some(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORDS: [u32; 3] = [SPIRV_MAGIC, 1, 2];

    #[test]
    fn a_damaged_entry_is_never_taken() {
        let whole = encode(&WORDS);
        assert_eq!(decode(&whole).as_deref(), Some(&WORDS[..]));
        for byte in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[byte] ^= 1;
            assert_eq!(decode(&damaged), None, "byte {byte}");
            assert_eq!(decode(&whole[..byte]), None, "cut at {byte}");
        }
        assert_eq!(decode(&encode(&[7, 7])), None);
    }

    #[test]
    fn the_users_cache_is_where_xdg_says() {
        let at = |cache: &str, home: &str| user_directory(Some(cache.into()), Some(home.into()));
        assert_eq!(at("/c", "/h"), Some("/c/manylight/spirv".into()));
        assert_eq!(at("relative", "/h"), Some("/h/.cache/manylight/spirv".into()));
        assert_eq!(at("", ""), None);
    }

    #[test]
    fn an_unwritable_directory_is_no_error() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let cache = DiskCache::new(file.path().join("below"));
        cache.store(&[0; 32], &WORDS);
        assert_eq!(cache.load(&[0; 32]), None);
    }
}
