//! Structs that host and shaders share.

use crate::geometry;
use crate::gpu_struct;

gpu_struct! {
    /// One rendering camera in one frame.
    pub struct ViewData {
        /// Reversed depth: 1 near, 0 far.
        pub clip_from_world: [[f32; 4]; 4],
        /// Rigid, but for a view in a mirror.
        pub world_from_view: [[f32; 4]; 4],
        /// Into the space of the clustering that this view looks up; rigid, but for a view in a mirror.
        pub clustering_from_view: [[f32; 4]; 4],
        /// Left and bottom tangent of the frustum.
        pub tangent_min: [f32; 2],
        /// Right minus left, top minus bottom tangent.
        pub tangent_extent: [f32; 2],
        /// Width and height of the view, pixels.
        pub resolution: [u32; 2],
        /// Distance of the near plane, metres, positive.
        pub near: f32,
        /// Distance of the far plane, metres, positive.
        pub far: f32,
        /// Inward unit normal and offset of each side, world space, moved out by what rounding may cost.
        pub planes: [[f32; 4]; 6],
        /// Normal and offset of the mirror, world space: what lies behind is not seen. (0, 0, 0, 1) without one.
        pub clip_plane: [f32; 4],
        /// 1 in a mirror, where faces turn the other way.
        pub mirrored: u32,
    }
}

gpu_struct! {
    /// One clustering in one frame: its grid, its lights, its capacities.
    pub struct GridData {
        /// Rigid, but for the clustering of a view in a mirror.
        pub clustering_from_world: [[f32; 4]; 4],
        /// Number of cells along each axis: Dx, Dy, Dz.
        pub dimensions: [u32; 3],
        /// Words of the visibility bits: ceil(Dx*Dy*Dz / 32).
        pub word_count: u32,
        /// Where the first cell begins. Perspective: left tangent, bottom tangent, and the depth that others are measured in.
        /// Orthographic: lowest corner, metres.
        pub origin: [f32; 3],
        /// Cells per tangent, and slices per log2 of depth or what else their law divides evenly; or cells per metre.
        pub scale: [f32; 3],
        /// Size of a cell along each axis: the inverse of `scale`.
        pub cell: [f32; 3],
        /// The slice coordinate of one metre by a geometric law.
        pub slice_bias: f32,
        /// Perspective: before this depth nothing is seen, metres.
        pub near: f32,
        /// What is added to every light's radius, metres: covers rounding at cell boundaries.
        pub slack: f32,
        /// What is added instead of `slack` where it comes to more, per metre of the radius.
        pub slack_per_radius: f32,
        /// Lights in this frame.
        pub light_count: u32,
        /// Visible clusters that fit.
        pub visible_capacity: u32,
        /// Light indices that fit.
        pub index_capacity: u32,
        /// Entries of each list, or most lights of one, where lists are bounded.
        pub list_capacity: u32,
        /// Words of light bits that fit, of all lists together.
        pub mask_capacity: u32,
        /// Lights of groups that fit, in whole packets.
        pub group_capacity: u32,
        /// Blocks a cluster, along each axis.
        pub block_scale: [f32; 3],
        /// Passes of the sort of the light hierarchy.
        pub sort_passes: u32,
        /// Depth of the light hierarchy at which its places are lights.
        pub tree_depth: u32,
        /// Lowest corner of the grid's bounds in clustering space, metres.
        pub bounds_low: [f32; 3],
        /// 1024 over the extent of the grid's bounds along each axis, per metre.
        pub bounds_scale: [f32; 3],
    }
}

gpu_struct! {
    /// Where a perfect spatial hash lies in the tables that all share; it takes a key p to slot (p mod m + offset[p mod r]) mod m.
    pub struct HashData {
        /// First of its slots.
        pub slots: u32,
        /// Slots a side, m.
        pub side: u32,
        /// First of its offsets.
        pub offsets: u32,
        /// Offsets a side, r.
        pub offset_side: u32,
    }

    /// The hashes of one depth of an octree.
    pub struct OctreeLayer {
        /// That of the branches of this depth.
        pub branches: HashData,
        /// That of the filled leaves of the next depth; nothing asks it where there are none.
        pub leaves: HashData,
    }

    /// The octree of a frame: where its cells lie, and where its tables.
    pub struct OctreeData {
        /// Lowest corner, world space, metres.
        pub origin: [f32; 3],
        /// Deepest cells per metre.
        pub scale: f32,
        /// Depth of the deepest leaves.
        pub depth: u32,
        /// Depth of the first layer.
        pub start_depth: u32,
        /// Deepest cells a side, 2^depth.
        pub cells: f32,
        /// A layer for each depth from `start_depth` on, down to that of the deepest branches.
        pub layers: [OctreeLayer; 24],
    }
}

