use std::sync::LazyLock;

use glam::{DVec3, Vec3};
use sha2::{Digest, Sha256};

use super::*;
use crate::recording::load;
use crate::scene::{AlphaMode, Scene};

mod city;
mod flights;
mod hall;

static STREET: LazyLock<Scene> = LazyLock::new(|| street(Size::Small));
static TEMPLE: LazyLock<Scene> = LazyLock::new(|| temple(Size::Small));

/// Farther than the near plane's corner (0.9 m from a Vive eye), so that no wall is cut open.
const CLEARANCE: f32 = 1.0;
/// Half the distance between the eyes, with a margin.
const EYE: f32 = 0.04;

fn texture_hash(scene: &Scene) -> String {
    let mut hash = Sha256::new();
    scene.images.iter().flat_map(|image| &image.mips).for_each(|mip| hash.update(mip));
    hash.finalize()[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}

fn check_structure(scene: &Scene) {
    for primitive in &scene.primitives {
        let first = primitive.first_index as usize;
        let indices = &scene.indices[first..first + primitive.index_count as usize];
        assert!(!indices.is_empty() && indices.len().is_multiple_of(3));
        assert!(indices.iter().all(|index| *index < primitive.vertex_count));
        let owned =
            primitive.vertex_offset as usize..(primitive.vertex_offset + primitive.vertex_count) as usize;
        let vertices = &scene.vertices[owned];
        let name = &scene.materials[primitive.material as usize].name;
        for vertex in vertices {
            let (position, normal) = (Vec3::from(vertex.position), Vec3::from(vertex.normal));
            let [x, y, z, w] = vertex.tangent;
            let tangent = Vec3::new(x, y, z);
            assert!(position.is_finite() && vertex.uv[0].iter().all(|c| c.is_finite()), "{name}");
            assert!((normal.length() - 1.0).abs() < 1e-4 && (tangent.length() - 1.0).abs() < 1e-4, "{name}");
            assert!(normal.dot(tangent).abs() < 1e-3 && w.abs() == 1.0, "{name}");
            let inside = position.clamp(primitive.bounds.min, primitive.bounds.max);
            assert_eq!(inside, position, "{name}");
        }
        check_winding(vertices, indices, name);
    }
    assert!(scene.instances.iter().all(|instance| {
        (instance.primitive as usize) < scene.primitives.len()
            && instance.world_from_object.determinant() > 0.0
            && instance.world_from_object.is_finite()
    }));
}

fn check_winding(vertices: &[crate::scene::Vertex], indices: &[u32], name: &str) {
    for corners in indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| &vertices[corners[k] as usize]);
        let [p, q, r] = [a, b, c].map(|vertex| Vec3::from(vertex.position));
        let face = (q - p).cross(r - p);
        assert!(face.length() > 0.0, "{name}: a triangle without area at {p}");
        for vertex in [a, b, c] {
            assert!(face.dot(vertex.normal.into()) > 0.0, "{name}: winding against the normal at {p}");
        }
    }
}

fn check_materials(scene: &Scene, at_least: usize) {
    assert!(scene.materials.len() >= at_least, "{} materials", scene.materials.len());
    for mode in [AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend] {
        assert!(scene.materials.iter().any(|material| material.alpha_mode == mode), "{mode:?}");
    }
    assert!(scene.materials.iter().any(|material| material.emissive[0] > 0.0));
    for material in &scene.materials {
        assert!(material.textures[..4].iter().all(Option::is_some), "{}", material.name);
        assert!(material.double_sided || material.alpha_mode != AlphaMode::Mask, "{}", material.name);
        for texture in material.textures.iter().flatten() {
            assert!((texture.image as usize) < scene.images.len());
        }
    }
    for image in &scene.images {
        assert_eq!(image.mips.len(), 9);
        assert_eq!(image.mips[0].len(), (image.width * image.height * 4) as usize);
    }
}

