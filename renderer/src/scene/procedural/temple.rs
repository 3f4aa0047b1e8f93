//! The temple.
use super::Size;
use super::builder::Builder;
pub(super) fn build(_size: Size) -> Builder {
    Builder::default()
}
