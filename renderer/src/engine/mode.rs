//! What an engine is made for, and what follows from it: shader variants and buffer sizes.

use super::FramePlan;
use super::lights::Room;
use crate::assign::{
    Assigner, ClusterBounds, Clusters, Compaction, Conservative, ListStore, MeshDetail, NODES_PER_CLUSTER,
    check_layered_slices, check_links, check_one_pass, check_sorted_slices, check_sorted_tiles,
};
use crate::buffers::ClusteringSizes;
use crate::config::Config;
use crate::geometry::{ConeTest, NormalCones, SliceLaw, VolumeTest};
use crate::lights::LightTally;
use crate::measure::Capacities;
use crate::methods::model::MOST_ACCELERATED;
use crate::methods::{Groups, Method};
use crate::pipelines::{Variant, lights_at_once};
use crate::{Error, Result, geometry::Grid};

/// The largest grid that an engine may meet: what its buffers are made for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LargestGrid {
    /// Most clusters of a grid.
    pub clusters: u64,
    /// Most tiles of a grid: clusters along x times those along y.
    pub tiles: u64,
    /// Most of them along x, and most along y.
    pub sides: [u32; 2],
    /// Most depths between slices of a grid.
    pub slice_planes: u32,
}

impl LargestGrid {
    /// The largest grid of planned frames.
    pub fn of(plans: &[FramePlan]) -> Self {
        let largest = |all: Self, grid: &Grid| Self {
            clusters: all.clusters.max(grid.cluster_count()),
            tiles: all.tiles.max(grid.dimensions[..2].iter().map(|&count| u64::from(count)).product()),
            sides: [0, 1].map(|axis| all.sides[axis].max(grid.dimensions[axis])),
            slice_planes: all.slice_planes.max(grid.dimensions[2] + 1),
        };
        plans.iter().flat_map(|plan| &plan.grids).fold(Self::default(), largest)
    }

    /// Refuses a frame with a larger grid.
    ///
    /// # Errors
    /// Says how large it is, and how large it may be.
    pub fn check(&self, plan: &FramePlan) -> Result<()> {
        let Self { clusters, tiles, slice_planes, .. } = Self::of(std::slice::from_ref(plan));
        if clusters <= self.clusters && tiles <= self.tiles && slice_planes <= self.slice_planes {
            return Ok(());
        }
        Err(Error::Input(format!(
            "frame {} needs a grid of {clusters} clusters, {tiles} tiles in {} slices, more than the {}, {} in {} that buffers were made \
             for: use larger clusters, or plan this frame too",
            plan.frame,
            slice_planes.saturating_sub(1),
            self.clusters,
            self.tiles,
            self.slice_planes.saturating_sub(1),
        )))
    }
}

/// What an engine is made for beyond the configuration of its run.
#[derive(Debug, Clone, Copy)]
pub struct Mode {
    /// Most lights of all frames, and whether some have cones.
    pub lights: LightTally,
    /// What the buffers hold at first.
    pub capacities: Capacities,
    /// How the lists are built.
    pub assigner: Assigner,
    /// Whether everything is counted: the atemporal run.
    pub counting: bool,
}

impl Mode {
    /// Brute force with the capacities that `config` begins with, counting.
    pub fn counting(config: &Config, lights: LightTally) -> Self {
        Self { lights, capacities: config.capacities(), assigner: Assigner::Brute, counting: true }
    }
}

/// What one run's configuration says of its method, with the mode: the values on the axes.
pub(super) struct Chosen {
    pub method: Method,
    pub assigner: Assigner,
    pub clusters: Clusters,
    pub bounds: ClusterBounds,
    pub normal_cones: NormalCones,
    pub compaction: Compaction,
    pub lists: ListStore,
    /// Side of the tiles that are sorted, pixels; 0 where none are.
    sorted_tile: u32,
    slices: SliceLaw,
    test: VolumeTest,
    mesh_detail: MeshDetail,
    conservative: Conservative,
}

