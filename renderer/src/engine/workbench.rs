//! A device with one planned frame on which single passes run, fed and read by hand: for tests and for the self-test.

use super::kept::KeptLists;
use super::{Engine, FramePlan, LargestGrid, Mode, Session, variant};
use crate::Result;
use crate::assign::Assigner;
use crate::buffers::BufferName;
use crate::config::Config;
use crate::geometry::views::{View, ViewSet};
use crate::geometry::{Frustum, Grid};
use crate::gpu_interface::{ClusteringState, GridData};
use crate::lights::{FrameLights, Light, LightTally};
use crate::measure::Capacities;
use crate::methods::Method;
use crate::methods::grid::{compact, light_lists};
use crate::pass::{BufferCopy, Faults, Recorder};
use crate::passes::{Frame, VisibleClusters, lights as light_upload, readback};
use crate::pipelines::Variant;
use crate::scene::Scene;
use crate::vk::{Buffer, Memory};
use ash::vk;
use std::mem::offset_of;

/// The views of a workbench.
pub const ONE_VIEW: ViewSet = ViewSet { count: 1, mirrors: false };

/// The frame in flight that a workbench uses.
const SLOT: usize = 0;

/// What is put on a workbench.
#[derive(Clone, Copy)]
pub struct Case<'a> {
    /// Whose passes run; one of grids.
    pub method: Method,
    /// The grid of the one clustering.
    pub grid: Grid,
    /// World space.
    pub lights: &'a [Light],
    /// What the buffers hold.
    pub capacities: Capacities,
}

/// Whether there is room for the bits of lists and the lights of groups; where there is none, lights are counted and
/// sorted, and each group tests all candidates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Room {
    /// For all of them.
    Plenty,
    /// For none.
    None,
}

/// Light lists: their offsets, then their lights.
#[derive(Debug, PartialEq, Eq)]
pub struct Lists {
    /// Where each list begins, and where the last one ends.
    pub offsets: Vec<u32>,
    /// The lights.
    pub indices: Vec<u32>,
}

impl Lists {
    /// The lights of one list.
    pub fn of(&self, list: usize) -> &[u32] {
        &self.indices[self.offsets[list] as usize..self.offsets[list + 1] as usize]
    }
}

/// A device with one planned frame of one view.
pub struct Workbench {
    /// Its one clustering counts.
    pub engine: Engine,
    /// Of one view.
    pub session: Session,
    /// What its shaders are specialised for.
    pub variant: Variant,
    words: u64,
    revision: u64,
}

impl Workbench {
    /// A device with a scene, and `case` on it; the way of assignment and the test are the configuration's.
    ///
    /// # Errors
    /// No device, or one that cannot do this.
    pub fn new(config: &Config, scene: &Scene, case: Case, faults: Faults) -> Result<Self> {
        let mut session = Session::new(config, scene, ONE_VIEW)?;
        session.tracker.faults = faults;
        Self::on(session, config, case)
    }

    /// Another case, which may be of another size, on the same device.
    ///
    /// # Errors
    /// The device cannot do this.
    pub fn replace(self, config: &Config, case: Case) -> Result<Self> {
        let Self { engine, session, .. } = self;
        drop(engine);
        Self::on(session, config, case)
    }

    /// A case on the device of a session of one view.
    ///
    /// # Errors
    /// The device cannot do this.
    pub fn on(mut session: Session, config: &Config, case: Case) -> Result<Self> {
        let Case { method, grid, lights, capacities } = case;
        let plan = frame_of(grid, config.resolution);
        let assigner = config.assign[0].fixed().unwrap_or(Assigner::Brute);
        let run = Config { methods: vec![method], ..config.clone() };
        let mode = Mode { lights: LightTally::of(lights), capacities, assigner, counting: true };
        let largest = LargestGrid::of(std::slice::from_ref(&plan));
        let engine = Engine::new(&mut session, &run, largest, mode)?;
        let (variant, words) = (variant(&run, &mode), grid.cluster_count().div_ceil(32));
        let mut this = Self { engine, session, variant, words, revision: 0 };
        this.write(&plan, lights)?;
        Ok(this)
    }

