//! Renders and counts planned frames: what replay, stills and benchmarks have in common.
//!
//! ```text
//! config, recording ──plan──> FramePlan (views, grids) ─┐
//! light source ──────────────> FrameLights ─────────────┼─ Engine: host data -> frame -> states ─> Counted
//! scene, device ─────────────> Session ─────────────────┘            └─ too small: grow, once more
//! ```
//!
//! A [`Session`] is a device with a scene; an [`Engine`] is one method under one lighting on it.

mod count;
mod counted;
mod frame_slot;
mod growth;
mod host;
mod kept;
mod lights;
mod mode;
mod octree;
mod plan;
mod requirements;
mod session;
mod shell_layers;
mod targets;
pub(crate) mod workbench;

pub use count::{COUNTING_SLOT, CountedFrame, count_frame, look_at_frame};
pub use counted::Counted;
pub use frame_slot::FrameSlot;
pub use growth::nothing;
pub use mode::{LargestGrid, Mode, variant};
pub use plan::{FramePlan, plan_frames};
pub use session::{Session, shader_library};

use crate::assign::{Assigner, ClusterBounds, Clusters, Compaction, ListStore, Marking};
use crate::buffers::{BufferName, ClusteringSizes, Copies};
use crate::clustering::{Clustering, FRAME_SLOTS, SharedBuffer};
use crate::config::{Config, Scopes};
use crate::culling::Culling;
use crate::geometry::{ConeTest, NormalCones};
use crate::gpu_interface::ClusteringState;
use crate::layouts::Pipeline;
use crate::lights::FrameLights;
use crate::measure::{
    ClusteringCounts, FrameCounts, GrowthEvent, OctreeBuild, OctreeCounts, StructureMemory,
};
use crate::methods::{GridBox, Method};
use crate::octree::LinklessOctree;
use crate::pass::{Recorder, ScopeTree, Timed};
use crate::passes::{Draws, Frame};
use crate::pipelines::Pipelines;
use crate::shading::{Shading, ShadingPipeline};
use crate::vk::{Context, Image};
use crate::{Result, frame};
use lights::DeviceLights;
use mode::Chosen;
use octree::HostOctree;
use std::sync::Arc;

/// The device's part of a run in one mode: temporal (nothing counted) or atemporal (all counted).
pub struct Engine {
    context: Arc<Context>,
    method: Method,
    culling: Culling,
    multiview: bool,
    marking: Marking,
    clusters: Clusters,
    bounds: ClusterBounds,
    normal_cones: NormalCones,
    compaction: Compaction,
    lists: ListStore,
    grid_box: GridBox,
    assigner: Assigner,
    cones: ConeTest,
    shading: Shading,
    pipeline: ShadingPipeline,
    resolution: [u32; 2],
    timed: Timed,
    pipelines: Pipelines,
    sizes: ClusteringSizes,
    largest: LargestGrid,
    lights: DeviceLights,
    slice_planes: Vec<f32>,
    /// Layers that meshes are drawn into, where they are.
    shell_layers: Option<Image>,
    octree: Option<HostOctree>,
    clusterings: Vec<Clustering>,
    /// Whether frames are shaded; true at first.
    pub shaded: bool,
    /// Stages of the engine's frames.
    pub tree: ScopeTree,
    /// What was grown, in order.
    pub growth: Vec<GrowthEvent>,
}

/// Commands recorded beside a frame's own.
pub type Commands<'a> = dyn FnMut(&mut Recorder, &Frame) + 'a;

