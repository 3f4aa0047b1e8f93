//! manylight replays deterministic recordings of many-light scenes and measures, stage by stage and
//! exactly, how clustered light shading works: which lights reach which fragments, at what cost.
//!
//! ```text
//! recording ──> FrameInput (views, rain) ──┐
//! scene ────────────────────────────────────┤
//! config ─> method plan (pure, CPU, f64) ──┴─> frame ─> passes ─> GPU results ─> measure ─> output
//! ```
//!
//! Nothing flows back: scene and recording know no Vulkan, the maths in [`geometry`] knows neither files
//! nor GPU, [`output`] knows no passes. Start reading at [`frame`].

pub mod assign;
pub mod audience;
pub mod buffers;
pub mod cli;
pub mod clustering;
pub mod compare;
pub mod config;
pub mod cpu;
pub mod culling;
pub mod draw_list;
pub mod drawables;
pub mod engine;
pub mod error;
pub mod export;
pub mod extent;
pub mod frame;
pub mod geometry;
pub mod gpu_interface;
pub mod gpu_scene;
pub mod gpu_types;
pub mod inputs;
mod json;
pub mod layouts;
pub mod lights;
pub mod machine;
pub mod material;
pub mod measure;
pub mod methods;
mod nearest;
pub mod octree;
pub mod origin;
pub mod output;
pub mod pass;
pub mod passes;
pub mod pipelines;
pub mod placements;
pub mod recording;
pub mod replay;
pub mod report;
pub mod scene;
pub mod selftest;
pub mod shading;
pub mod stats;
pub mod still;
pub mod sweep;
pub mod targets;
mod text;
pub mod texture_sets;
pub mod tune;
pub mod vk;

pub use error::{Error, Result};
