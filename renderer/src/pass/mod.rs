//! How passes are recorded: every one in one call of the [`Recorder`], from which its label, its barriers and what it
//! binds follow; stages, with timestamps, are the recorder's scopes.

mod access;
mod compute;
mod declared;
mod draw;
mod recorder;
mod scope_tree;
mod transfer;

pub use crate::gpu_interface::Push;
pub use access::{Access, Use};
pub use compute::{DepthImage, Dispatch, Size};
pub use declared::Declared;
pub use draw::Draw;
pub use recorder::{Faults, FrameTracker, Recorder, ScopeSpan, ScopeTime, Timed, Timestamps};
pub use scope_tree::{ScopeId, ScopeName, ScopeTree};
pub use transfer::{BufferCopy, BufferParts};

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::{Path, PathBuf};

    fn sources(directory: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                sources(&path, found);
            } else {
                found.push(path);
            }
        }
    }

    #[test]
    fn nobody_else_records_commands_but_who_draws_the_scene() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut found = vec![];
        sources(&root, &mut found);
        assert!(found.len() > 100);
        for path in found {
            let name = path.strip_prefix(&root).unwrap();
            let may = name.starts_with("vk") || name.starts_with("pass") || name.ends_with("passes/draws.rs");
            let records = fs::read_to_string(&path).unwrap().contains(".cmd_");
            assert!(may || !records, "{} records commands by itself", name.display());
        }
    }
}
