//! One method under one lighting on the device: renders planned frames, and grows its buffers when one of them
//! turns out to need more.

mod counted;
mod plan;
mod requirements;
mod session;

pub use counted::Counted;
pub use plan::{FramePlan, plan_frames};
pub use session::{Session, shader_library};

use crate::Result;
use crate::assign::{Assigner, Marking};
use crate::buffers::{BufferName, ClusteringSizes};
use crate::clustering::{Clustering, SLOTS, SharedBuffer, grid_data, gridless_data, make_buffer, view_data};
use crate::config::{Config, Scopes};
use crate::culling::Culling;
use crate::frame::{self, Draws, Frame};
use crate::geometry::{SphereTest, VolumeKind};
use crate::gpu_interface::{ClusteringState, DrawCounts, LightData};
use crate::layouts::Pipeline;
use crate::lights::PointLight;
use crate::measure::{Capacities, GrowthEvent};
use crate::methods::MethodSpec;
use crate::pass::{Recorder, ScopeTree};
use crate::passes::readback::STATE_BYTES;
use crate::pipelines::{Pipelines, Variant, lights_at_once};
use crate::vk::{Buffer, Context, Memory};
use ash::vk;
use glam::{DVec3, Vec3};
use plan::views_of_clusterings;
use std::sync::Arc;

/// The device's part of a run in one mode: temporal (nothing counted) or atemporal (all counted).
pub struct Engine {
    context: Arc<Context>,
    method: MethodSpec,
    culling: Culling,
    multiview: bool,
    marking: Marking,
    assigner: Assigner,
    resolution: [u32; 2],
    timed_scopes: usize,
    pipelines: Pipelines,
    sizes: ClusteringSizes,
    lights: Buffer,
    staging: [Buffer; SLOTS],
    staged: Vec<LightData>,
    slice_planes: Vec<f32>,
    clusterings: Vec<Clustering>,
    /// Whether frames are shaded; true at first.
    pub shaded: bool,
    /// Its frames' stages.
    pub tree: ScopeTree,
    /// What was grown, in order.
    pub growth: Vec<GrowthEvent>,
}

/// What an engine is made for.
#[derive(Debug, Clone, Copy)]
pub struct Mode {
    /// Most lights of all frames.
    pub lights: u32,
    /// What the buffers hold at first.
    pub capacities: Capacities,
    /// How the lists are built.
    pub assigner: Assigner,
    /// What decides who is on them.
    pub test: SphereTest,
    /// Whether everything is counted: the atemporal run.
    pub counting: bool,
}

/// What the shaders of a run are specialised for.
pub fn variant(config: &Config, method: MethodSpec, mode: &Mode) -> Variant {
    Variant {
        method,
        samples: config.msaa,
        culling: config.culling,
        multiview: config.multiview,
        marking: config.marking,
        assigner: assigner(method, mode),
        test: mode.test,
        lights_at_once: lights_at_once(method, mode.lights),
        attenuation: config.attenuation,
        counting: mode.counting,
    }
}

/// A method without clusters assigns nothing.
fn assigner(method: MethodSpec, mode: &Mode) -> Assigner {
    if method == MethodSpec::AllLights { Assigner::Brute } else { mode.assigner }
}

fn sizes(config: &Config, method: MethodSpec, plans: &[FramePlan], mode: &Mode) -> ClusteringSizes {
    let none = Capacities { visible_clusters: 0, light_indices: 0 };
    ClusteringSizes {
        clusters: plans.iter().flat_map(|p| &p.grids).map(|g| g.cluster_count()).max().unwrap_or(0),
        slice_planes: plans.iter().flat_map(|p| &p.grids).map(|g| g.dimensions[2] + 1).max().unwrap_or(0),
        lights: mode.lights,
        capacities: if method == MethodSpec::AllLights { none } else { mode.capacities },
        assigner: assigner(method, mode),
        counting: mode.counting,
        pixels: u64::from(config.resolution[0]) * u64::from(config.resolution[1]),
    }
}

/// Commands recorded beside a frame's own.
pub type Commands<'a> = dyn FnMut(&mut Recorder, &Frame) + 'a;

/// Spare room when buffers grow, so that a camera on the move does not grow them each frame.
const GROWTH_MARGIN: u32 = 5;

