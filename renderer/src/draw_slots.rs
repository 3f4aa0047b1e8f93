//! What a view draws where the device culls: slots, one indirect draw command each, at places that the host knows
//! before anything is culled. Pure: no Vulkan.
//!
//! ```text
//! slots:     opaque | masked | transparent        (of the scene)
//! commands:  opaque | masked | transparent, far to near        (of each view; what is not seen draws nothing)
//! ```
//!
//! The host sorts transparent slots, whether seen or not, and records one draw of many commands for neighbours that share
//! a material and a facing; stage `cull` fills the commands in.

use crate::draw_list::{Batch, Batches, SurfaceKind, sort_far_to_near};
use crate::geometry::views::View;
use crate::gpu_interface::{DrawCommand, DrawCounts};
use glam::DVec3;

/// Most instances of a slot: what one thread of stage `cull` tests.
const SLOT_INSTANCES: usize = 64;

/// Consecutive commands that are drawn at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DrawGroup {
    /// Into [`Batches::batches`]: one that has the material and the facing of all of them.
    pub batch: u32,
    /// Of the view's commands.
    pub first: u32,
    /// How many.
    pub count: u32,
}

/// The slots of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawSlots {
    /// What each draws where all of it is seen; opaque, then masked, then transparent, these of one instance each.
    pub slots: Vec<DrawCommand>,
    /// How many there are.
    pub counts: DrawCounts,
    batch_of: Vec<u32>,
    batches: Vec<Batch>,
    opaque: Vec<DrawGroup>,
    masked: Vec<DrawGroup>,
    /// Centres of the boxes of the transparent slots.
    centers: Vec<DVec3>,
}

impl DrawSlots {
    /// Splits batches into slots.
    pub fn new(batches: &Batches) -> Self {
        let mut this = Self {
            slots: vec![],
            counts: DrawCounts { instances: batches.instances.len() as u32, ..Default::default() },
            batch_of: vec![],
            batches: batches.batches.clone(),
            opaque: vec![],
            masked: vec![],
            centers: vec![],
        };
        let mut first = 0;
        for instances in batches.batch_of.chunk_by(|a, b| a == b) {
            this.add(batches, instances[0], first..first + instances.len());
            first += instances.len();
        }
        this
    }

    fn add(&mut self, batches: &Batches, batch: u32, instances: std::ops::Range<usize>) {
        let Batch { kind, first_index, index_count, vertex_offset, .. } = self.batches[batch as usize];
        let most = if kind == SurfaceKind::Transparent { 1 } else { SLOT_INSTANCES };
        let end = instances.end;
        for first in instances.step_by(most) {
            let slot = self.slots.len() as u32;
            match kind {
                SurfaceKind::Opaque => append(&mut self.opaque, &self.batches, batch, slot),
                SurfaceKind::Masked => append(&mut self.masked, &self.batches, batch, slot),
                SurfaceKind::Transparent => self.centers.push(batches.boxes[first].center),
            }
            *match kind {
                SurfaceKind::Transparent => &mut self.counts.transparents,
                SurfaceKind::Opaque | SurfaceKind::Masked => &mut self.counts.surfaces,
            } += 1;
            self.batch_of.push(batch);
            self.slots.push(DrawCommand {
                index_count,
                instance_count: most.min(end - first) as u32,
                first_index,
                vertex_offset,
                first_instance: first as u32,
            });
        }
    }
}

/// The order of one view's transparent slots. Keeps its memory from frame to frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SlotOrder {
    /// Transparent slots from far to near.
    pub slots: Vec<u32>,
    transparent: Vec<DrawGroup>,
    far_to_near: Vec<(f64, u32)>,
}

impl SlotOrder {
    /// Sorts the transparent slots for `view`.
    pub fn update(&mut self, slots: &DrawSlots, view: &View) {
        let surfaces = slots.counts.surfaces;
        let distance = |center: &DVec3| center.distance_squared(view.eye());
        self.far_to_near.clear();
        self.far_to_near.extend(slots.centers.iter().map(distance).zip(surfaces..));
        sort_far_to_near(&mut self.far_to_near);
        self.slots.clear();
        self.slots.extend(self.far_to_near.iter().map(|&(_, slot)| slot));
        self.transparent.clear();
        for (command, &slot) in (surfaces..).zip(&self.slots) {
            append(&mut self.transparent, &slots.batches, slots.batch_of[slot as usize], command);
        }
    }

