//! The octree over a frame's lights: built, or edited, on the host where they are others than those of the last frame, its tables on
//! their way to the device.
//!
//! ```text
//! lights, slack ──(changed)──> octree ──> sizes ──(more than there is room for)──> larger buffers
//!                                └──> what the device lacks ──> staging of the slot ──(frame)──> tables on the device
//! ```

use super::growth::with_margin;
use super::{Engine, FramePlan, Session};
use crate::buffers::BufferName;
use crate::clustering::FRAME_SLOTS;
use crate::geometry::LightVolume;
use crate::lights::FrameLights;
use crate::measure::{GrowthEvent, OctreeBuild, OctreeCounts, OctreeSizes};
use crate::methods::Method;
use crate::methods::hashed::{self, HashedMethod, OctreeWay, SceneGeometry};
use crate::octree::{
    BuildTimes, Dirty, DynamicOctree, LinklessOctree, OctreeError, OctreeGeometry, OctreeLimits,
    OctreeSettings,
};
use crate::passes::octree::{OctreeTables, Table};
use crate::vk::{Buffer, Context, Limits, Memory};
use crate::{Error, Result};
use ash::vk;
use bytemuck::Pod;
use glam::DVec3;
use std::ops::Range;
use std::sync::Arc;

/// What an octree was built of.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Basis {
    /// Revision of the lights.
    revision: u64,
    /// What was added to their radii, metres.
    slack: f64,
}

/// An octree.
enum Tree {
    /// That is built of lights and stays as it is.
    Built(LinklessOctree),
    /// That follows its lights.
    Kept(Box<DynamicOctree>),
}

impl Tree {
    fn tables(&self) -> &LinklessOctree {
        match self {
            Self::Built(octree) => octree,
            Self::Kept(octree) => octree.octree(),
        }
    }
}

/// An octree with what it was built of.
struct Standing {
    tree: Tree,
    of: Basis,
    /// The frame that asked for it first.
    frame: u32,
}

/// What a frame did to the octree.
#[derive(Debug, Clone, Copy, Default)]
struct Done {
    /// How often it built one as a whole.
    rebuilds: u64,
    /// Tables that it hashed.
    tables_hashed: u64,
    /// How long that took.
    times: BuildTimes,
}

/// The octree of an engine whose method has one.
pub(super) struct HostOctree {
    method: HashedMethod,
    way: OctreeWay,
    standing: Option<Standing>,
    /// The box around what the lights of a revision reach, world space, metres.
    bounds: Option<(u64, Option<(DVec3, DVec3)>)>,
    volumes: Vec<LightVolume>,
    /// Tables as the host writes them, for each frame in flight.
    staging: [[Buffer; Table::ALL.len()]; FRAME_SLOTS],
    /// What of the tables the device has not.
    lacking: Dirty,
    /// What the frame at hand did.
    done: Done,
    /// What it takes to the device, bytes.
    uploaded: u64,
}

impl HostOctree {
    /// Nothing yet, with room for tables of these sizes; `None` for a method without an octree.
    pub fn new(
        context: &Arc<Context>,
        (method, way): (Method, OctreeWay),
        room: &OctreeSizes,
    ) -> Result<Option<Self>> {
        let Method::Hashed(method) = method else { return Ok(None) };
        Ok(Some(Self {
            method,
            way,
            standing: None,
            bounds: None,
            volumes: vec![],
            staging: staging(context, room)?,
            lacking: Dirty::All,
            done: Done::default(),
            uploaded: 0,
        }))
    }

    /// Brings the octree to the lights of `frame`, whose slack is a function of how far they reach at most from `origin`.
    fn update(
        &mut self,
        (frame, lights): (u32, FrameLights),
        (origin, reach): (DVec3, f64),
        (surfaces, limits): (Option<&SceneGeometry>, &Limits),
    ) -> std::result::Result<(), OctreeError> {
        let slack = hashed::slack(reach + self.farthest(lights, origin));
        let wanted = Basis { revision: lights.revision, slack };
        self.done = Done::default();
        if self.standing.as_ref().is_some_and(|standing| standing.of == wanted) {
            return Ok(());
        }
        self.volumes.clear();
        self.volumes.extend(hashed::reaches(lights.list, slack));
        let room = hashed::largest_radius(lights.list);
        let settings = OctreeSettings {
            limits: octree_limits(limits),
            ..self.way.of(self.method.settings(lights.list), room)
        };
        let kept = self.standing.take().and_then(|standing| standing.kept(frame, slack, settings.node));
        let tree = match kept {
            Some(tree) => self.edit(tree)?,
            None => self.make(surfaces.and_then(|surfaces| surfaces.within(slack)), &settings)?,
        };
        self.standing = Some(Standing { tree, of: wanted, frame });
        Ok(())
    }

