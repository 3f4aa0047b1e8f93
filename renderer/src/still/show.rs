//! What a still is asked to show.

use crate::methods::{Groups, Method};
use crate::shading::ShadingPipeline;
use crate::{Error, Result};
use clap::ValueEnum;

/// One thing that a still can show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Item {
    /// Clusters in three colours, by the sum of their three indices modulo 3; dim where no cluster is visible.
    Clusters,
    /// Slices in eight colours, by the three low bits of their index as red, green and blue; dim where no cluster is visible.
    Slices,
    /// Frusta of the views (green) and of the clusterings, or their boxes (red).
    Frusta,
    /// Influence volumes of the lights.
    Lights,
    /// Lights in each pixel's cluster, from black (none) to white (most).
    LightCount,
    /// Fragments in each pixel's cluster, from black (none) to white (most).
    FragmentCount,
    /// Magenta where no visible cluster exists.
    Missing,
    /// Leaves of the octree that hold lights, of each depth in its own colour.
    Octree,
    /// Beside the picture, one of the hash tables of each depth of the octree: slots that are taken, offsets as colours.
    Hash,
    /// What the G-buffer of deferred shading holds, side by side: base colours, normals (their axes as red, green and blue) and
    /// depth (white nearest).
    Gbuffer,
    /// Clusters with any light, as the lines on the surface of what they fill, where it faces the camera (blue).
    UsedClusters,
    /// Clusters that have the light of --light, as such lines (yellow).
    LightClusters,
    /// Meshes that are rasterised, of the light of --light or of all: their edges, in the hues of the lights.
    LightMesh,
    /// Nothing of the scene, so that lines and volumes of lights stand alone.
    NoScene,
}

/// What the surfaces of a still show.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Base {
    /// What was shaded; surfaces as under a lamp where the camera is none of the recording's.
    #[default]
    Picture,
    /// Clusters in three colours.
    Clusters,
    /// Slices in eight colours.
    Slices,
    /// A heat map of lights.
    LightCount,
    /// A heat map of fragments.
    FragmentCount,
    /// What a G-buffer holds, side by side.
    Gbuffer,
}

/// All that a still shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Show {
    /// What surfaces show.
    pub base: Base,
    /// Whether there are no surfaces.
    pub no_scene: bool,
    /// Lines of frusta and boxes.
    pub frusta: bool,
    /// Whether volumes of lights are shown.
    pub lights: bool,
    /// Magenta where there is no cluster.
    pub missing: bool,
    /// Lines of the octree's leaves.
    pub octree: bool,
    /// Whether the octree's tables are pictured too.
    pub hash: bool,
    /// Lines of the clusters with lights.
    pub used_clusters: bool,
    /// Lines of the clusters that have [`Self::light`].
    pub light_clusters: bool,
    /// Edges of the meshes that are rasterised: of [`Self::light`], or of all lights.
    pub light_mesh: bool,
    /// The light that clusters and mesh are of.
    pub light: Option<u32>,
}

impl Show {
    /// Puts items together, some of which are of one light.
    ///
    /// # Errors
    /// Items that exclude each other, or need a light that is not given; a light that none is of.
    pub fn from_items(items: &[Item], light: Option<u32>) -> Result<Self> {
        let mut show = Self { light, ..Self::default() };
        for &item in items {
            show.add(item)?;
        }
        show.check_items().map_err(|problem| Error::input(problem.to_owned()))?;
        Ok(show)
    }

    fn add(&mut self, item: Item) -> Result<()> {
        let flag = match item {
            Item::Clusters => return self.cover(Base::Clusters),
            Item::Slices => return self.cover(Base::Slices),
            Item::LightCount => return self.cover(Base::LightCount),
            Item::FragmentCount => return self.cover(Base::FragmentCount),
            Item::Gbuffer => return self.cover(Base::Gbuffer),
            Item::Frusta => &mut self.frusta,
            Item::Lights => &mut self.lights,
            Item::Missing => &mut self.missing,
            Item::Octree => &mut self.octree,
            Item::Hash => &mut self.hash,
            Item::UsedClusters => &mut self.used_clusters,
            Item::LightClusters => &mut self.light_clusters,
            Item::LightMesh => &mut self.light_mesh,
            Item::NoScene => &mut self.no_scene,
        };
        *flag = true;
        Ok(())
    }

    fn cover(&mut self, base: Base) -> Result<()> {
        if self.base != Base::Picture && self.base != base {
            return Err(Error::input(
                "show: clusters, slices, light-count, fragment-count and gbuffer exclude each other: choose one of them",
            ));
        }
        self.base = base;
        Ok(())
    }

