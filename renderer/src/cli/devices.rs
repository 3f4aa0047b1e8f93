//! `manylight devices`.

use super::Console;
use crate::{Error, Result};

/// Lists the Vulkan devices.
pub fn run(_console: &Console) -> Result<()> {
    Err(Error::Internal("devices is not connected yet".into()))
}