    /// Writes what a frame is made from, with other lights than before.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn write(&mut self, plan: &FramePlan, list: &[Light]) -> Result<()> {
        self.revision += 1;
        let lights = FrameLights { list, revision: self.revision };
        self.engine.write_host_data(&mut self.session, SLOT, plan, lights)
    }

    /// Leaves no room for bits of lists and lights of groups, until lights are written again.
    pub fn leave(&mut self, room: Room) {
        if room == Room::None {
            let grid = &self.engine.clusterings[0].host[SLOT][BufferName::Grid];
            grid.write(offset_of!(GridData, mask_capacity) as u64, &[0u32]);
            grid.write(offset_of!(GridData, group_capacity) as u64, &[0u32]);
        }
    }

    /// Runs passes and waits for them.
    ///
    /// # Errors
    /// Whatever fails on the device; a validation message.
    pub fn run(&mut self, commands: impl FnOnce(&mut Recorder, &Frame)) -> Result<()> {
        self.engine.follow_up(&mut self.session, SLOT, commands)?;
        self.session.context.check_validation()
    }

    /// Fills the first words of one of the clustering's buffers from the host.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn upload(&mut self, name: BufferName, data: &[u32]) -> Result<()> {
        let (usage, size) = (vk::BufferUsageFlags::TRANSFER_SRC, 4 * data.len() as u64);
        let source = Buffer::new(&self.session.context, "workbench upload", size, usage, Memory::Upload)?;
        source.write(0, data);
        self.run(|r, frame| {
            let to = &frame.clusterings[0].buffers[name];
            r.copy(&BufferCopy { from: &source, to, offset: 0, size });
        })
    }

    /// The first `words` words of one of the clustering's buffers.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn download(&mut self, name: BufferName, words: usize) -> Result<Vec<u32>> {
        let (usage, size) = (vk::BufferUsageFlags::TRANSFER_DST, 4 * words as u64);
        let target = Buffer::new(&self.session.context, "workbench download", size, usage, Memory::Readback)?;
        self.run(|r, frame| {
            let from = &frame.clusterings[0].buffers[name];
            r.copy(&BufferCopy { from, to: &target, offset: 0, size });
            r.hand_over(&target);
        })?;
        Ok(target.read(0, words))
    }

    /// What the device has found out.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn state(&mut self) -> Result<ClusteringState> {
        self.run(readback::states)?;
        Ok(self.engine.states(&self.session, SLOT)[0])
    }

    /// Marks clusters, a bit each, compacts them, and gives the device's state.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn compact(&mut self, bits: &[u32]) -> Result<ClusteringState> {
        assert_eq!(bits.len() as u64, self.words, "a bit a cluster");
        self.upload(BufferName::ClusterBits, bits)?;
        self.run(|r, frame| {
            compact(r, frame, 0);
        })?;
        self.state()
    }

    /// The lists of the clusters that [`Self::compact`] made visible, by ascending cluster.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn lists(&mut self) -> Result<Lists> {
        self.run(|r, frame| {
            let lights = light_upload::record(r, frame);
            light_lists(r, frame, lights, given());
        })?;
        self.kept_lists()
    }

    /// The lists that are there, by ascending cluster.
    fn kept_lists(&mut self) -> Result<Lists> {
        let state = self.state()?;
        let words = KeptLists::words(&self.engine.sizes, &state);
        let names = [
            BufferName::VisibleClusters,
            BufferName::ListOffsets,
            BufferName::ListLengths,
            BufferName::LightIndices,
        ];
        let mut parts: [Vec<u32>; 4] = Default::default();
        for ((name, words), part) in names.into_iter().zip(words).zip(&mut parts) {
            if words > 0 {
                *part = self.download(name, words as usize)?;
            }
        }
        let [clusters, offsets, lengths, indices] = parts.each_ref().map(Vec::as_slice);
        let kept = KeptLists { sizes: &self.engine.sizes, clusters, offsets, lengths, indices };
        let (offsets, indices) = kept.in_order(&kept.order());
        Ok(Lists { offsets, indices })
    }

    /// GPU milliseconds of each stage of the commands that ran last, with its path.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn stage_times(&mut self) -> Result<Vec<(String, f64)>> {
        let tree = &self.engine.tree;
        let times = self.session.frame_slots[SLOT].timestamps.read()?;
        Ok(times.map(|time| (tree.path(time.scope).to_owned(), time.gpu_ms)).collect())
    }
}

/// The visible clusters that were put on a workbench.
pub fn given() -> VisibleClusters {
    VisibleClusters::given(0)
}

/// A frame of one view that looks from where `grid` does.
pub fn frame_of(grid: Grid, resolution: [u32; 2]) -> FramePlan {
    let [width, height] = resolution.map(f64::from);
    let (x, y) = (0.76, 0.76 * height / width);
    let frustum = Frustum { x0: -x, x1: x, y0: -y, y1: y, z0: -100.0, z1: -0.4 };
    FramePlan { frame: 0, views: vec![View { pose: grid.pose, frustum }], grids: vec![grid] }
}
