//! Buffers that turn out too small: the frame is rendered again with larger ones.

use super::{Commands, Engine, FramePlan, Session};
use crate::gpu_interface::ClusteringState;
use crate::lights::FrameLights;
use crate::measure::{Capacities, GrowthEvent};
use crate::pass::Recorder;
use crate::passes::Frame;
use crate::passes::readback::STATE_BYTES;
use crate::{Error, Result};

/// Extends a frame by nothing.
pub fn nothing(_: &mut Recorder, _: &Frame) {}

/// Spare room when buffers grow, so that a camera on the move does not grow them each frame.
const GROWTH_MARGIN: u32 = 5;

impl Engine {
    /// What the buffers hold now.
    pub fn capacities(&self) -> Capacities {
        let light_indices = u32::try_from(self.sizes.light_indices()).unwrap_or(u32::MAX);
        Capacities { light_indices, ..self.sizes.capacities }
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
    ///
    /// # Errors
    /// Larger buffers are more than the device holds; lists are read off bits that had no room.
    pub fn grow_if_needed(&mut self, session: &Session, slot: usize, frame: u32) -> Result<bool> {
        if !self.overflowed(session, slot) {
            return Ok(false);
        }
        session.context.wait_idle()?;
        let states = self.states(session, slot);
        self.check_masks(&states, frame)?;
        let most = self.sizes.most(&session.context.limits);
        let is_linked = self.lists.links().is_some();
        let visible = most_needed(&states, |state| state.visible_total);
        let indices = most_needed(&states, |state| if is_linked { 0 } else { state.index_total });
        let entries = most_needed(&states, |state| self.entries_needed(state));
        let capacities = &mut self.sizes.capacities;
        for (buffer, capacity, (clustering, needed), most) in [
            ("visible_clusters", &mut capacities.visible_clusters, visible, most.visible_clusters),
            ("light_indices", &mut capacities.light_indices, indices, most.light_indices),
            ("list_entries", &mut capacities.list_entries, entries, most.list_entries),
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

    /// Refuses a frame whose lists are empty because the bits that they are read off had no room.
    fn check_masks(&self, states: &[ClusteringState], frame: u32) -> Result<()> {
        if !states.iter().any(|state| self.lacks_masks(state)) {
            return Ok(());
        }
        Err(Error::Device(format!(
            "frame {frame}: lists {} by {} are read off a bit a light, and those of all lists are more than 64 MiB: use --lists \
             offsets, fewer lights or larger clusters",
            self.lists, self.assigner
        )))
    }

    /// Entries that each list needs, of one size or on average in a pool.
    fn entries_needed(&self, state: &ClusteringState) -> u32 {
        match self.lists.links() {
            Some(_) => u64::from(state.index_total).div_ceil(self.sizes.lists_there().max(1)) as u32,
            None => state.longest,
        }
    }

    fn lacks_masks(&self, state: &ClusteringState) -> bool {
        !self.lists.has_offsets() && self.sizes.has_masks() && state.masked == 0
    }

    /// Whether the frame that ended in `slot` needed more than the buffers hold.
    pub fn overflowed(&self, session: &Session, slot: usize) -> bool {
        let Capacities { visible_clusters, .. } = self.sizes.capacities;
        let mut state = [ClusteringState::default()];
        self.method.assigns()
            && (0..self.clusterings.len() as u64).any(|clustering| {
                session.frame_slots[slot].states.read_into(clustering * STATE_BYTES, &mut state);
                let ClusteringState { visible_total, index_total, longest, .. } = state[0];
                visible_total > visible_clusters
                    || u64::from(index_total) > self.sizes.light_indices()
                    || longest > 0
                    || self.lacks_masks(&state[0])
            })
    }
}

/// The clustering that needs most of something, and how much.
fn most_needed(states: &[ClusteringState], need: impl Fn(&ClusteringState) -> u32) -> (u32, u32) {
    (0..).zip(states.iter().map(need)).max_by_key(|&(_, needed)| needed).unwrap_or_default()
}

/// `needed` with spare room, as far as `most` allows.
pub(super) fn with_margin(needed: u32, most: u32) -> u32 {
    needed.saturating_add(needed / GROWTH_MARGIN).min(most).max(needed)
}