    /// The octree over what lights reach.
    fn make(
        &mut self,
        surfaces: Option<&OctreeGeometry>,
        settings: &OctreeSettings,
    ) -> std::result::Result<Tree, OctreeError> {
        let surfaces = surfaces.filter(|_| self.way == OctreeWay::Geometry);
        let (tree, times) = match (self.way, surfaces) {
            (OctreeWay::Dynamic(_), _) => {
                let octree = DynamicOctree::new(&self.volumes, settings)?;
                let times = octree.times();
                (Tree::Kept(octree.into()), times)
            }
            (_, Some(surfaces)) => {
                let built = LinklessOctree::build_for(&self.volumes, surfaces, settings)?;
                (Tree::Built(built.octree), built.times)
            }
            (_, None) => {
                let built = LinklessOctree::build(&self.volumes, settings)?;
                (Tree::Built(built.octree), built.times)
            }
        };
        self.lacking = Dirty::All;
        self.done = Done { rebuilds: 1, tables_hashed: tree.tables().table_count(), times };
        Ok(tree)
    }

    /// The octree that was kept, over what lights reach.
    fn edit(&mut self, mut octree: Box<DynamicOctree>) -> std::result::Result<Tree, OctreeError> {
        let report = octree.update(&self.volumes)?;
        let (rebuilds, tables_hashed) = match report.anew {
            true => (1, octree.octree().table_count()),
            false => (0, report.rebuilt as u64),
        };
        self.done = Done { rebuilds, tables_hashed, times: octree.times() };
        // What the last frame lacks and has not got is lost: all of it serves, too.
        self.lacking = if self.lacking.is_empty() { report.dirty } else { Dirty::All };
        Ok(Tree::Kept(octree))
    }

    /// How far from the frame's origin a corner of the box around what lights reach is at most, metres.
    fn farthest(&mut self, lights: FrameLights, origin: DVec3) -> f64 {
        if self.bounds.is_none_or(|(revision, _)| revision != lights.revision) {
            self.bounds = Some((lights.revision, hashed::bounds(lights.list)));
        }
        let corners = self.bounds.and_then(|(_, bounds)| bounds);
        corners.map_or(0.0, |(low, high)| (low - origin).abs().max((high - origin).abs()).length())
    }

    /// The octree of the frame at hand.
    pub fn octree(&self) -> Option<&LinklessOctree> {
        self.standing.as_ref().map(|standing| standing.tree.tables())
    }

    /// Entries of its tables.
    fn sizes(&self) -> OctreeSizes {
        self.octree().map_or_else(OctreeSizes::default, hashed::table_sizes)
    }

    /// Writes what the device has not, for the frame in `slot`.
    fn stage(&mut self, slot: usize) {
        let sizes = self.sizes();
        let bytes = |table: Table| table.lacking_bytes(&self.lacking, &sizes);
        self.uploaded = Table::ALL.into_iter().map(bytes).sum();
        let Some(octree) = self.standing.as_ref().map(|standing| standing.tree.tables()) else { return };
        for (table, buffer) in Table::ALL.into_iter().zip(&self.staging[slot]) {
            let parts = table.parts_of(&self.lacking);
            match table {
                Table::Nodes => write_parts(buffer, &octree.structure, parts),
                Table::Leaves => write_parts(buffer, &octree.leaves, parts),
                Table::Offsets => write_parts(buffer, &octree.offsets, parts),
                Table::Indices => write_parts(buffer, &octree.indices, parts),
            }
        }
    }

    /// Notes that the frame was submitted: the device will have the tables.
    pub fn submitted(&mut self) {
        self.lacking = Dirty::default();
    }

    /// Notes that the device's buffers were made anew: they hold nothing.
    pub fn lost(&mut self) {
        self.lacking = Dirty::All;
    }

    /// What the frame in `slot` is recorded from.
    pub fn tables(&self, slot: usize) -> OctreeTables<'_> {
        OctreeTables {
            staging: &self.staging[slot],
            sizes: self.sizes(),
            lacking: &self.lacking,
            times: self.done.times,
        }
    }

    /// How the octree was built in `frame`, the frame at hand; `None` where it was not.
    pub fn build(&self, frame: u32) -> Option<OctreeBuild> {
        let octree = self.octree().filter(|_| self.done.rebuilds > 0)?;
        let (lights, nodes) = (self.volumes.len() as u64, octree.nodes());
        Some(OctreeBuild { frame, lights, nodes, times: self.done.times })
    }

    /// What is told of the frame at hand.
    pub fn counts(&self) -> Option<OctreeCounts> {
        let standing = self.standing.as_ref()?;
        let Done { rebuilds, tables_hashed, .. } = self.done;
        let tables = if rebuilds > 0 { hashed::told_tables(standing.tree.tables()) } else { vec![] };
        let extra_indices = match &standing.tree {
            Tree::Built(_) => 0,
            Tree::Kept(octree) => octree.extra_indices(),
        };
        let (sizes, uploaded) = (self.sizes(), self.uploaded);
        Some(OctreeCounts { rebuilds, tables_hashed, uploaded, extra_indices, sizes, tables })
    }
}

