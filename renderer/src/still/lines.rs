//! All lines of a still, of a frame that has ended.
//!
//! ```text
//! views, grids ─frusta──────────────────────────────┐
//! octree ─leaves────────────────────────────────────┤
//! lists ─(used, or with the light)─> cells ─outline──┼──> lines, relative to the frame's origin
//! lights ─Meshes::edges─────────────────────────────┘
//! ```

use super::cells::Cells;
use super::meshes::Meshes;
use super::{Show, shapes};
use crate::assign::MeshDetail;
use crate::draw_list::Batches;
use crate::engine::FramePlan;
use crate::geometry::views::{Pose, View};
use crate::geometry::{Grid, OrientedBox};
use crate::lights::Light;
use crate::measure::{ClusterLists, ClusteringCounts};
use crate::methods::{Method, model};
use crate::octree::LinklessOctree;
use crate::pipelines::Line;
use crate::scene::Scene;
use crate::{Error, Result};
use glam::DVec3;

/// Most lines of a still.
const MOST: usize = 1 << 22;

/// Clusters with any light: blue.
const USED: [f32; 3] = [0.1, 0.35, 0.9];
/// Clusters with the light at hand: yellow.
const OF_LIGHT: [f32; 3] = [0.9, 0.6, 0.05];

/// The lists of a clustering, with the clusters that have them.
#[derive(Debug, Clone, Copy)]
pub struct Listed<'a> {
    /// Clusters that have lists, by ascending index.
    pub counts: &'a ClusteringCounts,
    /// Their lists.
    pub lists: &'a ClusterLists,
}

impl<'a> Listed<'a> {
    /// Those of all clusterings of a frame, as they were counted and read.
    pub fn of(counts: &'a [ClusteringCounts], lists: &'a [ClusterLists]) -> Vec<Self> {
        counts.iter().zip(lists).map(|(counts, lists)| Self { counts, lists }).collect()
    }

    /// Clusters with any light, by ascending index.
    fn used(&self) -> Vec<u32> {
        self.clusters(|list| !list.is_empty())
    }

    /// Clusters that have a light, by ascending index.
    pub fn with(&self, light: u32) -> Vec<u32> {
        self.clusters(|list| list.binary_search(&light).is_ok())
    }

    fn clusters(&self, holds: impl Fn(&[u32]) -> bool) -> Vec<u32> {
        let clusters = self.counts.clusters.iter().enumerate();
        clusters.filter(|(at, _)| holds(self.lists.list(*at))).map(|(_, cluster)| cluster.index).collect()
    }
}

/// What lines are of.
pub struct Drawn<'a> {
    /// The method that grouped the frame's fragments.
    pub method: Method,
    /// Where the still is seen from, world space, metres.
    pub eye: DVec3,
    /// The frame, with its grids where they lay.
    pub plan: &'a FramePlan,
    /// The lights of the frame.
    pub lights: &'a [Light],
    /// How fine meshes around points are, where these are rasterised.
    pub detail: MeshDetail,
    /// The lists of each clustering, where something is shown of them.
    pub listed: &'a [Listed<'a>],
    /// The octree that has the lists.
    pub octree: Option<&'a LinklessOctree>,
    /// The scene, and its models as they are drawn.
    pub scene: (&'a Scene, &'a Batches),
}

impl Drawn<'_> {
    /// What is shown of them.
    ///
    /// # Errors
    /// Too many lines.
    pub fn lines(&self, show: &Show) -> Result<Vec<Line>> {
        let mut lines = if show.frusta { self.frusta() } else { vec![] };
        if let Some(octree) = self.octree.filter(|_| show.octree) {
            lines.extend(shapes::leaves(octree, self.plan.origin()));
        }
        for (grid, listed) in self.plan.grids.iter().zip(self.listed) {
            if show.used_clusters {
                self.cells(&mut lines, grid, (&listed.used(), USED));
            }
            if let Some(light) = show.light.filter(|_| show.light_clusters) {
                self.cells(&mut lines, grid, (&listed.with(light), OF_LIGHT));
            }
        }
        if show.light_mesh {
            self.meshes(&mut lines, show.light);
        }
        if lines.len() > MOST {
            return Err(Error::input(format!(
                "show: these are more than {MOST} lines: show less at once, take larger clusters or nodes, or coarser meshes, or name one light \
                 by --light"
            )));
        }
        Ok(lines)
    }

    fn frusta(&self) -> Vec<Line> {
        let origin = self.plan.origin();
        let views: Vec<View> = self.plan.views.iter().map(|view| view.relative_to(origin)).collect();
        let grids: Vec<Grid> = self.plan.grids.iter().map(|grid| grid.relative_to(origin)).collect();
        shapes::frusta(&views, &grids)
    }

    /// The clusters of a grid, which may stand for models.
    fn cells(&self, lines: &mut Vec<Line>, grid: &Grid, (cells, tint): (&[u32], [f32; 3])) {
        match self.method {
            Method::Models => {
                let pose = Pose::from_position(-self.plan.origin());
                for &place in cells {
                    shapes::edges(lines, &pose, &self.model(place).corners(), tint);
                }
            }
            _ => {
                let pose = grid.relative_to(self.plan.origin()).pose;
                let edges = Cells { grid, indices: cells }.outline(self.eye);
                extend(lines, edges.map(|ends| shapes::line(&pose, ends, tint)));
            }
        }
    }

    fn model(&self, place: u32) -> OrientedBox {
        let (scene, batches) = self.scene;
        let instance = batches.instances[place as usize];
        model::box_of(scene, &scene.instances[instance as usize]).0
    }

    /// The meshes of one light, or of all.
    fn meshes(&self, lines: &mut Vec<Line>, light: Option<u32>) {
        let pose = Pose::from_position(-self.plan.origin());
        let meshes = Meshes::new(self.detail, &self.plan.grids);
        let lights = match light {
            Some(light) => &self.lights[light as usize..][..1],
            None => self.lights,
        };
        for light in lights {
            extend(lines, meshes.edges(light).map(|ends| shapes::line(&pose, ends, hue(light))));
        }
    }
}

/// One line more than may be suffices to see that there are too many.
fn extend(lines: &mut Vec<Line>, more: impl Iterator<Item = Line>) {
    let room = (MOST + 1).saturating_sub(lines.len());
    lines.extend(more.take(room));
}

/// The colour of a light, as bright as can be.
fn hue(light: &Light) -> [f32; 3] {
    let brightest = light.tint.iter().copied().fold(0.0, f32::max);
    if brightest > 0.0 { light.tint.map(|part| part / brightest) } else { [1.0; 3] }
}
