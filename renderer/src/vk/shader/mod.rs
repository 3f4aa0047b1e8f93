//! GLSL to SPIR-V through glslang, at run time, cached by content.
//!
//! Sources are embedded in the binary or read from a directory. A root shader starts with `#version 460`; `#include
//! "lib/scan.glsl"` is looked up below the shaders' root, then beside the includer; a file with a line `#pragma once`
//! is included once only. Generated files (`generated/...`) are included like any other. A define may choose a file:
//! `#include "lookup/$LOOKUP.glsl"`.

mod cache;
mod compiler;
mod sources;
#[cfg(test)]
mod tests;

use crate::Result;
use cache::{DiskCache, Key};
use sha2::{Digest, Sha256};
use sources::{Closure, Sources};
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// All shader sources and what was compiled of them. Compiling is thread-safe.
pub struct ShaderLibrary {
    sources: Sources,
    compiled: Mutex<HashMap<Key, Arc<Vec<u32>>>>,
    disk: Option<DiskCache>,
}

impl ShaderLibrary {
    /// Sources from `directory`, read at each compilation, or the embedded ones; `generated` holds (include name, text)
    /// and goes before both. Results are kept in the user's cache directory.
    ///
    /// # Errors
    /// [`crate::Error::File`] when `directory` is no directory.
    pub fn new(directory: Option<&Path>, generated: Vec<(String, String)>) -> Result<Self> {
        let sources = Sources::new(directory, generated)?;
        Ok(Self { sources, compiled: Mutex::default(), disk: DiskCache::of_user() })
    }

    /// Hex SHA-256 over all sources.
    ///
    /// # Errors
    /// [`crate::Error::File`] when the directory cannot be read.
    pub fn sources_sha256(&self) -> Result<String> {
        self.sources.sha256()
    }

    /// Keeps results in `directory` instead of the user's cache, or, with `None`, in memory alone.
    pub fn with_cache(self, directory: Option<PathBuf>) -> Self {
        Self { disk: directory.map(DiskCache::new), ..self }
    }

    /// SPIR-V 1.6 for Vulkan 1.3 of the shader at `path` below the root, whose extension (`.vert`, `.frag`, `.comp`)
    /// is its stage. A define may be given in any order, an empty value defines the bare name.
    ///
    /// # Errors
    /// In one line with file, line and include stack, as [`crate::Error::Input`] for sources from a directory and
    /// [`crate::Error::Internal`] for embedded ones.
    pub fn compile(&self, path: &str, defines: &[(&str, String)]) -> Result<Arc<Vec<u32>>> {
        let defines: BTreeMap<&str, &str> =
            defines.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let closure = self.sources.closure(path, &defines)?;
        let key = key(&closure, &defines);
        if let Some(words) = self.lock().get(&key) {
            return Ok(words.clone());
        }
        let kept = self.disk.as_ref().and_then(|disk| disk.load(&key));
        let words = match kept {
            Some(words) => words,
            None => self.compile_anew(&closure, &defines, &key)?,
        };
        Ok(self.lock().entry(key).or_insert_with(|| Arc::new(words)).clone())
    }

    fn compile_anew(&self, closure: &Closure, defines: &BTreeMap<&str, &str>, key: &Key) -> Result<Vec<u32>> {
        let words = compiler::compile(&self.sources, closure, defines)?;
        tracing::debug!("compiled {} {defines:?}", closure.root);
        if let Some(disk) = &self.disk {
            disk.store(key, &words);
        }
        Ok(words)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, HashMap<Key, Arc<Vec<u32>>>> {
        self.compiled.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The hash of all that the result depends on: compiler, root (whose extension is the stage), defines, and every file
/// within reach, each part with its length.
fn key(closure: &Closure, defines: &BTreeMap<&str, &str>) -> Key {
    let mut hash = Sha256::new();
    let mut add = |text: &str| {
        hash.update((text.len() as u64).to_le_bytes());
        hash.update(text);
    };
    add(compiler::COMPILER_VERSION);
    add(&closure.root);
    add(&defines.len().to_string());
    defines.iter().for_each(|(name, value)| [name, value].into_iter().for_each(|text| add(text)));
    closure.files.iter().for_each(|(name, file)| [name, &file.text].into_iter().for_each(|text| add(text)));
    hash.finalize().into()
}
