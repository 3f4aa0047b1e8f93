//! What a frame is recorded from.

use super::lights::{self, LightUpload};
use super::octree::OctreeTables;
use crate::assign::{Assigner, ClusterBounds, Clusters, Compaction, ListStore, Marking};
use crate::buffers::{BufferName as B, BufferSet, set};
use crate::clustering::Clustering;
use crate::draw_list::DrawList;
use crate::drawables::{DrawableOrder, Drawables};
use crate::geometry::{ConeTest, NormalCones, Sharing};
use crate::gpu_scene::GpuScene;
use crate::layouts::BoundBuffers;
use crate::pass::{DepthImage, ScopeName};
use crate::pipelines::Pipelines;
use crate::shading::{Shading, ShadingPipeline};
use crate::targets::{TARGET_COUNT, TargetName};
use crate::vk::{Buffer, Image};
use ash::vk;
use std::ops::{Index, Range};
use std::sync::Arc;

/// One layer of an image. With multiview a view is a layer of an image that all views share; else it has its own image.
pub struct ImageLayer {
    /// The image with all its layers.
    pub image: Arc<Image>,
    /// Index of the layer in its image.
    pub index: u32,
    /// View of the layer alone.
    pub view: vk::ImageView,
}

impl ImageLayer {
    /// A layer of an image.
    pub fn new(image: &Arc<Image>, index: usize) -> Self {
        Self { image: image.clone(), index: index as u32, view: image.layer_views[index] }
    }

    /// Colour of the layer, for copies.
    pub fn color(&self) -> (vk::Image, vk::ImageSubresourceLayers) {
        let layers = vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR);
        (self.image.handle, layers.base_array_layer(self.index).layer_count(1))
    }
}

/// The views that a geometry pass draws at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Eyes {
    /// One view, by its number.
    One(usize),
    /// All, each into its layer.
    All,
}

impl Eyes {
    /// The name of their stage: `depth[0]`, or `depth` for all.
    pub fn stage(self, stem: &'static str) -> ScopeName<'static> {
        match self {
            Self::One(view) => (stem, view).into(),
            Self::All => stem.into(),
        }
    }

    /// The view by which shared data is found.
    pub fn first(self) -> usize {
        match self {
            Self::One(view) => view,
            Self::All => 0,
        }
    }
}

/// A colour target of one view.
pub struct ColorTarget {
    /// What is drawn into, with all samples.
    pub drawn: ImageLayer,
    /// The target with one sample a pixel; `None` where `drawn` has no more, or the target is not resolved.
    pub resolved: Option<ImageLayer>,
}

impl ColorTarget {
    /// What the host reads.
    pub fn readable(&self) -> &ImageLayer {
        self.resolved.as_ref().unwrap_or(&self.drawn)
    }
}

/// What a view is rendered into; its colour targets are found by name.
pub struct ViewTargets {
    /// Reversed depth of the view.
    pub depth: ImageLayer,
    /// Descriptor set that binds `depth`, and those colour targets that shaders sample.
    pub set: vk::DescriptorSet,
    /// Colour targets in the order of [`TargetName::ALL`]; `None` for those that no run of the session draws into.
    pub colors: [Option<ColorTarget>; TARGET_COUNT],
}

impl ViewTargets {
    /// Depth of the view, as compute shaders sample it.
    pub fn depth_image(&self) -> DepthImage {
        DepthImage { image: self.depth.image.handle, set: self.set }
    }

    /// All colour targets that there are.
    pub fn made(&self) -> impl Iterator<Item = &ColorTarget> {
        self.colors.iter().flatten()
    }
}

impl Index<TargetName> for ViewTargets {
    type Output = ColorTarget;

    fn index(&self, name: TargetName) -> &ColorTarget {
        self.colors[name as usize].as_ref().expect("a session makes the targets of all its runs")
    }
}

/// What stage `cull` fills, a part for each view and one for all at once; shared by the frames in flight.
pub struct DrawBuffers {
    /// [`crate::gpu_interface::DrawCommand`], as many in each part as there are drawables.
    pub commands: Buffer,
    /// Instances that the commands draw.
    pub drawn_instances: Buffer,
}

/// What the views draw of the scene.
pub enum Draws<'a> {
    /// What the host let through, a list for each view and one for all at once.
    Listed(&'a [DrawList]),
    /// Everything, by commands that stage `cull` fills, a part for each view and one for all at once.
    Indirect {
        /// Drawables of the scene.
        drawables: &'a Drawables,
        /// Order of the transparent drawables for each view.
        orders: &'a [DrawableOrder],
        /// Buffers that hold the commands.
        buffers: &'a DrawBuffers,
    },
}

/// Everything one frame is recorded from. All of it stays as it is until the frame has ended.
pub struct Frame<'a> {
    /// Pipelines of the method.
    pub pipelines: &'a Pipelines,
    /// The scene that is drawn.
    pub scene: &'a GpuScene,
    /// Layers of an image that meshes around lights are drawn into, where they are.
    pub shell_layers: Option<&'a Image>,
    /// What each view draws of the scene.
    pub draws: Draws<'a>,
    /// What each view is rendered into.
    pub targets: &'a [ViewTargets],
    /// Whether each view sees the world in a mirror.
    pub mirrored: &'a [bool],
    /// The clusterings; for a method without, one that holds every view and no grid.
    pub clusterings: &'a [Clustering],
    /// How the views share the clusterings.
    pub sharing: Sharing,
    /// Whether geometry passes draw all views at once.
    pub multiview: bool,
    /// Which clusters get lists.
    pub clusters: Clusters,
    /// What of a cluster is tested against lights.
    pub bounds: ClusterBounds,
    /// Into which cones the normals of a cluster are told apart, to leave lights out.
    pub normal_cones: NormalCones,
    /// How visible clusters get their places.
    pub compaction: Compaction,
    /// How the lists lie in memory.
    pub lists: ListStore,
    /// Where visible clusters are marked from.
    pub marking: Marking,
    /// How the light lists are built.
    pub assigner: Assigner,
    /// What is asked of cones where lights are assigned; nothing where no light has one.
    pub cones: ConeTest,
    /// How surfaces are drawn.
    pub shading: Shading,
    /// Who evaluates lights for opaque and masked ones.
    pub pipeline: ShadingPipeline,
    /// Whether views are shaded; else the frame ends with the light lists.
    pub shaded: bool,
    /// The lights of the frame.
    pub lights: LightUpload<'a>,
    /// The octree over the lights; `None` where the method has none.
    pub octree: Option<OctreeTables<'a>>,
    /// Where the host finds each clustering's state.
    pub states: &'a Buffer,
    /// Width and height of each view, pixels.
    pub resolution: [u32; 2],
    /// Slot of the frame in flight that is recorded.
    pub slot: usize,
}