impl Chosen {
    /// What an engine needs of a run's configuration, which has one value on every axis.
    pub fn of(run: &Config, mode: &Mode) -> Self {
        let method = run.methods[0];
        let assigns = method.assigns();
        let clusters = method.listed(run.clusters[0].of(&method));
        let compaction = match clusters {
            Clusters::Visible => run.compaction[0],
            Clusters::All => Compaction::Ranks,
        };
        let bounds = method.kept_bounds(run.bounds[0].of(&method));
        let sorted = method.tile_pixels(run.resolution).filter(|_| compaction == Compaction::Sort);
        Self {
            method,
            assigner: match (assigns, method.rasterising()) {
                (true, Some(rasterising)) => rasterising,
                (true, None) => mode.assigner,
                (false, _) => Assigner::Brute,
            },
            clusters,
            compaction,
            sorted_tile: sorted.map_or(0, |pixels| pixels as u32),
            lists: if assigns { run.lists[0] } else { ListStore::Offsets },
            bounds,
            normal_cones: match bounds {
                ClusterBounds::Cell => NormalCones::OFF,
                ClusterBounds::Depth | ClusterBounds::Box => run.normal_cones[0],
            },
            slices: run.slices[0].of(&method),
            test: run.test[0].of(&method),
            mesh_detail: run.mesh_detail[0],
            conservative: run.conservative[0],
        }
    }

    /// The largest grid of a run whose planned ones are at most `planned`, over a scene of so many models.
    pub fn largest(&self, planned: LargestGrid, models: u32) -> LargestGrid {
        let clusters = if self.method == Method::Models { models.max(1).into() } else { planned.clusters };
        LargestGrid { clusters, ..planned }
    }

    /// Refuses a grid whose tiles, of `samples` a pixel, cannot be sorted where that is asked for, on a device with so many bytes of
    /// memory a workgroup.
    ///
    /// # Errors
    /// Says what there is, and what there may be.
    pub fn check_grid(&self, largest: LargestGrid, samples: u32, shared: u32) -> Result<()> {
        if self.sorted_tile > 0 {
            check_sorted_slices(largest.slice_planes.saturating_sub(1)).map_err(Error::Input)?;
            check_sorted_tiles(self.sorted_tile, samples, shared).map_err(Error::Input)?;
        }
        let slices = largest.slice_planes.saturating_sub(1);
        if self.has_layers() {
            check_layered_slices(self.conservative, slices).map_err(Error::Input)
        } else {
            Ok(())
        }
    }

    /// Whether meshes are drawn into layers of images.
    pub fn has_layers(&self) -> bool {
        self.assigner == Assigner::Raster && self.conservative.has_layers()
    }

    /// Refuses more models, or more lights, than the way of assignment serves.
    ///
    /// # Errors
    /// Says how many there are, and how many there may be.
    pub fn check(&self, models: u32, lights: u32) -> Result<()> {
        if self.method.assigns() {
            check_links(self.lists, &self.method, lights).map_err(Error::Input)?;
        }
        if self.assigner == Assigner::Brute {
            check_one_pass(self.lists, lights).map_err(Error::Input)?;
        }
        if self.method != Method::Models || self.assigner == Assigner::Brute || models <= MOST_ACCELERATED {
            return Ok(());
        }
        Err(Error::input(format!(
            "method {}: assignment by {} serves up to {MOST_ACCELERATED} models, and the scene has {models}: use --assign brute",
            self.method, self.assigner
        )))
    }

    /// What is kept of lights.
    pub fn room(&self, mode: &Mode) -> Room {
        Room { tally: mode.lights, meshes: self.assigner.rasterises().then_some(self.mesh_detail) }
    }

    /// What is asked of cones; nothing where no light has one.
    pub fn cones(&self, mode: &Mode) -> ConeTest {
        if mode.lights.spots { self.test.cone } else { ConeTest::Unasked }
    }

    /// Whether the boxes around cells are tested.
    fn keeps_boxes(&self) -> bool {
        let cells = self.method.kind().cells();
        !self.assigner.rasterises() && cells.is_some_and(|cells| cells.keeps_boxes(self.test.sphere))
    }