    fn check_items(&self) -> Result<(), &'static str> {
        let lines = self.frusta || self.octree || self.of_lists() || self.light_mesh;
        let on_surfaces = self.base != Base::Picture || self.missing;
        if self.base == Base::Gbuffer && (lines || self.lights || self.missing) {
            return Err("show: gbuffer is shown by itself: leave the others out");
        }
        if self.no_scene && on_surfaces {
            return Err(
                "show: without the scene there are no surfaces to colour: leave no-scene out, or show lines and lights alone",
            );
        }
        match self.light {
            None if self.light_clusters => {
                Err("show: light-clusters are of one light: add --light N, its number from 0 on")
            }
            Some(_) if !(self.light_clusters || self.light_mesh) => {
                Err("light: nothing that is shown is of one light: add --show light-clusters, or light-mesh")
            }
            _ => Ok(()),
        }
    }

    /// Whether lines are of what lists hold.
    fn of_lists(&self) -> bool {
        self.used_clusters || self.light_clusters
    }

    /// Whether lists are asked for what they hold.
    pub(super) fn needs_lists(&self) -> bool {
        self.of_lists() || self.light.is_some()
    }

    /// Refuses what a method without clusters, without an octree, or without meshes, or a pipeline without a G-buffer, cannot show.
    pub(super) fn check(&self, method: &Method, pipeline: ShadingPipeline) -> Result<()> {
        if self.base == Base::Gbuffer && pipeline == ShadingPipeline::Forward {
            return Err(Error::input(
                "show: forward shading has no G-buffer: add --pipeline deferred, or leave gbuffer out",
            ));
        }
        if self.light_mesh && !method.has_meshes() {
            return Err(Error::input(format!(
                "show: {method} rasterises no meshes: choose a method such as raster-24-12-64-e, or leave light-mesh out"
            )));
        }
        let of_groups =
            !matches!(self.base, Base::Picture | Base::Gbuffer) || self.missing || self.of_lists();
        let of_cells = matches!(self.base, Base::Clusters | Base::Slices) || self.missing || self.of_lists();
        match method.kind().groups {
            Groups::Nothing if of_groups => Err(Error::input(format!(
                "show: {method} has no clusters: choose a clustered method, or show frusta and lights alone"
            ))),
            Groups::Leaves if of_cells => Err(Error::input(format!(
                "show: {method} has leaves of an octree, not clusters: choose a clustered method, or show octree, light-count or \
                 fragment-count"
            ))),
            Groups::Nothing | Groups::Cells(_) if self.octree || self.hash => Err(Error::input(format!(
                "show: {method} has no octree: choose a method such as hashed-0.5-3, or leave octree and hash out"
            ))),
            _ => Ok(()),
        }
    }

    /// Refuses a light that is none of a frame's.
    pub(super) fn check_light(&self, lights: u32) -> Result<()> {
        match self.light.filter(|&light| light >= lights) {
            None => Ok(()),
            Some(light) => Err(Error::input(format!(
                "light: there is no light {light}: of {lights} lights the first is 0; choose one below {lights}"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(items: &[Item]) -> Show {
        Show::from_items(items, None).unwrap()
    }

    fn refused(items: &[Item], light: Option<u32>) -> String {
        Show::from_items(items, light).unwrap_err().to_string()
    }

    #[test]
    fn items_add_up_unless_they_exclude_each_other() {
        let show = shown(&[Item::Clusters, Item::Frusta, Item::Missing]);
        assert_eq!(show, Show { base: Base::Clusters, frusta: true, missing: true, ..Show::default() });
        for other in [Item::LightCount, Item::Slices] {
            assert!(refused(&[Item::Clusters, other], None).contains("exclude each other"));
        }
        for other in [Item::Lights, Item::Octree, Item::UsedClusters] {
            assert!(refused(&[Item::Gbuffer, other], None).contains("by itself"));
        }
        for other in [Item::LightCount, Item::Missing] {
            assert!(refused(&[Item::NoScene, other], None).contains("no surfaces"));
        }
    }

    #[test]
    fn methods_and_pipelines_show_what_they_have() {
        let forward = ShadingPipeline::Forward;
        let fits =
            |items: &[Item], method: &str| shown(items).check(&method.parse().unwrap(), forward).is_ok();
        let [cells, leaves, nothing] = ["indi-persp-64", "hashed-0.5-3", "all-lights"];
        assert!(fits(&[Item::Clusters], cells) && !fits(&[Item::Clusters], nothing));
        for of_cells in [Item::Clusters, Item::UsedClusters] {
            assert!(fits(&[of_cells], cells) && !fits(&[of_cells], leaves) && !fits(&[of_cells], nothing));
        }
        let of_octree = [Item::LightCount, Item::Octree, Item::Hash];
        assert!(fits(&of_octree, leaves) && !fits(&of_octree, cells));
        assert!(!fits(&[Item::Octree], nothing) && fits(&[Item::Frusta, Item::Lights], nothing));
        assert!(fits(&[Item::LightMesh], "raster-count-24-12-32-l") && !fits(&[Item::LightMesh], cells));
        let gbuffer = shown(&[Item::Gbuffer]);
        let check = |pipeline| gbuffer.check(&Method::AllLights, pipeline).is_ok();
        assert!(check(ShadingPipeline::Deferred) && !check(forward));
    }

    #[test]
    fn a_light_goes_with_what_is_of_one() {
        assert!(refused(&[Item::UsedClusters], Some(3)).contains("--show light-clusters"));
        assert!(refused(&[Item::LightClusters], None).contains("--light N"));
        let show = Show::from_items(&[Item::LightClusters, Item::LightMesh], Some(3)).unwrap();
        assert!(show.check_light(4).is_ok() && shown(&[Item::LightMesh]).check_light(0).is_ok());
        assert!(show.check_light(3).unwrap_err().to_string().contains("there is no light 3"));
    }
}
