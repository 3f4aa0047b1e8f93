//! What takes lights to lists by the meshes around them: of points, then of spots where there are such.

use super::{Defines, PipelineStore, Variant, twice};
use crate::Result;
use crate::assign::{Assigner, Conservative};
use crate::geometry::{LightMesh, MeshKind};
use crate::layouts::{Pipeline, PipelineLayout};
use crate::vk::{self as gpu, Blend, GraphicsDesc};
use ash::vk;
use std::sync::Arc;

/// Finds the slices of tiles in which meshes around lights lie, and sorts lists that are linked.
pub struct RasterPipelines {
    /// Places the meshes in clustering space.
    pub frames: Arc<Pipeline>,
    /// The slices of each mesh of lights, where they are kept: those of points, then that of spots where there are such.
    pub shells: Vec<Shells>,
    /// Whether there are spots.
    spots: bool,
    /// Sorts lists that are linked, where that is wanted.
    pub sort_nodes: Option<Arc<Pipeline>>,
}

impl RasterPipelines {
    /// Of pipelines of meshes, of which spots have the last, those of points and those of spots.
    pub fn by_kind<'a, T>(&self, pipelines: &'a [T]) -> [&'a [T]; 2] {
        <[_; 2]>::from(pipelines.split_at(pipelines.len() - usize::from(self.spots)))
    }
}

/// Finds the slices of one mesh around lights.
pub enum Shells {
    /// By a kernel over lights, tiles and triangles.
    Computed(Arc<Pipeline>),
    /// By drawing triangles.
    Drawn {
        /// What slices are before any triangle is drawn; into layers, what they are beside those that layers have.
        start: Arc<Pipeline>,
        /// Draws all triangles of a light, an instance a light.
        draw: Arc<Pipeline>,
        /// Vertices of an instance.
        vertices: u32,
    },
}

/// The meshes around lights that have one template, as shaders are told of them.
struct Meshes {
    kind: MeshKind,
    defines: Defines,
    triangles: u32,
}

impl PipelineStore {
    /// Finding where meshes around lights lie, where these are rasterised.
    pub(super) fn raster(&mut self, variant: &Variant) -> Result<Option<RasterPipelines>> {
        if !variant.assigner.rasterises() {
            return Ok(None);
        }
        let frames = self.compute("raster/mesh_frames.comp", &variant.list_defines())?;
        let keeps_shells = variant.assigner == Assigner::Raster;
        let all = if keeps_shells { meshes(variant) } else { vec![] };
        let shells = all.iter().map(|meshes| self.shells(variant, meshes)).collect::<Result<_>>()?;
        let sorts = variant.lists.links().is_some_and(|links| links.sorted);
        let sort_nodes =
            sorts.then(|| self.compute("raster/sort_nodes.comp", &variant.list_defines())).transpose()?;
        Ok(Some(RasterPipelines { frames, shells, spots: variant.spots, sort_nodes }))
    }

    /// What takes the lights of meshes to lists: counts or links them, and writes lists. Shells, where they are kept, are the same
    /// whatever the level of points.
    pub(super) fn fills(&mut self, variant: &Variant, path: &str) -> Result<Vec<[Arc<Pipeline>; 2]>> {
        let mut meshes = meshes(variant);
        if variant.assigner == Assigner::Raster {
            meshes.dedup_by_key(|meshes| meshes.kind == MeshKind::Spot);
        }
        meshes.iter().map(|kind| twice(self, path, &kind.defines, "WRITE_LISTS")).collect()
    }

    fn shells(&mut self, variant: &Variant, meshes: &Meshes) -> Result<Shells> {
        let way = variant.conservative.on(&self.context.limits);
        if way == Conservative::Compute {
            return Ok(Shells::Computed(self.compute("raster/shell.comp", &meshes.defines)?));
        }
        let defines = meshes.defines.with("LAYERS", u32::from(way.has_layers()));
        let start = self.compute("raster/start_shells.comp", &defines)?;
        let draw = self.draw_shells(&defines, way)?;
        Ok(Shells::Drawn { start, draw, vertices: 3 * meshes.triangles })
    }

    /// Draws meshes over a screen of which a pixel is a tile.
    fn draw_shells(&mut self, defines: &Defines, way: Conservative) -> Result<Arc<Pipeline>> {
        let defines = defines.with("HARDWARE", u32::from(way.is_hardware()));
        self.once(format!("shells {defines:?}"), |store, number| {
            let vertex = store.shaders.compile("raster/shell.vert", &defines.0)?;
            let fragment = store.shaders.compile("raster/shell.frag", &defines.0)?;
            let stages =
                [(vk::ShaderStageFlags::VERTEX, &**vertex), (vk::ShaderStageFlags::FRAGMENT, &**fragment)];
            let layout = PipelineLayout::new(&store.context, &store.layouts, "shells", &stages)?;
            let desc = GraphicsDesc {
                vertex: &vertex,
                fragment: Some(&fragment),
                cull_mode: vk::CullModeFlags::NONE,
                color_formats: if way.has_layers() { &[vk::Format::R8G8_UNORM] } else { &[] },
                blend: Blend::Least,
                conservative: way.is_hardware(),
                ..Default::default()
            };
            let pipeline = gpu::graphics_pipeline(&store.context, layout.handle, &desc, "raster/shell.vert")?;
            Ok(Pipeline::new(pipeline, layout, "raster/shell.vert", number))
        })
    }
}

/// Meshes of points, the coarsest first, then of spots where there are such.
fn meshes(variant: &Variant) -> Vec<Meshes> {
    let (mut first_vertex, mut first_triangle) = (0, 0);
    let of = |kind| {
        let LightMesh { vertices, triangles } = LightMesh::new(kind);
        let defines = with_lights_of(kind, variant).with("MESH_VERTICES", vertices.len());
        let defines = defines.with("MESH_TRIANGLES", triangles.len());
        let defines = defines.with("FIRST_VERTEX", first_vertex).with("FIRST_TRIANGLE", first_triangle);
        first_vertex += vertices.len();
        first_triangle += triangles.len();
        Meshes { kind, defines, triangles: triangles.len() as u32 }
    };
    let kinds = variant.mesh_detail.meshes().into_iter();
    kinds.filter(|kind| variant.spots || *kind != MeshKind::Spot).map(of).collect()
}

/// The defines of lists, with what tells the lights that have a mesh.
fn with_lights_of(kind: MeshKind, variant: &Variant) -> Defines {
    let defines = variant.list_defines();
    match (kind, variant.mesh_detail.glsl_beyond()) {
        (MeshKind::Spot, _) => defines.with("MESH", "MESH_SPOT"),
        (MeshKind::Sphere(_), None) => defines.with("MESH", "MESH_SPHERE"),
        (MeshKind::Sphere(level), Some(beyond)) => defines
            .with("MESH", "MESH_SPHERE")
            .with("MESH_LEVEL", level.divisions())
            .with("MESH_BEYOND", beyond),
    }
}