impl Engine {
    /// Makes pipelines and buffers for frames of a run, whose configuration has one value on every axis, with grids up to
    /// the largest. Its lights come from one source.
    ///
    /// # Errors
    /// Buffers beyond the device's limits; shaders that do not compile.
    pub fn new(session: &mut Session, run: &Config, largest: LargestGrid, mode: Mode) -> Result<Self> {
        let chosen = Chosen::of(run, &mode);
        chosen.check(session.scene.models(), mode.lights.count)?;
        let largest = chosen.largest(largest, session.scene.models());
        let limits = &session.context.limits;
        chosen.check_grid(largest, run.msaa, limits.max_compute_shared_memory)?;
        let sizes = chosen.sizes(run, largest, &mode);
        sizes.check(&session.context.limits)?;
        let mut engine = Self {
            context: session.context.clone(),
            method: chosen.method,
            culling: run.culling,
            multiview: run.multiview && session.targets.len() > 1,
            clusters: chosen.clusters,
            bounds: chosen.bounds,
            normal_cones: chosen.normal_cones,
            compaction: chosen.compaction,
            lists: chosen.lists,
            grid_box: run.grid_box,
            marking: run.marking,
            assigner: chosen.assigner,
            cones: chosen.cones(&mode),
            shading: run.shading[0],
            pipeline: run.pipeline[0],
            resolution: run.resolution,
            timed: timed(run.scopes),
            lights: DeviceLights::new(&session.context, chosen.room(&mode))?,
            pipelines: session.store.pipelines(&chosen.variant(run, &mode))?,
            largest,
            sizes,
            octree: HostOctree::new(
                &session.context,
                (chosen.method, run.octree[0]),
                &sizes.capacities.octree,
            )?,
            shell_layers: chosen
                .has_layers()
                .then(|| shell_layers::make(&session.context, largest.sides, mode.lights.count))
                .transpose()?,
            slice_planes: Vec::with_capacity(largest.slice_planes as usize),
            clusterings: vec![],
            shaded: true,
            tree: ScopeTree::default(),
            growth: vec![],
        };
        engine.make_clusterings(session)?;
        Ok(engine)
    }

    /// Whether [`Self::new`] would find its shaders in order and its buffers within the device's limits.
    ///
    /// # Errors
    /// As there.
    pub fn check(session: &mut Session, run: &Config, largest: LargestGrid, mode: &Mode) -> Result<()> {
        let chosen = Chosen::of(run, mode);
        chosen.check(session.scene.models(), mode.lights.count)?;
        let largest = chosen.largest(largest, session.scene.models());
        let limits = &session.context.limits;
        chosen.check_grid(largest, run.msaa, limits.max_compute_shared_memory)?;
        chosen.sizes(run, largest, mode).check(limits)?;
        session.store.pipelines(&chosen.variant(run, mode)).map(drop)
    }

    /// What the buffers of an engine take, bytes.
    pub fn bytes(session: &Session, run: &Config, largest: LargestGrid, mode: &Mode) -> u64 {
        let chosen = Chosen::of(run, mode);
        let largest = chosen.largest(largest, session.scene.models());
        let clusterings = chosen.method.kind().sharing.clusterings(session.targets.len()) as u64;
        let slots = FRAME_SLOTS as u64;
        clusterings * chosen.sizes(run, largest, mode).bytes(slots) + DeviceLights::bytes(chosen.room(mode))
    }

    /// What each structure takes, and what frames need of it by their counts.
    pub fn memory(&self, counts: &[FrameCounts]) -> Vec<StructureMemory> {
        let copies = Copies { clusterings: self.clusterings.len() as u64, slots: FRAME_SLOTS as u64 };
        let frames: Vec<&[ClusteringCounts]> =
            counts.iter().map(|frame| frame.clusterings.as_slice()).collect();
        let layers = self.shell_layers.as_ref().map(shell_layers::memory);
        self.sizes.memory(copies, &frames).into_iter().chain(layers).collect()
    }

    /// Cells of a clustering's grid along each axis, in the frame written last.
    pub fn dimensions(&self, clustering: usize) -> [u32; 3] {
        self.clusterings[clustering].dimensions
    }

    /// The octree of the frame written last; `None` where the method has none.
    pub fn octree(&self) -> Option<&LinklessOctree> {
        self.octree.as_ref().and_then(HostOctree::octree)
    }

    /// How the octree was built in `frame`, the frame written last; `None` where it was not.
    pub fn octree_build(&self, frame: u32) -> Option<OctreeBuild> {
        self.octree.as_ref().and_then(|octree| octree.build(frame))
    }

    /// What is told of the octree of the frame written last; `None` where the method has none.
    pub fn octree_counts(&self) -> Option<OctreeCounts> {
        self.octree.as_ref().and_then(HostOctree::counts)
    }

    /// How it finds lights.
    pub fn method(&self) -> Method {
        self.method
    }

    /// Width and height of each view, pixels.
    pub fn resolution(&self) -> [u32; 2] {
        self.resolution
    }