    /// What the shaders of the engine are specialised for.
    pub fn variant(&self, run: &Config, mode: &Mode) -> Variant {
        let kind = self.method.kind();
        Variant {
            lookup: kind.lookup,
            groups: kind.groups,
            sharing: kind.sharing,
            clusters: self.clusters,
            bounds: self.bounds,
            normal_cones: self.normal_cones,
            compaction: self.compaction,
            sorted_tile: self.sorted_tile,
            lists: self.lists,
            slices: self.slices,
            adds_bias: self.method.adds_bias(),
            samples: run.msaa,
            culling: run.culling,
            multiview: run.multiview,
            marking: run.marking,
            assigner: self.assigner,
            conservative: self.conservative,
            mesh_detail: self.mesh_detail,
            test: VolumeTest { cone: self.cones(mode), ..self.test },
            lights_at_once: lights_at_once(self.method.has_lists(), mode.lights.count),
            shading: run.shading[0],
            pipeline: run.pipeline[0],
            attenuation: run.attenuation,
            material: run.material,
            spots: mode.lights.spots,
            counting: mode.counting,
        }
    }

    /// How large its buffers are.
    pub fn sizes(&self, run: &Config, largest: LargestGrid, mode: &Mode) -> ClusteringSizes {
        let LargestGrid { clusters, tiles, slice_planes, .. } = largest;
        let kind = self.method.kind();
        let list_entries = match self.lists {
            ListStore::Fixed(entries) => entries.max(mode.capacities.list_entries),
            ListStore::Linked(links) => {
                let most = links.node.most_nodes() / clusters.max(1);
                u64::from(NODES_PER_CLUSTER).min(most).max(mode.capacities.list_entries.into()) as u32
            }
            ListStore::Offsets | ListStore::Capped(_) => 0,
        };
        let capacities = self.method.capacities(clusters, self.clusters, mode.capacities);
        ClusteringSizes {
            clusters,
            tiles,
            listed: self.clusters,
            bounds: self.bounds,
            normal_cones: self.normal_cones,
            boxed: self.keeps_boxes(),
            compaction: self.compaction,
            lists: self.lists,
            slice_planes,
            lights: mode.lights.count,
            spots: mode.lights.spots,
            capacities: Capacities { list_entries, ..capacities },
            assigner: self.assigner,
            shell_layers: self.has_layers(),
            has_octree: kind.groups == Groups::Leaves,
            counting: mode.counting,
            pixels: u64::from(run.resolution[0]) * u64::from(run.resolution[1]),
        }
    }
}

/// What the shaders of a run are specialised for; its configuration has one value on every axis.
pub fn variant(run: &Config, mode: &Mode) -> Variant {
    Chosen::of(run, mode).variant(run, mode)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ClusterSpace;
    use crate::geometry::views::Pose;
    use glam::DVec3;

    fn plan(dimensions: [u32; 3]) -> FramePlan {
        let space = ClusterSpace::Orthographic { min: DVec3::ZERO, max: DVec3::ONE };
        FramePlan { frame: 7, views: vec![], grids: vec![Grid { pose: Pose::IDENTITY, space, dimensions }] }
    }

    #[test]
    fn a_grid_larger_than_planned_is_refused_in_one_line() {
        let largest = LargestGrid::of(&[plan([4, 3, 2]), plan([2, 2, 5])]);
        assert_eq!(largest, LargestGrid { clusters: 24, tiles: 12, sides: [4, 3], slice_planes: 6 });
        for fits in [[4, 3, 2], [4, 1, 5], [1, 1, 1]] {
            largest.check(&plan(fits)).unwrap();
        }
        for beyond in [[5, 5, 1], [1, 1, 6]] {
            let message = largest.check(&plan(beyond)).unwrap_err().to_string();
            assert!(message.starts_with("frame 7 needs a grid of") && !message.contains('\n'), "{message}");
        }
    }
}
