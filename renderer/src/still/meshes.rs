//! Meshes that are rasterised, as their edges.

use crate::assign::MeshDetail;
use crate::geometry::{ClusterSpace, Grid, LightMesh, MeshFrame, MeshKind};
use crate::lights::Light;
use glam::DVec3;

/// The meshes of lights in the grids of a frame.
pub struct Meshes<'a> {
    detail: MeshDetail,
    grids: &'a [Grid],
    /// Of every kind that a light may have, its template and the edges of it.
    templates: Vec<(MeshKind, LightMesh, Vec<[u16; 2]>)>,
}

impl<'a> Meshes<'a> {
    /// Those of a detail.
    pub fn new(detail: MeshDetail, grids: &'a [Grid]) -> Self {
        let template = |kind| {
            let mesh = LightMesh::new(kind);
            let edges = mesh.edges().collect();
            (kind, mesh, edges)
        };
        Self { detail, grids, templates: detail.meshes().into_iter().map(template).collect() }
    }

    /// The edges of a light's mesh, and where it has another in some grid of that one too: ends in world space, metres. They are the
    /// device's but for what covers its rounding.
    pub fn edges(&self, light: &Light) -> impl Iterator<Item = (DVec3, DVec3)> {
        let frame = MeshFrame::of(&light.volume(DVec3::ZERO));
        let of_grids: Vec<_> = self.grids.iter().map(|grid| self.kind(light, &frame, grid)).collect();
        let kinds = self.templates.iter().filter(move |(kind, ..)| of_grids.contains(kind));
        kinds.flat_map(move |(_, mesh, edges)| {
            edges.iter().map(move |ends| ends.map(|end| frame.place(mesh.vertices[usize::from(end)])).into())
        })
    }

    fn kind(&self, light: &Light, frame: &MeshFrame, grid: &Grid) -> MeshKind {
        if light.spot.is_some() {
            return MeshKind::Spot;
        }
        let distance = grid.pose.inverse_transform_point(frame.origin).length();
        MeshKind::Sphere(self.detail.level(frame.axes[0].length(), distance, tile_width(grid)))
    }
}

/// Width of a tile in tangents.
fn tile_width(grid: &Grid) -> f64 {
    match grid.space {
        ClusterSpace::Perspective { frustum, .. } => frustum.size().x / f64::from(grid.dimensions[0]),
        // Boxes have no tiles, and any mesh is fine enough.
        ClusterSpace::Orthographic { .. } => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Frustum;
    use crate::geometry::SphereLevel;
    use crate::geometry::views::Pose;
    use crate::lights::Spot;

    /// Of tiles half as wide as far.
    fn grid(z: f64) -> Grid {
        let frustum = Frustum { x0: -1.0, x1: 1.0, y0: -1.0, y1: 1.0, z0: -100.0, z1: -0.1 };
        let pose = Pose::from_position(DVec3::new(0.0, 0.0, z));
        Grid { pose, space: ClusterSpace::geometric(frustum, 0.1), dimensions: [4, 4, 8] }
    }

    fn light(spot: Option<Spot>) -> Light {
        let light = Light::new([1.0, 2.0, -10.0], [1.0; 3], 4.0, 1.0, 0.1);
        light.shining(spot)
    }

    fn count(detail: MeshDetail, grids: &[Grid], light: &Light) -> usize {
        Meshes::new(detail, grids).edges(light).count()
    }

    #[test]
    fn edges_are_drawn_once_around_their_light() {
        let detail = MeshDetail::Level(SphereLevel::V42);
        // Vertices and triangles of a closed mesh are two more than its edges.
        assert_eq!(count(detail, &[grid(0.0)], &light(None)), 42 + 80 - 2);
        let spot = Some(Spot::new([0.0, 0.0, -1.0], 0.2, 0.4));
        assert_eq!(count(detail, &[grid(0.0)], &light(spot)), 10 + 16 - 2);
        let grids = [grid(0.0), grid(1.0)];
        assert_eq!(count(detail, &grids, &light(None)), 120, "one mesh for all grids");
        for (from, to) in Meshes::new(detail, &grids).edges(&light(None)) {
            let middle = DVec3::new(1.0, 2.0, -10.0);
            for end in [from, to] {
                assert!((2.0..2.2).contains(&end.distance(middle)), "{end}");
            }
            assert!(from.midpoint(to).distance(middle) >= 2.0, "the mesh holds its light");
        }
    }

    #[test]
    fn a_mesh_is_as_fine_as_its_distance_from_the_eye_asks() {
        // A radius of 2 m at 10 m in tiles of half a metre a metre: 12 vertices reach 0.52 m beyond it, 42 reach 0.14 m.
        let detail = MeshDetail::Auto(0.05);
        assert_eq!(count(detail, &[grid(0.0)], &light(None)), 120);
        assert_eq!(count(detail, &[grid(20.0)], &light(None)), 30);
        assert_eq!(count(detail, &[grid(0.0), grid(20.0)], &light(None)), 150, "each grid has its own");
    }
}