    fn make_clusterings(&mut self, session: &Session) -> Result<()> {
        self.clusterings.clear();
        if let Some(octree) = &mut self.octree {
            octree.lost();
        }
        let slots = &session.frame_slots;
        let [lights, spots, mesh_frames, mesh_vertices, mesh_triangles] = self.lights.shared();
        let shared: [SharedBuffer; 12] = [
            (BufferName::Views, slots.each_ref().map(|slot| &slot.views)),
            (BufferName::DrawOrder, slots.each_ref().map(|slot| &slot.draw_order)),
            lights,
            spots,
            mesh_frames,
            mesh_vertices,
            mesh_triangles,
            (BufferName::Instances, [&session.scene.instances; FRAME_SLOTS]),
            (BufferName::ModelBoxes, [&session.scene.model_boxes; FRAME_SLOTS]),
            (BufferName::Drawables, [&session.scene.drawables; FRAME_SLOTS]),
            (BufferName::DrawCommands, [&session.draws.commands; FRAME_SLOTS]),
            (BufferName::DrawnInstances, [&session.draws.drawn_instances; FRAME_SLOTS]),
        ];
        let (sharing, views) = (self.method.kind().sharing, session.targets.len());
        for number in 0..sharing.clusterings(views) {
            let (views, pipelines) = (sharing.views_of(number, views), self.pipelines.all());
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
        (plan, lights): (&FramePlan, FrameLights),
        extend: (&mut Commands, &mut Commands),
    ) -> Result<()> {
        self.write_host_data(session, slot, plan, lights)?;
        session.frame_slots[slot].begin()?;
        let method = self.method;
        self.record(session, slot, |r, frame| {
            (extend.0)(r, frame);
            frame::record(r, frame, &method);
            (extend.1)(r, frame);
        });
        self.clusterings.iter_mut().for_each(|clustering| clustering.builds_boxes = false);
        if let Some(octree) = &mut self.octree {
            octree.submitted();
        }
        session.frame_slots[slot].submit()
    }

    /// Records and submits commands that belong to the frame last rendered in `slot`, and waits for them.
    pub fn follow_up(
        &mut self,
        session: &mut Session,
        slot: usize,
        commands: impl FnOnce(&mut Recorder, &Frame),
    ) -> Result<()> {
        session.frame_slots[slot].begin()?;
        self.record(session, slot, commands);
        session.frame_slots[slot].submit()?;
        session.frame_slots[slot].wait()
    }

    fn record(&mut self, session: &mut Session, slot: usize, body: impl FnOnce(&mut Recorder, &Frame)) {
        let this = &mut session.frame_slots[slot];
        let frame = Frame {
            pipelines: &self.pipelines,
            scene: &session.scene,
            draws: match self.culling {
                Culling::Cpu => Draws::Listed(&this.draw_lists),
                Culling::Gpu => Draws::Indirect {
                    drawables: &session.drawables,
                    orders: &this.drawable_orders,
                    buffers: &session.draws,
                },
            },
            targets: &session.targets,
            mirrored: &this.mirrored,
            clusterings: &self.clusterings,
            sharing: self.method.kind().sharing,
            multiview: self.multiview,
            clusters: self.clusters,
            bounds: self.bounds,
            normal_cones: self.normal_cones,
            compaction: self.compaction,
            lists: self.lists,
            marking: self.marking,
            assigner: self.assigner,
            cones: self.cones,
            shading: self.shading,
            pipeline: self.pipeline,
            shaded: self.shaded,
            lights: self.lights.upload(slot),
            shell_layers: self.shell_layers.as_ref(),
            octree: self.octree.as_ref().map(|octree| octree.tables(slot)),
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
            self.timed,
        );
        body(&mut recorder, &frame);
    }

    /// What the device found out in the frame that ended in `slot`.
    pub fn states(&self, session: &Session, slot: usize) -> Vec<ClusteringState> {
        session.frame_slots[slot].states.read(0, self.clusterings.len())
    }
}

/// Which scopes of frames get timestamps.
fn timed(scopes: Scopes) -> Timed {
    match scopes {
        Scopes::Frame => Timed::Frame,
        Scopes::All => Timed::Stages,
        Scopes::Passes => Timed::Passes,
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