    /// What is drawn of one kind.
    pub fn groups<'a>(&'a self, slots: &'a DrawSlots, kind: SurfaceKind) -> &'a [DrawGroup] {
        match kind {
            SurfaceKind::Opaque => &slots.opaque,
            SurfaceKind::Masked => &slots.masked,
            SurfaceKind::Transparent => &self.transparent,
        }
    }
}

/// Appends a command, to the last group where it shares material and facing.
fn append(groups: &mut Vec<DrawGroup>, batches: &[Batch], batch: u32, command: u32) {
    let state = |batch: u32| {
        let Batch { material, mirrored, double_sided, .. } = batches[batch as usize];
        (material, mirrored, double_sided)
    };
    match groups.last_mut() {
        Some(last) if state(last.batch) == state(batch) => last.count += 1,
        _ => groups.push(DrawGroup { batch, first: command, count: 1 }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw_list::DrawList;
    use crate::geometry::Frustum;
    use crate::geometry::views::Pose;
    use crate::scene::procedural::by_name;
    use glam::DQuat;

    fn view() -> View {
        let pose = Pose {
            position: DVec3::new(-4.0, 2.0, 3.0),
            rotation: DQuat::from_rotation_y(0.4),
            mirror: None,
        };
        View { pose, frustum: Frustum::from_fov(1.3, [64, 32], 0.4, 100.0).unwrap() }
    }

    #[test]
    fn slots_hold_every_instance_once_in_drawing_order() {
        let batches = Batches::new(&by_name("temple").unwrap());
        let slots = DrawSlots::new(&batches);
        let mut instance = 0;
        for (slot, &batch) in slots.slots.iter().zip(&slots.batch_of) {
            assert_eq!(slot.first_instance, instance);
            assert!((1..=SLOT_INSTANCES as u32).contains(&slot.instance_count));
            for _ in 0..slot.instance_count {
                assert_eq!(batches.batch_of[instance as usize], batch);
                instance += 1;
            }
        }
        assert_eq!(instance, slots.counts.instances);
        assert_eq!(slots.slots.len() as u32, slots.counts.surfaces + slots.counts.transparents);
        assert!(slots.slots.iter().any(|slot| slot.instance_count > 1), "nothing is drawn at once");
    }

    #[test]
    fn groups_cover_all_commands_in_order_and_are_few() {
        let batches = Batches::new(&by_name("street").unwrap());
        let slots = DrawSlots::new(&batches);
        let mut order = SlotOrder::default();
        order.update(&slots, &view());
        let groups: Vec<_> = SurfaceKind::ALL.iter().flat_map(|&kind| order.groups(&slots, kind)).collect();
        let mut next = 0;
        for group in &groups {
            assert_eq!(group.first, next);
            next += group.count;
        }
        assert_eq!(next as usize, slots.slots.len());
        assert!(groups.len() * 4 < slots.slots.len(), "{} groups", groups.len());
    }

    #[test]
    fn transparent_slots_are_in_the_order_of_the_list_that_the_host_culls() {
        let batches = Batches::new(&by_name("street").unwrap());
        let slots = DrawSlots::new(&batches);
        let (mut order, mut list) = (SlotOrder::default(), DrawList::default());
        order.update(&slots, &view());
        list.update(&batches, &[view()]);
        let listed: Vec<u32> = list.transparent.iter().map(|run| run.first_instance).collect();
        let instances = order.slots.iter().map(|&slot| slots.slots[slot as usize].first_instance);
        let seen: Vec<u32> = instances.filter(|instance| listed.contains(instance)).collect();
        assert!(listed.len() > 2 && listed.len() < order.slots.len());
        assert_eq!(seen, listed);
    }
}
