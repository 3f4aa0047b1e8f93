//! The passes of a frame, one file a pass (or family of passes that share a shader), in the order of
//! [`crate::frame`].

pub mod assign;
pub mod depth;
pub mod draws;
pub mod lights;
pub mod mark;
pub mod pixel_maps;
pub mod readback;
pub mod resolve;
pub mod scan;
pub mod shade;
