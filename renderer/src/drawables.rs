//! What a view draws where the device culls: drawables, one indirect draw command each, at places that the host knows
//! before anything is culled. Pure: no Vulkan.
//!
//! ```text
//! drawables:  opaque | masked | transparent                     (of the scene)
//! commands:   opaque | masked | transparent, far to near        (of each view; what is not seen draws nothing)
//! ```
//!
//! The host sorts transparent drawables, whether seen or not, and records one multi-draw for neighbouring commands that
//! share a material and a facing; stage `cull` fills the commands in.

use crate::draw_list::{Batch, Batches, SurfaceKind, sort_far_to_near};
use crate::geometry::views::View;
use crate::gpu_interface::{DrawCommand, DrawCounts};
use glam::DVec3;

/// Most instances of a drawable: what one thread of stage `cull` tests.
const DRAWABLE_INSTANCES: usize = 64;

/// Consecutive commands that one call draws, for they share a material and a facing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MultiDraw {
    /// Index into [`Batches::batches`] of a batch that has the material and the facing of all commands.
    pub batch: u32,
    /// Index of the first command among the commands of a view.
    pub first: u32,
    /// How many commands are drawn.
    pub count: u32,
}

/// Everything of a scene in pieces that the device culls: each a draw command over instances of one batch.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawables {
    /// What each drawable draws where all of it is seen: opaque ones, then masked, then transparent of one instance each.
    pub all: Vec<DrawCommand>,
    /// How many drawables and instances there are.
    pub counts: DrawCounts,
    batch_of: Vec<u32>,
    batches: Vec<Batch>,
    opaque: Vec<MultiDraw>,
    masked: Vec<MultiDraw>,
    /// Centres of the boxes of the transparent drawables.
    centers: Vec<DVec3>,
}

impl Drawables {
    /// Splits batches into drawables.
    pub fn new(batches: &Batches) -> Self {
        let mut this = Self {
            all: vec![],
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
        let most = if kind == SurfaceKind::Transparent { 1 } else { DRAWABLE_INSTANCES };
        let end = instances.end;
        for first in instances.step_by(most) {
            let drawable = self.all.len() as u32;
            match kind {
                SurfaceKind::Opaque => append(&mut self.opaque, &self.batches, batch, drawable),
                SurfaceKind::Masked => append(&mut self.masked, &self.batches, batch, drawable),
                SurfaceKind::Transparent => self.centers.push(batches.boxes[first].center),
            }
            *match kind {
                SurfaceKind::Transparent => &mut self.counts.transparents,
                SurfaceKind::Opaque | SurfaceKind::Masked => &mut self.counts.surfaces,
            } += 1;
            self.batch_of.push(batch);
            self.all.push(DrawCommand {
                index_count,
                instance_count: most.min(end - first) as u32,
                first_index,
                vertex_offset,
                first_instance: first as u32,
            });
        }
    }
}

/// The order in which one view draws transparent drawables; its memory is kept from frame to frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DrawableOrder {
    /// Transparent drawables from far to near.
    pub drawables: Vec<u32>,
    transparent: Vec<MultiDraw>,
    far_to_near: Vec<(f64, u32)>,
}

impl DrawableOrder {
    /// Sorts the transparent drawables for `view`.
    pub fn update(&mut self, drawables: &Drawables, view: &View) {
        let surfaces = drawables.counts.surfaces;
        let distance = |center: &DVec3| center.distance_squared(view.eye());
        self.far_to_near.clear();
        self.far_to_near.extend(drawables.centers.iter().map(distance).zip(surfaces..));
        sort_far_to_near(&mut self.far_to_near);
        self.drawables.clear();
        self.drawables.extend(self.far_to_near.iter().map(|&(_, drawable)| drawable));
        self.transparent.clear();
        for (command, &drawable) in (surfaces..).zip(&self.drawables) {
            append(&mut self.transparent, &drawables.batches, drawables.batch_of[drawable as usize], command);
        }
    }

    /// The multi-draws that draw all surfaces of one kind.
    pub fn multi_draws<'a>(&'a self, drawables: &'a Drawables, kind: SurfaceKind) -> &'a [MultiDraw] {
        match kind {
            SurfaceKind::Opaque => &drawables.opaque,
            SurfaceKind::Masked => &drawables.masked,
            SurfaceKind::Transparent => &self.transparent,
        }
    }
}

/// Appends a command: to the last multi-draw where it shares material and facing, else as a new one.
fn append(draws: &mut Vec<MultiDraw>, batches: &[Batch], batch: u32, command: u32) {
    let state = |batch: u32| {
        let Batch { material, mirrored, double_sided, .. } = batches[batch as usize];
        (material, mirrored, double_sided)
    };
    match draws.last_mut() {
        Some(last) if state(last.batch) == state(batch) => last.count += 1,
        _ => draws.push(MultiDraw { batch, first: command, count: 1 }),
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
    fn drawables_hold_every_instance_once_in_drawing_order() {
        let batches = Batches::new(&by_name("temple").unwrap());
        let drawables = Drawables::new(&batches);
        let mut instance = 0;
        for (drawable, &batch) in drawables.all.iter().zip(&drawables.batch_of) {
            assert_eq!(drawable.first_instance, instance);
            assert!((1..=DRAWABLE_INSTANCES as u32).contains(&drawable.instance_count));
            for _ in 0..drawable.instance_count {
                assert_eq!(batches.batch_of[instance as usize], batch);
                instance += 1;
            }
        }
        assert_eq!(instance, drawables.counts.instances);
        assert_eq!(drawables.all.len() as u32, drawables.counts.surfaces + drawables.counts.transparents);
        assert!(drawables.all.iter().any(|drawable| drawable.instance_count > 1), "nothing is drawn at once");
    }

    #[test]
    fn multi_draws_cover_all_commands_in_order_and_are_few() {
        let batches = Batches::new(&by_name("street").unwrap());
        let drawables = Drawables::new(&batches);
        let mut order = DrawableOrder::default();
        order.update(&drawables, &view());
        let draws: Vec<_> =
            SurfaceKind::ALL.iter().flat_map(|&kind| order.multi_draws(&drawables, kind)).collect();
        let mut next = 0;
        for draw in &draws {
            assert_eq!(draw.first, next);
            next += draw.count;
        }
        assert_eq!(next as usize, drawables.all.len());
        assert!(draws.len() * 4 < drawables.all.len(), "{} multi-draws", draws.len());
    }

    #[test]
    fn transparent_drawables_are_in_the_order_of_the_list_that_the_host_culls() {
        let batches = Batches::new(&by_name("street").unwrap());
        let drawables = Drawables::new(&batches);
        let (mut order, mut list) = (DrawableOrder::default(), DrawList::default());
        order.update(&drawables, &view());
        list.update(&batches, &[view()]);
        let listed: Vec<u32> = list.transparent.iter().map(|run| run.first_instance).collect();
        let instances =
            order.drawables.iter().map(|&drawable| drawables.all[drawable as usize].first_instance);
        let seen: Vec<u32> = instances.filter(|instance| listed.contains(instance)).collect();
        assert!(listed.len() > 2 && listed.len() < order.drawables.len());
        assert_eq!(seen, listed);
    }
}
