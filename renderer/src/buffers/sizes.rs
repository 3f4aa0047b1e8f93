//! Sizes of a clustering's buffers, and what a device must hold and dispatch for them: pure.

use super::{BufferInfo, BufferName, Owner};
use crate::assign::{self, Assigner, ClusterBounds, Clusters, Compaction, Links, ListStore, light_blocks};
use crate::geometry::NormalCones;
use crate::gpu_interface::{ASSIGN_WORKGROUP, SCAN_BLOCK, SORT_BLOCK, SORT_DIGITS};
use crate::measure::{Capacities, OctreeSizes};
use crate::vk::{Limits, texel_bytes};
use crate::{Error, Result};

/// Everything that decides a clustering's buffer sizes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClusteringSizes {
    /// Clusters of the grid (largest of all frames); 0 for a method without clusters.
    pub clusters: u64,
    /// Tiles of the grid: its clusters along x times those along y (most of all frames).
    pub tiles: u64,
    /// Which clusters get lists.
    pub listed: Clusters,
    /// What is kept of a cluster to be tested against lights.
    pub bounds: ClusterBounds,
    /// Into which cones the normals of a cluster are told apart, to leave lights out.
    pub normal_cones: NormalCones,
    /// Whether the boxes around cells are tested.
    pub boxed: bool,
    /// How visible clusters get their places.
    pub compaction: Compaction,
    /// How the lists lie in memory.
    pub lists: ListStore,
    /// Depths between slices of a perspective grid (most of all frames).
    pub slice_planes: u32,
    /// Lights (most of all frames).
    pub lights: u32,
    /// Whether some lights have cones.
    pub spots: bool,
    /// How many entries the buffers of visible clusters and light indices hold; see [`Self::light_indices`].
    pub capacities: Capacities,
    /// How the lists are built.
    pub assigner: Assigner,
    /// Whether where meshes lie is drawn into layers of images.
    pub shell_layers: bool,
    /// Whether lights are found by an octree.
    pub has_octree: bool,
    /// Whether the atemporal run's buffers are there.
    pub counting: bool,
    /// Pixels of a view.
    pub pixels: u64,
}

impl ClusteringSizes {
    /// Words of the visibility bits; none where all clusters get lists.
    pub fn words(&self) -> u64 {
        match self.listed {
            Clusters::Visible => self.clusters.div_ceil(32),
            Clusters::All => 0,
        }
    }

    /// Lights that are taken into the space of clusters, where there are such, to be tested.
    pub(super) fn volumes(&self) -> u64 {
        if self.clusters > 0 && !self.assigner.rasterises() { self.lights.into() } else { 0 }
    }

    /// Lights whose cones are told: all, where some have one.
    pub(super) fn cones(&self) -> u64 {
        if self.spots { self.lights.into() } else { 0 }
    }

    /// Those of which each has its rank: what is visible before it.
    pub(super) fn ranked_words(&self) -> u64 {
        match self.compaction {
            Compaction::Ranks => self.words(),
            Compaction::Atomic | Compaction::Sort => 0,
        }
    }

    /// Tiles whose samples are sorted.
    pub(super) fn sorted_tiles(&self) -> u64 {
        match (self.listed, self.compaction) {
            (Clusters::Visible, Compaction::Sort) => self.tiles,
            _ => 0,
        }
    }

    /// Slices of all those tiles.
    pub(super) fn sorted_slices(&self) -> u64 {
        if self.sorted_tiles() > 0 { self.clusters } else { 0 }
    }

    /// Where the clusters of each of those tiles begin, and where the last end.
    pub(super) fn tile_offsets(&self) -> u64 {
        if self.sorted_tiles() > 0 { self.sorted_tiles() + 1 } else { 0 }
    }

    /// Lights whose cells are kept, to be handed to these.
    pub(super) fn rectangles(&self) -> u64 {
        if self.assigner == Assigner::Rectangles { self.lights.into() } else { 0 }
    }

    /// Lights whose meshes are rasterised.
    pub(super) fn meshes(&self) -> u64 {
        if self.assigner.rasterises() { self.lights.into() } else { 0 }
    }

    /// Tiles of all meshes, of which each has its slices, where these are kept.
    pub(super) fn shell_tiles(&self) -> u64 {
        if self.assigner == Assigner::Raster { self.meshes() * self.tiles } else { 0 }
    }

    /// Those tiles, where layers of images have them.
    pub(super) fn shell_texels(&self) -> u64 {
        if self.shell_layers { self.shell_tiles() } else { 0 }
    }

    /// Clusters of which each has its place where it is visible.
    pub(super) fn cluster_places(&self) -> u64 {
        match (self.listed, self.compaction) {
            (Clusters::Visible, Compaction::Atomic) => self.clusters,
            _ => 0,
        }
    }