gpu_struct! {
    /// The box around a cell along the axes of clustering space.
    pub struct ClusterBox in texels {
        /// Lowest corner, metres.
        pub low: [f32; 3],
        /// Highest corner of the box, metres.
        pub high: [f32; 3],
    }
}

gpu_struct! {
    /// A node of the light hierarchy: the centres of its lights lie in the box.
    pub struct LightNode in texels {
        /// Centre of the box, clustering space, metres.
        pub centre: [f32; 3],
        /// Largest radius of the node's lights, metres.
        pub radius: f32,
        /// Half the size of the box, metres.
        pub half_extent: [f32; 3],
    }
}

gpu_struct! {
    /// What a light reaches, in clustering space. What a kind needs besides the bounding sphere is with the light.
    pub struct LightVolume in texels {
        /// Centre of the bounding sphere, metres.
        pub centre: [f32; 3],
        /// Radius of the bounding sphere, metres, slack included.
        pub radius: f32,
        /// A [`VolumeKind`](crate::geometry::VolumeKind) as a number.
        pub kind: u32,
        /// Index of the light in the frame.
        pub light: u32,
    }
}

gpu_struct! {
    /// Takes the template of a light's mesh to clustering space: a vertex (x, y, z, t) to origin + x X + y Y + z Z + t T.
    pub struct MeshFrame {
        /// Where the coordinates are all 0, metres.
        pub origin: [f32; 3],
        /// X, metres.
        pub x: [f32; 3],
        /// Y, metres.
        pub y: [f32; 3],
        /// Z, metres.
        pub z: [f32; 3],
        /// T, metres: to the tip of a spot light's mesh; 0 of a sphere.
        pub tip: [f32; 3],
    }
}

impl From<&geometry::MeshFrame> for MeshFrame {
    fn from(frame: &geometry::MeshFrame) -> Self {
        let [x, y, z] = frame.axes.map(|axis| axis.as_vec3().to_array());
        let [origin, tip] = [frame.origin, frame.tip].map(|place| place.as_vec3().to_array());
        Self { origin, x, y, z, tip }
    }
}

gpu_struct! {
    /// The cells in which a light is seen, by its rectangle on the screen and its depths; empty where the first lies behind the last.
    pub struct LightRectangle in texels {
        /// First cell along each axis.
        pub first: [u32; 3],
        /// Last cell along each axis.
        pub last: [u32; 3],
    }
}

gpu_struct! {
    /// A light in world space.
    pub struct LightData in texels {
        /// Place of the light, metres.
        pub position: [f32; 3],
        /// Influence radius R1, metres.
        pub r1: f32,
        /// Linear colour of the light.
        pub tint: [f32; 3],
        /// Intensity I of the light.
        pub intensity: f32,
        /// Cut-off I0 of the light.
        pub cutoff: f32,
        /// Near radius R0, metres.
        pub r0: f32,
        /// Kind of the volume that the light reaches: a [`VolumeKind`](crate::geometry::VolumeKind) as a number.
        pub kind: u32,
    }
}

gpu_struct! {
    /// The cone that a light shines into, world space; that of a light which shines all around is everywhere.
    pub struct SpotData in texels {
        /// Unit direction of the light; 0 of one without.
        pub axis: [f32; 3],
        /// How far along the axis the middle of the bounding sphere lies, metres.
        pub along: f32,
        /// Radius of the bounding sphere, metres.
        pub radius: f32,
        /// What the cosine of the angle to the axis is multiplied by to find how the light fades.
        pub scale: f32,
        /// What is added to that: up to 0 no light goes that way, from 1 on all does.
        pub offset: f32,
        /// Cosine of the half angle that light is gone from; -1 of a light without a cone.
        pub cosine: f32,
    }
}

gpu_struct! {
    /// A metallic-roughness material.
    pub struct MaterialData {
        /// Linear base colour and alpha.
        pub base_color: [f32; 4],
        /// Linear radiance that the surface emits.
        pub emissive: [f32; 3],
        /// How metallic the surface is, 0 to 1.
        pub metallic: f32,
        /// Perceptual roughness, 0 to 1.
        pub roughness: f32,
        /// Scale of the normal map's x and y.
        pub normal_scale: f32,
        /// How much the occlusion map darkens, 0 to 1.
        pub occlusion_strength: f32,
        /// Below this a masked fragment is discarded.
        pub alpha_cutoff: f32,
        /// Bit s: texture s reads the second uv set.
        pub uv_sets: u32,
        /// 1 where base colour is radiance and no light is evaluated, else 0.
        pub unlit: u32,
        /// Two rows of an affine map per texture.
        pub uv_rows: [[f32; 3]; 10],
    }
}

