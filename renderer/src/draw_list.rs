//! What a view draws: instances grouped into batches, culled against the view's frustum, transparent ones
//! sorted from far to near. Pure: no Vulkan. [`crate::drawables`] leaves culling to the device.

use crate::culling::{ViewPlanes, WorldBox};
use crate::geometry::views::View;
use crate::scene::{AlphaMode, Instance, Scene};

/// How the surfaces of a draw are treated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum SurfaceKind {
    /// Drawn whole: alpha is ignored.
    Opaque,
    /// Drawn where alpha passes the test against the cut-off.
    Masked,
    /// Blended over what lies behind.
    Transparent,
}

impl SurfaceKind {
    /// All kinds, in drawing order.
    pub const ALL: [Self; 3] = [Self::Opaque, Self::Masked, Self::Transparent];
}

impl From<AlphaMode> for SurfaceKind {
    fn from(mode: AlphaMode) -> Self {
        match mode {
            AlphaMode::Opaque => Self::Opaque,
            AlphaMode::Mask => Self::Masked,
            AlphaMode::Blend => Self::Transparent,
        }
    }
}

/// Instances of one primitive that can share a draw call.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Batch {
    /// How the surfaces are treated.
    pub kind: SurfaceKind,
    /// Index of the material in the scene.
    pub material: u32,
    /// First of the primitive's indices.
    pub first_index: u32,
    /// Number of the primitive's indices.
    pub index_count: u32,
    /// What is added to every index to find its vertex.
    pub vertex_offset: i32,
    /// Whether the instances mirror the primitive, which turns its faces around.
    pub mirrored: bool,
    /// Whether both faces are drawn.
    pub double_sided: bool,
}

/// Consecutive instances of a batch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DrawRun {
    /// Index into [`Batches::batches`].
    pub batch: u32,
    /// Index of the first instance in [`Batches::instances`].
    pub first_instance: u32,
    /// How many instances the run has.
    pub instance_count: u32,
}

/// A scene's instances in drawing order.
#[derive(Debug, Clone, PartialEq)]
pub struct Batches {
    /// Batches by kind, then material.
    pub batches: Vec<Batch>,
    /// Instances of [`Scene::instances`] in drawing order.
    pub instances: Vec<u32>,
    /// Batch of each instance, in drawing order.
    pub batch_of: Vec<u32>,
    /// Box around each instance, in drawing order.
    pub boxes: Vec<WorldBox>,
}

impl Batches {
    /// Groups a scene's instances by what they share.
    pub fn new(scene: &Scene) -> Self {
        let batch = |instance: &Instance| {
            let primitive = &scene.primitives[instance.primitive as usize];
            let material = &scene.materials[primitive.material as usize];
            Batch {
                kind: material.alpha_mode.into(),
                material: primitive.material,
                first_index: primitive.first_index,
                index_count: primitive.index_count,
                vertex_offset: primitive.vertex_offset as i32,
                mirrored: instance.world_from_object.determinant() < 0.0,
                double_sided: material.double_sided,
            }
        };
        let mut keyed: Vec<(Batch, u32)> =
            scene.instances.iter().enumerate().map(|(i, instance)| (batch(instance), i as u32)).collect();
        keyed.sort();
        let mut result = Self { batches: vec![], instances: vec![], batch_of: vec![], boxes: vec![] };
        for (batch, index) in keyed {
            if result.batches.last() != Some(&batch) {
                result.batches.push(batch);
            }
            let instance = &scene.instances[index as usize];
            let bounds = &scene.primitives[instance.primitive as usize].bounds;
            result.instances.push(index);
            result.batch_of.push(result.batches.len() as u32 - 1);
            result.boxes.push(WorldBox::new(instance, bounds));
        }
        result
    }

    fn run(&self, instance: usize) -> DrawRun {
        DrawRun { batch: self.batch_of[instance], first_instance: instance as u32, instance_count: 1 }
    }
}

/// Runs of instances that one view draws, by kind; the memory is kept from frame to frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DrawList {
    /// Runs of opaque instances, by material.
    pub opaque: Vec<DrawRun>,
    /// Runs of masked instances, by material.
    pub masked: Vec<DrawRun>,
    /// Runs of transparent instances, from far to near.
    pub transparent: Vec<DrawRun>,
    far_to_near: Vec<(f64, u32)>,
    planes: Vec<ViewPlanes>,
}

impl DrawList {
    /// The runs of one kind.
    pub fn runs(&self, kind: SurfaceKind) -> &[DrawRun] {
        match kind {
            SurfaceKind::Opaque => &self.opaque,
            SurfaceKind::Masked => &self.masked,
            SurfaceKind::Transparent => &self.transparent,
        }
    }

    /// Refills the list with what any of `views` may see; transparent instances are sorted for the first view.
    pub fn update(&mut self, batches: &Batches, views: &[View]) {
        self.opaque.clear();
        self.masked.clear();
        self.transparent.clear();
        self.far_to_near.clear();
        self.planes.clear();
        self.planes.extend(views.iter().map(ViewPlanes::new));
        for (instance, bounds) in batches.boxes.iter().enumerate() {
            if !self.planes.iter().any(|planes| planes.may_see(bounds)) {
                continue;
            }
            let run = batches.run(instance);
            match batches.batches[run.batch as usize].kind {
                SurfaceKind::Opaque => append(&mut self.opaque, run),
                SurfaceKind::Masked => append(&mut self.masked, run),
                SurfaceKind::Transparent => {
                    let distance = bounds.center.distance_squared(views[0].eye());
                    self.far_to_near.push((distance, instance as u32));
                }
            }
        }
        sort_far_to_near(&mut self.far_to_near);
        self.transparent.extend(self.far_to_near.iter().map(|&(_, i)| batches.run(i as usize)));
    }
}

/// Sorts (squared distance, what is drawn) from far to near, equal distances by what is drawn.
pub fn sort_far_to_near(items: &mut [(f64, u32)]) {
    items.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
}

/// Appends a run, joined with the last one where the two are neighbours in one batch.
fn append(runs: &mut Vec<DrawRun>, run: DrawRun) {
    if let Some(last) = runs.last_mut()
        && last.batch == run.batch
        && last.first_instance + last.instance_count == run.first_instance
    {
        last.instance_count += run.instance_count;
        return;
    }
    runs.push(run);
}
