//! Meshes are closed, convex, wound outwards, and hold their lights.

use super::super::sector::testing::{half_angle, point_of, sector};
use super::*;
use proptest::prelude::*;
use std::collections::HashSet;

fn all() -> impl Iterator<Item = LightMesh> {
    let spheres = SphereLevel::ALL.into_iter().map(MeshKind::Sphere);
    spheres.chain([MeshKind::Spot]).map(LightMesh::new)
}

/// Corners of the triangles of a mesh in a frame.
fn placed(mesh: &LightMesh, frame: &MeshFrame) -> Vec<[DVec3; 3]> {
    let corner = |vertex: u16| frame.place(mesh.vertices[usize::from(vertex)]);
    mesh.triangles.iter().map(|triangle| triangle.map(corner)).collect()
}

/// Outward unit normal of a triangle and how far out it lies along it.
fn plane([a, b, c]: [DVec3; 3]) -> (DVec3, f64) {
    let normal = (b - a).cross(c - a).normalize();
    (normal, normal.dot(a))
}

fn volume(triangles: &[[DVec3; 3]]) -> f64 {
    let inside = triangles[0][0];
    triangles.iter().map(|[a, b, c]| (*a - inside).dot((*b - inside).cross(*c - inside)) / 6.0).sum()
}

const UNIT: MeshFrame = MeshFrame { origin: DVec3::ZERO, axes: DVec3::AXES, tip: DVec3::ZERO };

#[test]
fn meshes_have_the_papers_counts() {
    let counts = SphereLevel::ALL.map(|level| (level.vertices(), level.triangles()));
    assert_eq!(counts, [(12, 20), (42, 80), (162, 320), (642, 1280)]);
    for level in SphereLevel::ALL {
        let mesh = LightMesh::sphere(level);
        assert_eq!(mesh.vertices.len(), level.vertices() as usize);
        assert_eq!(mesh.triangles.len(), level.triangles() as usize);
    }
    let spot = LightMesh::spot();
    assert_eq!((spot.vertices.len(), spot.triangles.len()), (10, 16));
}

#[test]
fn meshes_are_closed_and_of_one_piece() {
    for mesh in all() {
        let sides = |&[a, b, c]: &[u16; 3]| [[a, b], [b, c], [c, a]];
        let directed: Vec<[u16; 2]> = mesh.triangles.iter().flat_map(sides).collect();
        let distinct: HashSet<_> = directed.iter().copied().collect();
        assert_eq!(distinct.len(), directed.len(), "every side of a triangle is one way once");
        assert!(directed.iter().all(|&[a, b]| distinct.contains(&[b, a])), "and the other way");
        assert_eq!(mesh.vertices.len() + mesh.triangles.len(), directed.len() / 2 + 2, "Euler");
    }
}

#[test]
fn spheres_touch_their_meshes() {
    for level in SphereLevel::ALL {
        let triangles = placed(&LightMesh::sphere(level), &UNIT);
        let inradius = triangles.iter().map(|triangle| plane(*triangle).1).fold(f64::INFINITY, f64::min);
        assert!((inradius - 1.0).abs() < 1e-12, "{level:?}: {inradius}");
    }
    let printed = [1.258_409, 1.070_466, 1.018_074, 1.004_549];
    for (level, printed) in SphereLevel::ALL.into_iter().zip(printed) {
        assert!((level.circumradius() - printed).abs() < 1e-6, "{level:?}");
    }
}

#[test]
fn nearer_and_larger_spheres_are_finer() {
    let level = |radius, distance| SphereLevel::of_detail(radius, distance, 0.01);
    assert_eq!(level(1.0, 100.0), SphereLevel::V12);
    assert_eq!(level(1.0, 10.0), SphereLevel::V42);
    assert_eq!(level(1.0, 2.0), SphereLevel::V162);
    assert_eq!(level(1.0, 1.0), SphereLevel::V642);
    assert_eq!(level(1.0, 0.0), SphereLevel::V642);
    assert_eq!((level(0.0, 1.0), level(10.0, 100.0)), (SphereLevel::V12, SphereLevel::V42));
    // A quarter of a tile of a hundredth: 5 m at 12 m.
    assert_eq!(SphereLevel::of_detail(5.0, 14.0, 0.0025), SphereLevel::V642);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// No triangle cuts anything off what the light reaches, each is wound outwards, and no vertex is beyond another's plane.
    #[test]
    fn meshes_hold_their_lights(sector in sector(), level in 0..3usize, parts in prop::array::uniform3(0.0..=1.0f64)) {
        let level = SphereLevel::ALL[level];
        for volume in [LightVolume::sector(sector), LightVolume::sphere(sector.apex, sector.range)] {
            let frame = MeshFrame::of(&volume);
            let kind = if volume.sector.is_some() { MeshKind::Spot } else { MeshKind::Sphere(level) };
            let mesh = LightMesh::new(kind);
            let inside = match &volume.sector {
                Some(sector) => point_of(sector, [0.5, 0.0, 0.0]),
                None => volume.centre,
            };
            for triangle in placed(&mesh, &frame) {
                let (normal, out) = plane(triangle);
                let farthest = match &volume.sector {
                    Some(sector) => sector.support(normal),
                    None => normal.dot(volume.centre) + volume.radius,
                };
                prop_assert!(farthest <= out + 1e-9, "{kind:?} cuts off {}", farthest - out);
                prop_assert!(normal.dot(inside) < out, "{kind:?} is wound inwards");
                let beyond = |vertex: &DVec4| normal.dot(frame.place(*vertex)) - out;
                prop_assert!(mesh.vertices.iter().map(beyond).all(|beyond| beyond < 1e-9), "{kind:?} is not convex");
            }
            if let Some(sector) = &volume.sector {
                let point = point_of(sector, parts);
                prop_assert!(placed(&mesh, &frame).into_iter().map(plane).all(|(n, out)| n.dot(point) <= out + 1e-9));
            }
        }
    }

    /// A spot light's mesh is smaller than the paper's, whose cap touches the sphere at the rim, and not by much larger than the light.
    #[test]
    fn the_mesh_of_a_spot_is_tight(half_angle in half_angle()) {
        let sector = SphericalSector { apex: DVec3::ZERO, axis: DVec3::X, range: 1.0, half_angle };
        let volume = volume(&placed(&LightMesh::spot(), &MeshFrame::of_sector(&sector)));
        let (sine, cosine) = half_angle.sin_cos();
        let ours = TAU / 3.0 * (sine * sine / (1.0 + cosine));
        let papers = 8.0 / 3.0 * FRAC_PI_8.tan() * sine * sine / cosine;
        prop_assert!(volume < papers && volume < 1.371 * ours, "{volume}, {papers}, {ours}");
        prop_assert!(volume > ours);
    }
}
