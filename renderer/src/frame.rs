//! The frame: which passes run, in which order, for every method. Nothing is reordered, so what is written
//! here is what is measured.

use crate::assign::Assigner;
use crate::clustering::Clustering;
use crate::config::Marking;
use crate::draw_list::DrawList;
use crate::draw_slots::{DrawSlots, SlotOrder};
use crate::gpu_scene::GpuScene;
use crate::layouts::Layouts;
use crate::pass::Recorder;
use crate::passes::{assign, cull, depth, hierarchy, lights, mark, readback, resolve, scan, shade};
use crate::pipelines::Pipelines;
use crate::vk::{Buffer, Image};
use ash::vk;

/// Frames in flight.
pub const SLOTS: usize = 2;

/// What a view is rendered into.
pub struct ViewTargets {
    /// Reversed depth.
    pub depth: Image,
    /// Linear HDR colour, with all its samples.
    pub color: Image,
    /// Colour with one sample; `None` where `color` has no more.
    pub resolved: Option<Image>,
    /// `depth`, for compute shaders.
    pub depth_set: vk::DescriptorSet,
}

/// What stage `cull` fills, a part for each view; shared by the frames in flight.
pub struct DrawBuffers {
    /// [`crate::gpu_interface::DrawCommand`], as many in each part as there are slots.
    pub commands: Buffer,
    /// Instances that the commands draw.
    pub drawn_instances: Buffer,
}

/// What the views draw of the scene.
pub enum Draws<'a> {
    /// What the host let through, a list for each view.
    Listed(&'a [DrawList]),
    /// Everything, by commands that stage `cull` fills.
    Indirect {
        /// The scene's.
        slots: &'a DrawSlots,
        /// An order for each view.
        orders: &'a [SlotOrder],
        /// The commands.
        buffers: &'a DrawBuffers,
    },
}

/// Everything one frame is recorded from. All of it stays as it is until the frame has ended.
pub struct Frame<'a> {
    /// Descriptor set and pipeline layouts.
    pub layouts: &'a Layouts,
    /// Pipelines of the method.
    pub pipelines: &'a Pipelines,
    /// What is drawn.
    pub scene: &'a GpuScene,
    /// What each view draws of it.
    pub draws: Draws<'a>,
    /// What each view is rendered into.
    pub targets: &'a [ViewTargets],
    /// The clusterings; for a method without, one that holds every view and no grid.
    pub clusterings: &'a [Clustering],
    /// Whether the clusterings have grids.
    pub clustered: bool,
    /// Marking strategy.
    pub marking: Marking,
    /// How the light lists are built.
    pub assigner: Assigner,
    /// The lights on the device.
    pub lights: &'a Buffer,
    /// The lights as the host wrote them.
    pub light_staging: &'a Buffer,
    /// How many.
    pub light_count: u32,
    /// Where the host finds each clustering's state.
    pub states: &'a Buffer,
    /// Width and height of each view, pixels.
    pub resolution: [u32; 2],
    /// Which of the frames in flight this is.
    pub slot: usize,
}

impl Frame<'_> {
    /// The clustering in which a view looks its lights up.
    pub fn clustering_of_view(&self, view: usize) -> usize {
        self.clusterings
            .iter()
            .position(|clustering| clustering.views.contains(&view))
            .expect("every view belongs to a clustering")
    }
}

/// Records the whole frame.
pub fn record(r: &mut Recorder, frame: &Frame) {
    r.scope("frame", |r| {
        lights::record(r, frame);
        for view in 0..frame.targets.len() {
            cull::record(r, frame, view);
        }
        if frame.clustered {
            for clustering in 0..frame.clusterings.len() {
                r.scope(("cluster", clustering), |r| cluster(r, frame, clustering));
            }
        } else {
            for view in 0..frame.targets.len() {
                depth::record(r, frame, view);
            }
        }
        for view in 0..frame.targets.len() {
            shade::record(r, frame, view);
        }
        resolve::record(r, frame);
        readback::states(r, frame);
    });
}

fn cluster(r: &mut Recorder, frame: &Frame, clustering: usize) {
    let views = frame.clusterings[clustering].views.clone();
    for view in views.clone() {
        depth::record(r, frame, view);
    }
    for view in views {
        mark::record(r, frame, clustering, view);
    }
    scan::compact(r, frame, clustering);
    assign::transform_lights(r, frame, clustering);
    if frame.assigner == Assigner::Hierarchy {
        hierarchy::build_hierarchy(r, frame, clustering);
    }
    assign::count_lights(r, frame, clustering);
    scan::light_offsets(r, frame, clustering);
    assign::assign_lights(r, frame, clustering);
}