impl Standing {
    /// The octree where it may be edited for `frame`, with deepest nodes of `node` metres: one that is kept, but what a frame shows
    /// is a function of the frames before it alone, so that one that comes again begins anew.
    fn kept(self, frame: u32, slack: f64, node: f64) -> Option<Box<DynamicOctree>> {
        let Tree::Kept(octree) = self.tree else { return None };
        let serves = self.frame < frame && self.of.slack == slack && octree.octree().frame.node == node;
        serves.then_some(octree)
    }
}

/// Writes parts of values to their places in a buffer, or all of them.
fn write_parts<T: Pod>(buffer: &Buffer, values: &[T], parts: Option<&[Range<usize>]>) {
    match parts {
        None => buffer.write(0, values),
        Some(parts) => parts.iter().for_each(|part| {
            buffer.write((part.start * size_of::<T>()) as u64, &values[part.clone()]);
        }),
    }
}

impl Engine {
    /// Builds the octree over a frame's lights where it is another, makes room for it and writes it for the frame in `slot`.
    pub(super) fn write_octree(
        &mut self,
        session: &mut Session,
        slot: usize,
        (plan, lights): (&FramePlan, FrameLights),
    ) -> Result<()> {
        let Some(octree) = &mut self.octree else { return Ok(()) };
        let (origin, reach) = (plan.origin(), session.scene.reach);
        let eyes = plan.views.iter().map(|view| view.eye().distance(origin)).fold(reach, f64::max);
        let by = (session.surfaces.as_ref(), &session.context.limits);
        octree.update((plan.frame, lights), (origin, reach + eyes), by).map_err(|error| {
            Error::input(format!("method {} at frame {}: {error}", self.method, plan.frame))
        })?;
        let sizes = octree.sizes();
        self.make_room(session, sizes, plan.frame)?;
        let Some(octree) = &mut self.octree else { return Ok(()) };
        octree.stage(slot);
        if let Some(standing) = octree.octree() {
            let data = hashed::data(standing, origin);
            self.clusterings.iter().for_each(|this| this.host[slot][BufferName::Octree].write(0, &[data]));
        }
        Ok(())
    }

    /// Grows tables that are too small, before the frame. What is there at first is as large as the first octree, or, of one that is
    /// kept, a little larger.
    fn make_room(&mut self, session: &Session, mut needed: OctreeSizes, frame: u32) -> Result<()> {
        let kept = self.octree.as_ref().is_some_and(|octree| matches!(octree.way, OctreeWay::Dynamic(_)));
        let mut room = self.sizes.capacities.octree;
        let mut most = self.sizes.most(&session.context.limits).octree;
        let mut grown = vec![];
        for ((buffer, needed), ((_, room), (_, most))) in
            needed.named().into_iter().zip(room.named().into_iter().zip(most.named()))
        {
            if *needed > *room {
                let from = *room;
                // What is kept grows.
                *room = if from == 0 && !kept { *needed } else { with_margin(*needed, *most) };
                grown.push(GrowthEvent { frame, clustering: 0, buffer: buffer.to_owned(), from, to: *room });
            }
        }
        if grown.is_empty() {
            return Ok(());
        }
        session.context.wait_idle()?;
        self.growth.extend(grown.into_iter().filter(|event| event.from > 0));
        self.sizes.capacities.octree = room;
        if let Some(octree) = &mut self.octree {
            octree.staging = staging(&session.context, &room)?;
        }
        self.make_clusterings(session)
    }
}

/// Room for tables as the host writes them.
fn staging(context: &Arc<Context>, room: &OctreeSizes) -> Result<[[Buffer; Table::ALL.len()]; FRAME_SLOTS]> {
    let of = |table: Table| {
        let usage = vk::BufferUsageFlags::TRANSFER_SRC;
        Buffer::new(context, "octree staging", table.bytes(room).max(16), usage, Memory::Upload)
    };
    let all = || -> Result<_> {
        Ok([of(Table::Nodes)?, of(Table::Leaves)?, of(Table::Offsets)?, of(Table::Indices)?])
    };
    Ok([all()?, all()?])
}

/// What the device's buffers hold of an octree.
fn octree_limits(limits: &Limits) -> OctreeLimits {
    let texels = limits.max_texel_buffer_elements;
    // A leaf takes eight bytes.
    let entries = |bytes: u64| {
        usize::try_from(texels.min(limits.max_storage_buffer_range / bytes)).unwrap_or(usize::MAX)
    };
    OctreeLimits { indices: entries(4), slots: entries(8) }
}
