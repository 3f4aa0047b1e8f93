//! The passes of a frame, one file a pass (or family of passes that share a shader), in the order of
//! [`crate::frame`]; `clay`, `pixel_clusters`, `lines` and `spheres` belong to stills alone.

pub mod assign;
pub mod clay;
pub mod cull;
pub mod cull_lights;
pub mod depth;
pub mod draws;
pub mod hierarchy;
pub mod lights;
pub mod lines;
pub mod mark;
pub mod pixel_clusters;
pub mod pixel_maps;
pub mod readback;
pub mod resolve;
pub mod scan;
pub mod shade;
pub mod spheres;