    /// Entries of all lists together.
    pub fn light_indices(&self) -> u64 {
        match self.lists {
            ListStore::Offsets | ListStore::Capped(_) => self.capacities.light_indices.into(),
            ListStore::Fixed(_) | ListStore::Linked(_) => {
                self.lists_there() * u64::from(self.capacities.list_entries)
            }
        }
    }

    /// Words of the entries of all lists.
    pub fn light_index_words(&self) -> u64 {
        self.light_indices() * self.lists.links().map_or(1, |links| links.node.words())
    }

    /// Lists that have entries of their own: of no more clusters than there are.
    pub fn lists_there(&self) -> u64 {
        self.visible().min(self.clusters)
    }

    /// Entries of each list, or most lights of one, where lists are bounded.
    pub fn list_bound(&self) -> u32 {
        match self.lists {
            ListStore::Offsets | ListStore::Linked(_) => 0,
            ListStore::Fixed(_) => self.capacities.list_entries,
            ListStore::Capped(lights) => lights,
        }
    }

    /// Whether lists are read off bits that are set while lights are met.
    pub fn has_masks(&self) -> bool {
        self.lists.has_offsets() || self.assigner != Assigner::Brute && self.lists.links().is_none()
    }

    /// Visible clusters that fit.
    pub(super) fn visible(&self) -> u64 {
        self.capacities.visible_clusters.into()
    }

    /// Words of the bounds of visible clusters.
    pub(super) fn bound_words(&self) -> u64 {
        self.bounds.words() * self.visible()
    }

    /// Words of the cones of visible clusters.
    pub(super) fn cone_words(&self) -> u64 {
        u64::from(self.normal_cones.words()) * self.visible()
    }

    /// Boxes around cells.
    pub(super) fn boxes(&self) -> u64 {
        if self.boxed { self.clusters } else { 0 }
    }

    /// Entries of the offsets of lists: where each begins, and where the last one ends if nothing else tells; none without clusters.
    pub(super) fn offsets(&self) -> u64 {
        match self.lists {
            ListStore::Offsets if self.visible() > 0 => self.visible() + 1,
            ListStore::Offsets | ListStore::Fixed(_) => 0,
            ListStore::Capped(_) | ListStore::Linked(_) => self.visible(),
        }
    }

    /// Words of the bits of all lists.
    pub fn mask_words(&self) -> u64 {
        if self.has_masks() {
            assign::mask_capacity(self.lights, self.capacities.visible_clusters)
        } else {
            0
        }
    }

    /// `size` where runs count, else nothing.
    pub(super) fn counted(&self, size: u64) -> u64 {
        if self.counting { size } else { 0 }
    }

    /// `size` where lights are culled before they are assigned, else nothing.
    pub(super) fn for_culled_lights(&self, size: u64) -> u64 {
        if self.assigner.culls_lights() { size } else { 0 }
    }

    /// Words of a bit for each light that may be a candidate, and for each block of lights how many it has.
    pub(super) fn culled_light_words(&self) -> u64 {
        self.for_culled_lights(self.lights.div_ceil(32).into())
            + self.for_culled_lights(light_blocks(self.lights).into())
    }

    /// Lights in the hierarchy.
    pub(super) fn tree_lights(&self) -> u64 {
        if self.assigner == Assigner::Hierarchy { u64::from(self.lights) } else { 0 }
    }

    /// Nodes of the hierarchy, lights not counted.
    pub(super) fn nodes(&self) -> u64 {
        if self.tree_lights() > 0 { assign::tree_nodes(self.lights) } else { 0 }
    }

    /// Groups of visible clusters that scatter makes.
    pub(super) fn groups(&self) -> u64 {
        let groups = u64::from(self.capacities.visible_clusters.div_ceil(ASSIGN_WORKGROUP));
        if self.assigner == Assigner::Scatter { groups } else { 0 }
    }

    /// Lights of groups that are listed.
    pub fn group_lights(&self) -> u64 {
        if self.assigner == Assigner::Scatter {
            assign::group_capacity(self.lights, self.groups())
        } else {
            0
        }
    }

    /// Packets of lights of all groups of clusters.
    pub(super) fn group_packets(&self) -> u64 {
        self.group_lights() / u64::from(ASSIGN_WORKGROUP)
    }

    /// Counts of the digits of all blocks of the sort.
    pub(super) fn digit_counts(&self) -> u64 {
        self.tree_lights().div_ceil(u64::from(SORT_BLOCK)) * u64::from(SORT_DIGITS)
    }

    /// Blocks of the longest prefix sum.
    pub(super) fn scan_blocks(&self) -> u64 {
        self.scan_items().div_ceil(u64::from(SCAN_BLOCK))
    }

