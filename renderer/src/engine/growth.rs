//! Buffers that turn out too small: the frame is rendered again with larger ones.

use super::{Commands, Engine, FramePlan, Session};
use crate::Result;
use crate::gpu_interface::ClusteringState;
use crate::lights::FrameLights;
use crate::measure::{Capacities, GrowthEvent};
use crate::pass::Recorder;
use crate::passes::Frame;
use crate::passes::readback::STATE_BYTES;

/// Extends a frame by nothing.
pub fn nothing(_: &mut Recorder, _: &Frame) {}

/// Spare room when buffers grow, so that a camera on the move does not grow them each frame.
const GROWTH_MARGIN: u32 = 5;

impl Engine {
    /// What the buffers hold now.
    pub fn capacities(&self) -> Capacities {
        self.sizes.capacities
    }

    /// Renders a frame in `slot` and waits for it, again and again until its buffers hold it. No other frame may be in
    /// flight. `extend` may record more commands before and after it.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn render(
        &mut self,
        session: &mut Session,
        slot: usize,
        (plan, lights): (&FramePlan, FrameLights),
        extend: (&mut Commands, &mut Commands),
    ) -> Result<()> {
        loop {
            self.submit(session, slot, (plan, lights), (&mut *extend.0, &mut *extend.1))?;
            session.frame_slots[slot].wait()?;
            if !self.grow_if_needed(session, slot, plan.frame)? {
                return Ok(());
            }
        }
    }

    /// Where the frame that ended in `slot` needed more than the buffers hold, grows them and says true: the frame
    /// must be rendered again. No other frame may be in flight.
    pub fn grow_if_needed(&mut self, session: &Session, slot: usize, frame: u32) -> Result<bool> {
        if !self.overflowed(session, slot) {
            return Ok(false);
        }
        session.context.wait_idle()?;
        let states = self.states(session, slot);
        let most = self.sizes.most(&session.context.limits);
        let capacities = &mut self.sizes.capacities;
        let visible = most_needed(&states, |state| state.visible_total);
        let indices = most_needed(&states, |state| state.index_total);
        for (buffer, capacity, (clustering, needed), most) in [
            ("visible_clusters", &mut capacities.visible_clusters, visible, most.visible_clusters),
            ("light_indices", &mut capacities.light_indices, indices, most.light_indices),
        ] {
            if needed > *capacity {
                let (from, to) = (*capacity, with_margin(needed, most));
                *capacity = to;
                let buffer = buffer.to_owned();
                self.growth.push(GrowthEvent { frame, clustering, buffer, from, to });
            }
        }
        self.make_clusterings(session)?;
        Ok(true)
    }

    /// Whether the frame that ended in `slot` needed more than the buffers hold.
    pub fn overflowed(&self, session: &Session, slot: usize) -> bool {
        let Capacities { visible_clusters, light_indices } = self.sizes.capacities;
        let mut state = [ClusteringState::default()];
        self.method.has_lists()
            && (0..self.clusterings.len() as u64).any(|clustering| {
                session.frame_slots[slot].states.read_into(clustering * STATE_BYTES, &mut state);
                state[0].visible_total > visible_clusters || state[0].index_total > light_indices
            })
    }
}

/// The clustering that needs most of something, and how much.
fn most_needed(states: &[ClusteringState], need: impl Fn(&ClusteringState) -> u32) -> (u32, u32) {
    (0..).zip(states.iter().map(need)).max_by_key(|&(_, needed)| needed).unwrap_or_default()
}

/// `needed` with spare room, as far as `most` allows.
fn with_margin(needed: u32, most: u32) -> u32 {
    needed.saturating_add(needed / GROWTH_MARGIN).min(most).max(needed)
}
