//! The octree over a frame's lights: built on the host where they are others than those of the last frame, its tables on their way to
//! the device.
//!
//! ```text
//! lights, slack ──(changed)──> octree ──> sizes ──(more than there is room for)──> larger buffers
//!                                └──> staging of the slot ──(frame)──> tables on the device
//! ```

use super::growth::with_margin;
use super::{Engine, FramePlan, Session};
use crate::buffers::BufferName;
use crate::clustering::FRAME_SLOTS;
use crate::lights::FrameLights;
use crate::measure::{GrowthEvent, OctreeBuild, OctreeCounts, OctreeSizes};
use crate::methods::Method;
use crate::methods::hashed::{self, HashedMethod, OctreeWay, SceneGeometry};
use crate::octree::{BuildTimes, LinklessOctree, OctreeError, OctreeLimits, OctreeSettings, Sphere};
use crate::passes::octree::{OctreeTables, Table};
use crate::vk::{Buffer, Context, Limits, Memory};
use crate::{Error, Result};
use ash::vk;
use glam::DVec3;
use std::sync::Arc;

/// What an octree was built of.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Basis {
    /// Revision of the lights.
    revision: u64,
    /// What was added to their radii, metres.
    slack: f64,
}

/// An octree with what it was built of.
struct Standing {
    octree: LinklessOctree,
    of: Basis,
}

/// The octree of an engine whose method has one.
pub(super) struct HostOctree {
    method: HashedMethod,
    way: OctreeWay,
    standing: Option<Standing>,
    /// The box around what the lights of a revision reach, world space, metres.
    bounds: Option<(u64, Option<(DVec3, DVec3)>)>,
    spheres: Vec<Sphere>,
    /// Tables as the host writes them, for each frame in flight.
    staging: [[Buffer; Table::ALL.len()]; FRAME_SLOTS],
    /// Whether the device has the tables.
    pub there: bool,
    /// How often the frame at hand built an octree.
    rebuilds: u64,
    /// How long that took.
    times: BuildTimes,
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
            spheres: vec![],
            staging: staging(context, room)?,
            there: false,
            rebuilds: 0,
            times: BuildTimes::default(),
        }))
    }

    /// Brings the octree to a frame's lights, whose slack is a function of how far they reach at most from `origin`.
    fn update(
        &mut self,
        lights: FrameLights,
        (origin, reach): (DVec3, f64),
        (surfaces, limits): (Option<&SceneGeometry>, &Limits),
    ) -> std::result::Result<(), OctreeError> {
        let slack = hashed::slack(reach + self.farthest(lights, origin));
        let wanted = Basis { revision: lights.revision, slack };
        (self.rebuilds, self.times) = (0, BuildTimes::default());
        if self.standing.as_ref().is_some_and(|standing| standing.of == wanted) {
            return Ok(());
        }
        self.spheres.clear();
        self.spheres.extend(hashed::reaches(lights.list, slack));
        let settings = OctreeSettings {
            limits: octree_limits(limits),
            ..self.way.of(self.method.settings(lights.list))
        };
        let surfaces = surfaces.filter(|_| self.way == OctreeWay::Geometry);
        let built = match surfaces.and_then(|surfaces| surfaces.within(slack)) {
            Some(triangles) => LinklessOctree::build_for(&self.spheres, triangles, &settings)?,
            None => LinklessOctree::build(&self.spheres, &settings)?,
        };
        self.standing = Some(Standing { octree: built.octree, of: wanted });
        (self.rebuilds, self.times, self.there) = (1, built.times, false);
        Ok(())
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
        self.standing.as_ref().map(|standing| &standing.octree)
    }

    /// Entries of its tables.
    fn sizes(&self) -> OctreeSizes {
        self.octree().map_or_else(OctreeSizes::default, hashed::table_sizes)
    }

    /// Writes what the device has not, for the frame in `slot`.
    fn stage(&self, slot: usize) {
        let Some(octree) = self.octree().filter(|_| !self.there) else { return };
        for (table, buffer) in Table::ALL.into_iter().zip(&self.staging[slot]) {
            match table {
                Table::Nodes => buffer.write(0, &octree.structure),
                Table::Leaves => buffer.write(0, &octree.leaves),
                Table::Offsets => buffer.write(0, &octree.offsets),
                Table::Indices => buffer.write(0, &octree.indices),
            }
        }
    }

    /// What the frame in `slot` is recorded from.
    pub fn tables(&self, slot: usize) -> OctreeTables<'_> {
        OctreeTables {
            staging: &self.staging[slot],
            sizes: self.sizes(),
            wanted: !self.there && self.octree().is_some(),
            times: self.times,
        }
    }

    /// How the octree was built in `frame`, the frame at hand; `None` where it was not.
    pub fn build(&self, frame: u32) -> Option<OctreeBuild> {
        let octree = self.octree().filter(|_| self.rebuilds > 0)?;
        let (lights, nodes) = (self.spheres.len() as u64, octree.nodes());
        Some(OctreeBuild { frame, lights, nodes, times: self.times })
    }

    /// What is told of the frame at hand.
    pub fn counts(&self) -> Option<OctreeCounts> {
        let octree = self.octree()?;
        let tables = if self.rebuilds > 0 { hashed::told_tables(octree) } else { vec![] };
        Some(OctreeCounts { rebuilds: self.rebuilds, sizes: self.sizes(), tables })
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
        octree.update(lights, (origin, reach + eyes), by).map_err(|error| {
            Error::input(format!("method {} at frame {}: {error}", self.method, plan.frame))
        })?;
        let sizes = octree.sizes();
        self.make_room(session, sizes, plan.frame)?;
        let Some(octree) = &self.octree else { return Ok(()) };
        octree.stage(slot);
        if let Some(standing) = octree.octree() {
            let data = hashed::data(standing, origin);
            self.clusterings.iter().for_each(|this| this.host[slot][BufferName::Octree].write(0, &[data]));
        }
        Ok(())
    }

    /// Grows tables that are too small, before the frame. What is there at first is as large as the first octree.
    fn make_room(&mut self, session: &Session, mut needed: OctreeSizes, frame: u32) -> Result<()> {
        let mut room = self.sizes.capacities.octree;
        let mut most = self.sizes.most(&session.context.limits).octree;
        let mut grown = vec![];
        for ((buffer, needed), ((_, room), (_, most))) in
            needed.named().into_iter().zip(room.named().into_iter().zip(most.named()))
        {
            if *needed > *room {
                let from = *room;
                *room = if from == 0 { *needed } else { with_margin(*needed, *most) };
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