impl Engine {
    /// Makes pipelines and buffers for `plans`, which are all frames that will be rendered.
    pub fn new(
        session: &mut Session,
        config: &Config,
        method: MethodSpec,
        plans: &[FramePlan],
        mode: Mode,
    ) -> Result<Self> {
        let sizes = sizes(config, method, plans, &mode);
        sizes.check(&session.context.limits)?;
        let light_bytes = (u64::from(mode.lights) * size_of::<LightData>() as u64).max(16);
        let staging = || {
            let usage = vk::BufferUsageFlags::TRANSFER_SRC;
            Buffer::new(&session.context, "light staging", light_bytes, usage, Memory::Upload)
        };
        let mut engine = Self {
            context: session.context.clone(),
            method,
            culling: config.culling,
            multiview: config.multiview && session.targets.len() > 1,
            marking: config.marking,
            assigner: assigner(method, &mode),
            resolution: config.resolution,
            timed_scopes: if config.scopes == Scopes::All { usize::MAX } else { 1 },
            staging: [staging()?, staging()?],
            lights: make_buffer(&session.context, BufferName::Lights, light_bytes, Memory::Device)?,
            pipelines: session.store.pipelines(&variant(config, method, &mode))?,
            sizes,
            staged: Vec::with_capacity(mode.lights as usize),
            slice_planes: vec![],
            clusterings: vec![],
            shaded: true,
            tree: ScopeTree::default(),
            growth: vec![],
        };
        engine.make_clusterings(session)?;
        Ok(engine)
    }

    /// Whether [`Self::new`] would find its shaders in order and its buffers within the device's limits.
    pub fn check(
        session: &mut Session,
        config: &Config,
        method: MethodSpec,
        plans: &[FramePlan],
        mode: &Mode,
    ) -> Result<()> {
        sizes(config, method, plans, mode).check(&session.context.limits)?;
        session.store.pipelines(&variant(config, method, mode)).map(drop)
    }

    /// What the buffers hold now.
    pub fn capacities(&self) -> Capacities {
        self.sizes.capacities
    }

    /// How it finds lights.
    pub fn method(&self) -> MethodSpec {
        self.method
    }

    /// Width and height of each view, pixels.
    pub fn resolution(&self) -> [u32; 2] {
        self.resolution
    }

    fn make_clusterings(&mut self, session: &Session) -> Result<()> {
        self.clusterings.clear();
        let slots = &session.slots;
        let shared: [SharedBuffer; 7] = [
            (BufferName::Views, slots.each_ref().map(|slot| &slot.views)),
            (BufferName::DrawOrder, slots.each_ref().map(|slot| &slot.draw_order)),
            (BufferName::Lights, [&self.lights; SLOTS]),
            (BufferName::Instances, [&session.scene.instances; SLOTS]),
            (BufferName::DrawSlots, [&session.scene.draw_slots; SLOTS]),
            (BufferName::DrawCommands, [&session.draws.commands; SLOTS]),
            (BufferName::DrawnInstances, [&session.draws.drawn_instances; SLOTS]),
        ];
        for views in views_of_clusterings(&self.method, session.targets.len()) {
            let pipelines = self.pipelines.all();
            let clustering = Clustering::new(&session.context, &shared, &self.sizes, views, pipelines)?;
            self.clusterings.push(clustering);
        }
        Ok(())
    }

    /// Lets commands beside a frame's own use more pipelines.
    pub fn bind(&mut self, session: &Session, pipelines: &[Arc<Pipeline>]) -> Result<()> {
        self.clusterings.iter_mut().try_for_each(|clustering| clustering.bind(&session.context, pipelines))
    }

    /// Records and submits a frame into `slot`, whose last frame must have ended. `extend` may record more commands
    /// before and after it.
    pub fn submit(
        &mut self,
        session: &mut Session,
        slot: usize,
        plan: &FramePlan,
        lights: &[PointLight],
        extend: (&mut Commands, &mut Commands),
    ) -> Result<()> {
        self.write_host_data(session, slot, plan, lights)?;
        session.slots[slot].begin()?;
        self.record(session, slot, |r, frame| {
            (extend.0)(r, frame);
            frame::record(r, frame);
            (extend.1)(r, frame);
        });
        session.slots[slot].submit()
    }

    /// Records and submits commands that belong to the frame last rendered in `slot`, and waits for them.
    pub fn follow_up(
        &mut self,
        session: &mut Session,
        slot: usize,
        commands: impl FnOnce(&mut Recorder, &Frame),
    ) -> Result<()> {
        session.slots[slot].begin()?;
        self.record(session, slot, commands);
        session.slots[slot].submit()?;
        session.slots[slot].wait()
    }

