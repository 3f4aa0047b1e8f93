//! Brute force: every fragment evaluates every light. There is nothing to plan, to build or to look up; the truth that
//! every other method is compared with.

use crate::passes::{Depth, LightLists};

/// Records nothing: shading walks the lights themselves (`lookup/all_lights.glsl`).
pub fn record(depth: Depth) -> (Depth, LightLists) {
    (depth, LightLists::ALL_LIGHTS)
}
