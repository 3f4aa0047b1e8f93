//! `manylight devices`.

use super::Console;
use crate::Result;
use crate::vk::DeviceListing;

/// Lists the Vulkan devices.
pub fn run(console: &Console) -> Result<()> {
    console.result(&DeviceListing::new()?)
}