    /// Items of the longest prefix sum: of words, of tiles, of lists, of the digits of the sort, of scatter's groups.
    fn scan_items(&self) -> u64 {
        let lists = if self.lists.has_offsets() { self.visible() } else { 0 };
        let clusters = self.ranked_words().max(self.sorted_tiles());
        clusters.max(lists).max(self.digit_counts()).max(self.groups())
    }

    /// What the buffers of a clustering take, bytes, where so many frames are in flight.
    pub fn bytes(&self, slots: u64) -> u64 {
        let size = |info: &BufferInfo| info.size.map_or(0, |size| size(self));
        let of =
            |owner| BufferName::ALL.map(BufferName::info).into_iter().filter(move |info| info.owner == owner);
        of(Owner::Clustering).map(size).sum::<u64>()
            + slots * of(Owner::ClusteringFrame).map(size).sum::<u64>()
    }

    /// Lists whose lengths are counted or kept.
    pub(super) fn lengths(&self) -> u64 {
        if self.lists.links().is_some() { 0 } else { self.visible() }
    }

    /// Refuses a pool of more nodes than links tell apart.
    fn check_nodes(&self) -> Result<()> {
        let most = self.lists.links().map_or(u64::MAX, |links| links.node.most_nodes());
        if self.light_indices() <= most {
            return Ok(());
        }
        Err(Error::Device(format!(
            "lists {} hold at most {most} nodes, and {} clusters with up to {} each are more: use --lists linked-64, fewer lights or \
             larger clusters",
            self.lists, self.clusters, self.capacities.list_entries
        )))
    }

    /// The most entries that the device's buffers hold.
    pub fn most(&self, limits: &Limits) -> Capacities {
        let words = limits.max_storage_buffer_range / 4;
        let groups = u64::from(limits.max_compute_work_group_count[0]);
        let entries = |words: u64| u32::try_from(words).unwrap_or(u32::MAX);
        let indices = words.min(limits.max_texel_buffer_elements);
        let nodes = self
            .lists
            .links()
            .map_or(indices, |Links { node, .. }| (indices / node.words()).min(node.most_nodes()));
        Capacities {
            visible_clusters: entries((words - 1).min(groups * u64::from(ASSIGN_WORKGROUP))),
            light_indices: entries(indices),
            list_entries: entries(nodes / self.lists_there().max(1)),
            octree: OctreeSizes::all(entries(indices)),
        }
    }

    /// Refuses what the device cannot hold or dispatch, naming the largest fault.
    pub fn check(&self, limits: &Limits) -> Result<()> {
        self.check_nodes()?;
        for info in BufferName::ALL.map(BufferName::info) {
            let (name, size) = (info.name, info.size.map_or(0, |size| size(self)));
            let mend = match self.lists {
                ListStore::Fixed(_) if name == BufferName::LightIndices.info().name => {
                    "fewer entries a list, or --lists offsets"
                }
                _ => "fewer lights or larger clusters",
            };
            let too_much = |what: String| {
                Error::Device(format!(
                    "buffer {name} would {what} ({} clusters, {} lights, {} visible clusters, {} light indices): use \
                     {mend}",
                    self.clusters,
                    self.lights,
                    self.capacities.visible_clusters,
                    self.light_indices(),
                ))
            };
            let most = limits.max_storage_buffer_range;
            if size > most {
                return Err(too_much(format!("need {size} bytes but the device binds at most {most}")));
            }
            let texels = info.texels.map_or(0, |texels| size / texel_bytes(texels.format()));
            let most = limits.max_texel_buffer_elements;
            if texels > most {
                return Err(too_much(format!(
                    "be read as {texels} texels but the device takes at most {most}"
                )));
            }
        }
        let [most_x, most_y, _] = limits.max_compute_work_group_count.map(u64::from);
        let (lights, visible) = (self.lights, self.capacities.visible_clusters);
        let packets = u64::from(lights.div_ceil(ASSIGN_WORKGROUP));
        let groups = u64::from(visible.div_ceil(ASSIGN_WORKGROUP));
        let blocks = self.scan_blocks();
        let boxes = self.boxes().div_ceil(u64::from(ASSIGN_WORKGROUP));
        for (what, workgroups, most) in [
            (format!("{lights} lights"), packets, most_x.min(most_y)),
            (format!("{lights} lights that are rasterised"), self.meshes(), most_x),
            (format!("{visible} visible clusters"), groups, most_x),
            (format!("{} clusters", self.clusters), blocks.max(boxes), most_x),
            (
                format!("{} clusters with atomic compaction", self.clusters),
                self.cluster_places().div_ceil(ASSIGN_WORKGROUP.into()),
                most_x,
            ),
        ] {
            if workgroups > most {
                return Err(Error::Device(format!(
                    "{what} would need a dispatch of {workgroups} workgroups but the device allows {most}: use fewer \
                     lights or larger clusters"
                )));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
