//! Ctrl-C: a flag that long work polls.

use crate::{Error, Result};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether the user has asked to stop. Clones share one flag.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Catches Ctrl-C from now on: the first raises the flag, a second ends the program at once.
    ///
    /// # Errors
    /// The handler cannot be installed, or already is.
    pub fn install() -> Result<Self> {
        let interrupt = Self::default();
        let raised = interrupt.clone();
        ctrlc::set_handler(move || {
            if raised.raise() {
                std::process::exit(130);
            }
        })
        .map_err(|error| Error::Internal(format!("Ctrl-C cannot be caught: {error}")))?;
        Ok(interrupt)
    }

    /// Raises the flag; says whether it was raised before.
    pub fn raise(&self) -> bool {
        self.0.swap(true, Ordering::SeqCst)
    }

    /// The flag, for those who poll it.
    pub fn flag(&self) -> &AtomicBool {
        &self.0
    }

    /// Whether the flag is raised.
    pub fn requested(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clones_share_the_flag() {
        let interrupt = Interrupt::default();
        let twin = interrupt.clone();
        assert!(!twin.requested());
        assert!(!interrupt.raise());
        assert!(twin.requested());
        assert!(interrupt.raise());
    }
}