/// Each fifth frame of a recording: x, y, z, yaw.
fn recorded(name: &str) -> Vec<[f32; 4]> {
    let recording = load(name).unwrap();
    let frames = recording.file().frames.iter().step_by(5);
    frames
        .map(|frame| {
            let [x, y, z] = frame.head.position.as_vec3().to_array();
            let ahead = frame.head.rotation * DVec3::NEG_Z;
            [x, y, z, (-ahead.x).atan2(-ahead.z) as f32]
        })
        .collect()
}

fn check_clearance(scene: &Scene, flight: &[[f32; 4]], least: f32) {
    for [x, y, z, yaw] in flight {
        let (sin, cos) = maths::sin_cos(f64::from(*yaw) / std::f64::consts::TAU);
        for side in [-EYE, 0.0, EYE] {
            let eye = Vec3::new(x + side * cos, *y, z - side * sin);
            let distance = distance_to_geometry(scene, eye);
            assert!(distance > least, "{}: {distance} m from {eye}", scene.name);
        }
    }
}

fn nearest(scene: &Scene, flight: &[[f32; 4]]) -> f32 {
    flight
        .iter()
        .map(|[x, y, z, _]| distance_to_geometry(scene, Vec3::new(*x, *y, *z)))
        .fold(f32::MAX, f32::min)
}

#[test]
fn small_scenes_are_whole() {
    for (scene, materials) in [(&*STREET, 24), (&*TEMPLE, 16)] {
        check_structure(scene);
        check_materials(scene, materials);
        assert!((40_000..60_000).contains(&scene.triangle_count()), "{}", scene.triangle_count());
    }
}

#[test]
fn medium_scenes_are_whole() {
    for scene in [street(Size::Medium), temple(Size::Medium)] {
        check_structure(&scene);
        assert!((450_000..550_000).contains(&scene.triangle_count()), "{}", scene.triangle_count());
    }
}

#[test]
fn large_scenes_are_whole() {
    for scene in [street(Size::Large), temple(Size::Large)] {
        check_structure(&scene);
        assert!((2_800_000..3_200_000).contains(&scene.triangle_count()), "{}", scene.triangle_count());
    }
}

#[test]
fn generation_is_reproducible() {
    // Whoever changes a scene on purpose raises the generator's version and pins the new hashes.
    for (scene, again, geometry, textures) in [
        (&*STREET, street as fn(Size) -> Scene, "cfb6d92fe09c7bdc", "b77d1c0abdb44c52"),
        (&*TEMPLE, temple, "deb863b693448a15", "c6af88f9eded210e"),
    ] {
        assert_eq!((&scene.sha256[..16], texture_hash(scene).as_str()), (geometry, textures));
        assert_eq!(*scene, again(Size::Small));
        assert_eq!(scene.sha256.len(), 64);
    }
}

#[test]
fn recordings_fly_through_free_space() {
    check_clearance(&STREET, &flights::BISTRO, CLEARANCE);
    // Its near plane is nearer.
    check_clearance(&STREET, &recorded("street"), 0.5);
    check_clearance(&TEMPLE, &flights::SUNTEM, CLEARANCE);
    check_clearance(&street(Size::Medium), &flights::BISTRO, CLEARANCE);
    check_clearance(&temple(Size::Medium), &flights::SUNTEM, CLEARANCE);
}

#[test]
fn recordings_come_near_walls() {
    assert!(nearest(&STREET, &flights::BISTRO) < 3.0);
    assert!(nearest(&TEMPLE, &flights::SUNTEM) < 3.0);
}

#[test]
fn scenes_lie_where_the_rain_falls() {
    for scene in [&STREET, &TEMPLE] {
        let (low, high) = scene.bounds().unwrap();
        assert!(low.x >= -60.0 && high.x <= 80.0 && low.y >= -20.0 && high.y <= 60.0, "{low} {high}");
        assert!(low.z >= -64.0 && high.z <= 82.0, "{low} {high}");
    }
}

#[test]
fn names_are_complete() {
    assert_eq!(by_name("street").as_ref(), Some(&*STREET));
    assert_eq!(by_name("temple").as_ref(), Some(&*TEMPLE));
    assert!(NAMES.contains(&STREET.name.as_str()) && NAMES.contains(&TEMPLE.name.as_str()));
    assert!(by_name("plaza").is_none() && by_name("").is_none());
}
