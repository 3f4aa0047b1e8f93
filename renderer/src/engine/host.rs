//! What the host writes for each frame before it is recorded: grids, views, what is drawn, lights.

use super::{Engine, FramePlan, Session};
use crate::Result;
use crate::buffers::BufferName;
use crate::clustering::{grid_data, gridless_data, view_data, world_slack};
use crate::culling::Culling;
use crate::gpu_interface::{DrawCounts, GridData};
use crate::gpu_scene::GpuScene;
use crate::lights::{FrameLights, Light};
use crate::methods::{Scenery, hashed};

impl Engine {
    /// Writes what the frame in `slot` is made from; its lights only where they are not those on the device.
    ///
    /// # Errors
    /// A grid larger than the buffers were made for; whatever fails on the device.
    pub(super) fn write_host_data(
        &mut self,
        session: &mut Session,
        slot: usize,
        plan: &FramePlan,
        lights: FrameLights,
    ) -> Result<()> {
        self.largest.check(plan)?;
        let origin = plan.origin();
        if session.scene.origin != origin {
            session.scene.move_origin(&session.context, origin)?;
        }
        self.write_octree(session, slot, (plan, lights))?;
        for clustering in 0..self.clusterings.len() {
            self.write_clustering(session, slot, plan, clustering, lights.list);
        }
        self.write_draws(session, slot, plan);
        self.lights.write(slot, lights, origin);
        Ok(())
    }

    /// Slots for leaves of the octree, in a row; nothing without one.
    fn row_of_leaves(&self) -> [u32; 3] {
        match self.octree() {
            Some(octree) => [hashed::table_sizes(octree).leaves.max(1), 1, 1],
            None => [0; 3],
        }
    }

    /// What each view draws, or in which order.
    fn write_draws(&self, session: &mut Session, slot: usize, plan: &FramePlan) {
        let this = &mut session.frame_slots[slot];
        this.mirrored.clear();
        this.mirrored.extend(plan.views.iter().map(|view| view.pose.mirror.is_some()));
        match self.culling {
            Culling::Cpu => {
                for (view, list) in plan.views.chunks(1).zip(&mut this.draw_lists) {
                    list.update(&session.batches, view);
                }
                if self.multiview {
                    this.draw_lists[plan.views.len()].update(&session.batches, &plan.views);
                }
            }
            Culling::Gpu => {
                let mut offset = size_of::<DrawCounts>() as u64;
                for (view, order) in plan.views.iter().zip(&mut this.drawable_orders) {
                    order.update(&session.drawables, view);
                    this.draw_order.write(offset, &order.drawables);
                    offset += size_of_val(order.drawables.as_slice()) as u64;
                }
            }
        }
    }

    /// Writes a clustering's grid and the views that look lights up there, relative to the frame's origin.
    fn write_clustering(
        &mut self,
        session: &Session,
        slot: usize,
        plan: &FramePlan,
        number: usize,
        lights: &[Light],
    ) {
        let leaves = self.row_of_leaves();
        let clustering = &mut self.clusterings[number];
        let GpuScene { origin, reach, bounds, .. } = session.scene;
        let around =
            Scenery { lights, scene: bounds, models: session.scene.models(), grid_box: self.grid_box };
        let placed = plan.grids.get(number).map(|grid| self.method.settled(grid, &around));
        let grid = placed.map(|grid| grid.relative_to(origin));
        let views = &plan.views[clustering.views.clone()];
        let count = lights.len() as u32;
        let data = match &grid {
            Some(grid) if self.method.is_apart_from_views() => GridData {
                slack: world_slack(grid, views, origin, reach),
                ..grid_data(grid, views, origin, count, &self.sizes)
            },
            Some(grid) => grid_data(grid, views, origin, count, &self.sizes),
            None => GridData { dimensions: leaves, ..gridless_data(count) },
        };
        clustering.cluster_count = grid.map_or(0, |grid| grid.cluster_count() as u32);
        clustering.dimensions = data.dimensions;
        clustering.word_count = data.word_count;
        clustering.dimensions = data.dimensions;
        clustering.host[slot][BufferName::Grid].write(0, &[data]);
        if let Some(grid) = &grid {
            clustering.want_boxes(grid);
            grid.slice_planes(&mut self.slice_planes);
            clustering.host[slot][BufferName::SlicePlanes].write(0, &self.slice_planes);
        }
        for (view, number) in views.iter().zip(clustering.views.clone()) {
            let near = view.relative_to(origin);
            let data = view_data(&near, grid.as_ref(), self.resolution, session.scene.reach);
            session.frame_slots[slot].views.write((number * size_of_val(&data)) as u64, &[data]);
        }
    }
}