    fn record(&mut self, session: &mut Session, slot: usize, body: impl FnOnce(&mut Recorder, &Frame)) {
        let this = &mut session.slots[slot];
        let frame = Frame {
            pipelines: &self.pipelines,
            scene: &session.scene,
            draws: match self.culling {
                Culling::Cpu => Draws::Listed(&this.draw_lists),
                Culling::Gpu => Draws::Indirect {
                    slots: &session.draw_slots,
                    orders: &this.slot_orders,
                    buffers: &session.draws,
                },
            },
            targets: &session.targets,
            mirrored: &this.mirrored,
            clusterings: &self.clusterings,
            clustered: self.method != MethodSpec::AllLights,
            multiview: self.multiview,
            marking: self.marking,
            assigner: self.assigner,
            shaded: self.shaded,
            lights: &self.lights,
            light_staging: &self.staging[slot],
            light_count: self.staged.len() as u32,
            states: &this.states,
            resolution: self.resolution,
            slot,
        };
        let mut recorder = Recorder::new(
            &session.context,
            this.commands,
            &mut self.tree,
            &mut this.timestamps,
            &mut session.tracker,
            self.timed_scopes,
        );
        body(&mut recorder, &frame);
    }

    fn write_host_data(
        &mut self,
        session: &mut Session,
        slot: usize,
        plan: &FramePlan,
        lights: &[PointLight],
    ) -> Result<()> {
        let origin = plan.origin();
        if session.scene.origin != origin {
            session.scene.move_origin(&session.context, origin)?;
        }
        for clustering in 0..self.clusterings.len() {
            self.write_clustering(session, slot, plan, clustering, lights.len() as u32);
        }
        let this = &mut session.slots[slot];
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
                for (view, order) in plan.views.iter().zip(&mut this.slot_orders) {
                    order.update(&session.draw_slots, view);
                    this.draw_order.write(offset, &order.slots);
                    offset += size_of_val(order.slots.as_slice()) as u64;
                }
            }
        }
        self.staged.clear();
        self.staged.extend(lights.iter().map(|light| light_data(light, origin)));
        self.staging[slot].write(0, &self.staged);
        Ok(())
    }

    /// Writes a clustering's grid and the views that look lights up there, relative to the frame's origin.
    fn write_clustering(
        &mut self,
        session: &Session,
        slot: usize,
        plan: &FramePlan,
        number: usize,
        lights: u32,
    ) {
        let clustering = &mut self.clusterings[number];
        let origin = session.scene.origin;
        let grid = plan.grids.get(number).map(|grid| grid.relative_to(origin));
        let views = &plan.views[clustering.views.clone()];
        let data = match &grid {
            Some(grid) => grid_data(grid, views, origin, lights, &self.sizes),
            None => gridless_data(lights),
        };
        clustering.word_count = data.word_count;
        clustering.host[slot][BufferName::Grid].write(0, &[data]);
        if let Some(grid) = &grid {
            grid.slice_planes(&mut self.slice_planes);
            clustering.host[slot][BufferName::SlicePlanes].write(0, &self.slice_planes);
        }
        for (view, number) in views.iter().zip(clustering.views.clone()) {
            let near = view.relative_to(origin);
            let data = view_data(&near, grid.as_ref(), self.resolution, session.scene.reach);
            session.slots[slot].views.write((number * size_of_val(&data)) as u64, &[data]);
        }
    }

    /// What the device found out in the frame that ended in `slot`.
    pub fn states(&self, session: &Session, slot: usize) -> Vec<ClusteringState> {
        session.slots[slot].states.read(0, self.clusterings.len())
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
        self.method != MethodSpec::AllLights
            && (0..self.clusterings.len() as u64).any(|clustering| {
                session.slots[slot].states.read_into(clustering * STATE_BYTES, &mut state);
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

/// A light as shaders read it in a frame with this origin.
fn light_data(light: &PointLight, origin: DVec3) -> LightData {
    LightData {
        position: (Vec3::from(light.position).as_dvec3() - origin).as_vec3().to_array(),
        r1: light.r1,
        tint: light.tint,
        intensity: light.intensity,
        cutoff: light.cutoff,
        r0: light.r0,
        kind: VolumeKind::Sphere as u32,
        ..Default::default()
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        // After an error a frame may still be running on these buffers; the error is already on its way.
        let _ = self.context.wait_idle();
    }
}

#[cfg(test)]
mod tests;
