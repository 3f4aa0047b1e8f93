//! What takes lights to lists by the meshes around them: of points, then of spots where there are such.

use super::{Defines, PipelineStore, Variant, twice};
use crate::Result;
use crate::assign::{Assigner, Conservative};
use crate::geometry::{LightMesh, MeshKind};
use crate::layouts::{Pipeline, PipelineLayout};
use crate::vk::{self as gpu, GraphicsDesc};
use ash::vk;
use std::sync::Arc;

/// Finds the slices of tiles in which meshes around lights lie, and sorts lists that are linked.
pub struct RasterPipelines {
    /// Places the meshes in clustering space.
    pub frames: Arc<Pipeline>,
    /// The slices of the meshes of each kind, where they are kept.
    pub shells: Vec<Shells>,
    /// Sorts lists that are linked, where that is wanted.
    pub sort_nodes: Option<Arc<Pipeline>>,
}

/// Finds the slices of meshes of one kind.
pub enum Shells {
    /// By a kernel over lights, tiles and triangles.
    Computed(Arc<Pipeline>),
    /// By drawing triangles.
    Drawn {
        /// What slices are before any triangle is drawn.
        start: Arc<Pipeline>,
        /// Draws all triangles of a light, an instance a light.
        draw: Arc<Pipeline>,
        /// Vertices of an instance.
        vertices: u32,
    },
}

/// The meshes of one kind, as shaders are told of them.
struct Meshes {
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
        let kinds = if keeps_shells { meshes(variant) } else { vec![] };
        let shells = kinds.iter().map(|meshes| self.shells(variant, meshes)).collect::<Result<_>>()?;
        let sorts = variant.lists.links().is_some_and(|links| links.sorted);
        let sort_nodes =
            sorts.then(|| self.compute("raster/sort_nodes.comp", &variant.list_defines())).transpose()?;
        Ok(Some(RasterPipelines { frames, shells, sort_nodes }))
    }

    /// What takes the lights of meshes to lists: counts or links them, and writes lists.
    pub(super) fn fills(&mut self, variant: &Variant, path: &str) -> Result<Vec<[Arc<Pipeline>; 2]>> {
        meshes(variant).iter().map(|kind| twice(self, path, &kind.defines, "WRITE_LISTS")).collect()
    }

    fn shells(&mut self, variant: &Variant, meshes: &Meshes) -> Result<Shells> {
        let hardware = match variant.conservative.on(&self.context.limits) {
            Conservative::Compute => {
                return Ok(Shells::Computed(self.compute("raster/shell.comp", &meshes.defines)?));
            }
            Conservative::Hardware => true,
            Conservative::Software | Conservative::Auto => false,
        };
        let start = self.compute("raster/start_shells.comp", &meshes.defines)?;
        let draw = self.draw_shells(&meshes.defines, hardware)?;
        let vertices = meshes.triangles * if hardware { 3 } else { 6 };
        Ok(Shells::Drawn { start, draw, vertices })
    }

    /// Draws meshes over a screen of which a pixel is a tile.
    fn draw_shells(&mut self, defines: &Defines, hardware: bool) -> Result<Arc<Pipeline>> {
        let defines = defines.with("HARDWARE", u32::from(hardware));
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
                conservative: hardware,
                ..Default::default()
            };
            let pipeline = gpu::graphics_pipeline(&store.context, layout.handle, &desc, "raster/shell.vert")?;
            Ok(Pipeline::new(pipeline, layout, "raster/shell.vert", number))
        })
    }
}

/// Meshes of points, then of spots where there are such.
fn meshes(variant: &Variant) -> Vec<Meshes> {
    let (mut first_vertex, mut first_triangle) = (0, 0);
    let kinds = ["MESH_SPHERE", "MESH_SPOT"].into_iter().zip(MeshKind::rasterised(variant.mesh_detail));
    let of = |(name, kind)| {
        let LightMesh { vertices, triangles } = LightMesh::new(kind);
        let defines = variant.list_defines().with("MESH", name).with("MESH_VERTICES", vertices.len());
        let defines = defines.with("MESH_TRIANGLES", triangles.len());
        let defines = defines.with("FIRST_VERTEX", first_vertex).with("FIRST_TRIANGLE", first_triangle);
        first_vertex += vertices.len();
        first_triangle += triangles.len();
        Meshes { defines, triangles: triangles.len() as u32 }
    };
    kinds.take(if variant.spots { 2 } else { 1 }).map(of).collect()
}
