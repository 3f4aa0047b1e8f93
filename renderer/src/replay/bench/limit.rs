//! How fast assignment could be at most: a pass that reads every light once and writes every entry of the lists once,
//! nothing more, on the lights and lists of a frame.

use super::SLOT;
use crate::Result;
use crate::config::Config;
use crate::engine::{Engine, Mode, Session, variant};
use crate::layouts::Pipeline;
use crate::passes::limit;
use std::sync::Arc;

/// The way of a row with the limit.
pub const LIMIT: &str = "limit";

/// The pass, for what an engine rendered last.
pub struct Limit {
    pipeline: Arc<Pipeline>,
    /// Of the lists of each clustering.
    entries: Vec<u32>,
}

impl Limit {
    /// For an engine of `run` and `mode` that has rendered the frame.
    pub fn new(session: &mut Session, engine: &mut Engine, (run, mode): (&Config, &Mode)) -> Result<Self> {
        let pipeline = session.store.limit(&variant(run, mode))?;
        engine.bind(session, std::slice::from_ref(&pipeline))?;
        let entries = engine.states(session, SLOT).iter().map(|state| state.index_total).collect();
        Ok(Self { pipeline, entries })
    }

    /// GPU milliseconds of the pass over all clusterings. The engine's lists are gone afterwards.
    pub fn time(&self, session: &mut Session, engine: &mut Engine) -> Result<f64> {
        engine.follow_up(session, SLOT, |r, frame| {
            for (clustering, &entries) in self.entries.iter().enumerate() {
                limit::record(r, frame, (clustering, entries), &self.pipeline);
            }
        })?;
        Ok(session.frame_slots[SLOT].timestamps.read()?.map(|time| time.gpu_ms).sum())
    }
}
