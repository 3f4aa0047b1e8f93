//! The shaders with which the self-test and benchmarks measure; no replay makes them.

use super::{Output, PipelineStore, Variant, Visit};
use crate::Result;
use crate::draw_list::SurfaceKind;
use crate::layouts::Pipeline;
use std::sync::Arc;

impl PipelineStore {
    /// A compute shader of the self-test, for this variant.
    pub fn probe(&mut self, variant: &Variant, path: &str) -> Result<Arc<Pipeline>> {
        self.compute(path, &variant.defines())
    }

    /// The least that assignment can do, for benchmarks.
    pub fn limit(&mut self, variant: &Variant) -> Result<Arc<Pipeline>> {
        self.compute("bench/limit.comp", &variant.defines())
    }

    /// A fragment shader of the self-test for opaque surfaces, of a variant that shades per sample.
    pub fn surface_probe(&mut self, variant: &Variant, path: &str) -> Result<Arc<Pipeline>> {
        self.graphics(variant, Some(path), Output::Visits(SurfaceKind::Opaque, Visit::Count))
    }
}