impl Frame<'_> {
    /// What tells the place of a visible cluster among the lists.
    pub fn places(&self) -> BufferSet {
        match self.compaction {
            Compaction::Ranks => set(&[B::ClusterBits, B::WordRanks]),
            Compaction::Atomic => set(&[B::ClusterBits, B::ClusterPlaces]),
            Compaction::Sort => set(&[B::TileOffsets, B::VisibleClusters]),
        }
    }

    /// What tells the place of a group among the lists: of a visible cluster, or of a leaf.
    pub fn group_places(&self) -> BufferSet {
        self.places() | set(&[B::OctreeNodes, B::OctreeOffsets])
    }

    /// What tells the list of a group.
    pub fn list_places(&self) -> BufferSet {
        self.group_places()
            | set(&[B::OctreeLeaves])
            | match self.lists {
                ListStore::Offsets => set(&[B::ListOffsets]),
                ListStore::Fixed(_) => set(&[B::ListLengths]),
                ListStore::Capped(_) => set(&[B::ListOffsets, B::ListLengths]),
                ListStore::Linked(_) => set(&[B::ListOffsets]),
            }
    }

    /// What tells how long the list of a group is.
    pub fn list_lengths(&self) -> BufferSet {
        let nodes = self.lists.links().map_or(BufferSet::EMPTY, |_| set(&[B::LightIndices]));
        self.list_places() | nodes
    }

    /// What tells the lights of a fragment that is shaded.
    pub fn light_lists(&self) -> BufferSet {
        self.list_places() | lights::READ | set(&[B::LightIndices, B::OctreeIndices])
    }

    /// The buffers of a clustering.
    pub fn buffers(&self, clustering: usize) -> BoundBuffers<'_> {
        self.clusterings[clustering].bound(self.slot)
    }

    /// The buffers of the clustering in which a view looks its lights up.
    pub fn buffers_of_view(&self, view: usize) -> BoundBuffers<'_> {
        self.buffers(self.sharing.clustering_of(view))
    }

    /// All views, as geometry passes draw them.
    pub fn eyes(&self) -> impl Iterator<Item = Eyes> + use<> {
        self.eyes_of(0..self.targets.len())
    }

    /// Some views, as geometry passes draw them: with multiview, all at once.
    pub fn eyes_of(&self, views: Range<usize>) -> impl Iterator<Item = Eyes> + use<> {
        let multiview = self.multiview;
        let passes = if multiview { 0..1 } else { views };
        passes.map(move |view| if multiview { Eyes::All } else { Eyes::One(view) })
    }

    /// The views of a frame, as shading draws them: at once only where all look lights up in one clustering, for a pass
    /// binds the buffers of one.
    pub fn shaded_eyes(&self) -> impl Iterator<Item = Eyes> + use<> {
        let at_once = self.multiview && self.clusterings.len() == 1;
        let passes = if at_once { 1 } else { self.targets.len() };
        (0..passes).map(move |view| if at_once { Eyes::All } else { Eyes::One(view) })
    }

    /// Whether a pass draws a view in a mirror, or, with `mirrored` false, one that is not.
    pub fn any_mirrored(&self, eyes: Eyes, mirrored: bool) -> bool {
        match eyes {
            Eyes::One(view) => self.mirrored[view] == mirrored,
            Eyes::All => self.mirrored.contains(&mirrored),
        }
    }

    /// How many views a pass draws.
    pub fn view_count(&self, eyes: Eyes) -> u32 {
        match eyes {
            Eyes::One(_) => 1,
            Eyes::All => self.targets.len() as u32,
        }
    }

    /// Index of the draw list for `eyes`: those of single views come first, then that of all at once.
    pub fn list_of(&self, eyes: Eyes) -> usize {
        match eyes {
            Eyes::One(view) => view,
            Eyes::All => self.targets.len(),
        }
    }
}
