//! The passes of a frame, one file a pass (or family of passes that share a shader), in the order of
//! [`crate::frame`]; `clay`, `gbuffer_picture`, `pixel_clusters`, `lines` and `spheres` belong to stills alone. What they record from is
//! [`Frame`]; what they hand on are handles, such as [`Depth`] and [`LightLists`].

pub mod assign;
pub mod bounds;
pub mod build_boxes;
pub mod clay;
pub mod cones;
pub mod cull;
pub mod cull_lights;
pub mod depth;
pub mod depth_steps;
pub mod draws;
pub mod gbuffer;
pub mod gbuffer_picture;
mod handles;
pub mod hierarchy;
mod inputs;
pub mod light;
pub mod lights;
pub mod limit;
pub mod lines;
pub mod list_clusters;
pub mod mark;
pub mod octree;
pub mod pixel_clusters;
pub mod pixel_maps;
mod pixel_models;
pub mod probes;
pub mod raster;
pub mod readback;
pub mod resolve;
pub mod scan;
pub mod seen;
pub mod shade;
pub mod sort_tiles;
pub mod spheres;
pub mod take_places;

pub use handles::{Color, Depth, GBuffer, LightLists, Lights, VisibleClusters};
pub use inputs::{ColorTarget, DrawBuffers, Draws, Eyes, Frame, ImageLayer, ViewTargets};
pub use lights::LightUpload;