gpu_struct! {
    /// A primitive's place in the world.
    pub struct InstanceData in texels {
        /// Affine matrix from object to world space.
        pub world_from_object: [[f32; 4]; 4],
        /// Middle of the box around it, world space, metres.
        pub box_center: [f32; 3],
        /// Half the size of the box around the primitive, metres.
        pub box_half_extent: [f32; 3],
    }
}

gpu_struct! {
    /// The box around a model, relative to the middle of the scene's box.
    pub struct ModelBox {
        /// Middle of the box, metres.
        pub centre: [f32; 3],
        /// Half the size of the box along its axes, metres.
        pub half_extent: [f32; 3],
        /// Axes of the box, unit and perpendicular.
        pub axes: [[f32; 3]; 3],
    }
}

gpu_struct! {
    /// An indirect draw, as the device takes it (VkDrawIndexedIndirectCommand).
    pub struct DrawCommand {
        /// Number of the primitive's indices.
        pub index_count: u32,
        /// Number of instances drawn.
        pub instance_count: u32,
        /// First of the primitive's indices.
        pub first_index: u32,
        /// What is added to every index to find its vertex.
        pub vertex_offset: i32,
        /// A drawable's first of the instances; a command's first of the drawn instances, times the views drawn at once.
        pub first_instance: u32,
    }
}

gpu_struct! {
    /// How much a scene draws where the device culls.
    pub struct DrawCounts {
        /// Drawables of opaque and masked geometry.
        pub surfaces: u32,
        /// Drawables of transparent geometry, behind those of opaque and masked geometry.
        pub transparents: u32,
        /// Instances of all drawables.
        pub instances: u32,
    }
}

gpu_struct! {
    /// What the device found out about one clustering in one frame.
    pub struct ClusteringState {
        /// Number of visible clusters there are.
        pub visible_total: u32,
        /// Number of visible clusters that fitted.
        pub visible: u32,
        /// Number of light indices there are; of lists of a fixed size nobody sums them.
        pub index_total: u32,
        /// Length of the longest list that has more lights than the entries of each; 0 where all have room.
        pub longest: u32,
        /// Lights that lists are made of: all, or those that may meet a visible cluster.
        pub candidates: u32,
        /// Words of light bits a list.
        pub mask_words: u32,
        /// Whether the light bits of all lists fit; 0 where lights are counted and sorted instead.
        pub masked: u32,
        /// Packets of lights that scatter tests against a group of clusters each.
        pub packets: u32,
        /// Whether the lights of groups are listed; 0 where that did not fit, and each group gets all candidates.
        pub listed: u32,
    }
}

gpu_struct! {
    /// A group of visible clusters, a workgroup's.
    pub struct ClusterGroup {
        /// Lowest and highest cell, an axis each in two halves.
        pub cells: [u32; 3],
        /// Candidates whose cells meet those.
        pub lights: u32,
        /// How many of the group's candidates are listed yet.
        pub listed: u32,
        /// Index of the first packet of lights of the group.
        pub first_packet: u32,
    }
}

gpu_struct! {
    /// A light that may meet a visible cluster.
    pub struct Candidate in texels {
        /// Index of the light in the frame.
        pub light: u32,
        /// Lowest and highest cell that it may meet, an axis each in two halves.
        pub cells: [u32; 3],
    }
}

gpu_struct! {
    /// Arguments of an indirect dispatch.
    pub struct DispatchSize {
        /// Workgroups along x.
        pub x: u32,
        /// Workgroups along y.
        pub y: u32,
        /// Workgroups along z.
        pub z: u32,
    }
}

gpu_struct! {
    /// What shaders are told by push constants.
    pub struct Push {
        /// Number of the view, the first where several are drawn at once.
        pub view: u32,
        /// How many views are drawn at once, which culling asks.
        pub view_count: u32,
        /// 1 where views drawn at once are drawn for those of them in mirrors, 0 for the others.
        pub mirrored: u32,
        /// Number of the step, for pipelines that run several times in a stage.
        pub step: u32,
    }
}

gpu_struct! {
    /// What is known of a pixel.
    pub struct PixelData {
        /// Along the view's -Z, metres; infinity where nothing was hit.
        pub distance: f32,
        /// Length of the list of the cluster of the pixel.
        pub light_count: u32,
        /// Fragments in the cluster of the pixel.
        pub fragment_count: u32,
        /// Linear cluster index; all ones where nothing was hit.
        pub cluster_index: u32,
    }
}
