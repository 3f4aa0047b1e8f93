//! What shaders know of spot lights and light meshes, against the host's.

use super::*;
use crate::cpu;
use crate::geometry::{
    Hexahedron, LightMesh, LightVolume, MeshFrame, MeshKind, OrientedBox, Plane, SphereLevel, SphericalSector,
};
use crate::gpu_interface::{self, GridData};
use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;

/// Random numbers in steps that single precision has.
struct Random(Pcg32);

impl Random {
    fn new() -> Self {
        Self(Pcg32::seed_from_u64(15))
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        let part = f64::from(self.0.next_u32()) / f64::from(u32::MAX);
        f64::from((low + part * (high - low)) as f32)
    }

    fn direction(&mut self) -> DVec3 {
        let any = DVec3::from_array([(); 3].map(|()| self.between(-1.0, 1.0)));
        any.try_normalize().unwrap_or(DVec3::X)
    }

    /// A sector with its apex so near to a place that it may reach it.
    fn sector(&mut self, around: DVec3) -> SphericalSector {
        let range = self.between(0.5, 15.0);
        let half_angle =
            [self.between(0.5, 4.0), self.between(4.0, 90.0), 90.0][self.0.next_u32() as usize % 3];
        let apex = (around + self.direction() * self.between(0.0, 1.2 * range)).as_vec3().as_dvec3();
        SphericalSector { apex, axis: self.direction(), range, half_angle: half_angle.to_radians() }
    }
}

fn buffer<T: Pod>(context: &Arc<Context>, values: &[T]) -> Buffer {
    let size = size_of_val(values) as u64;
    let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
    let buffer = Buffer::new(context, "test", size, usage, Memory::Readback).unwrap();
    buffer.write(0, values);
    buffer
}

/// What `words` leaves in the last of the buffers, bound in their order, whose words are all 0 before.
fn run(
    context: &Arc<Context>,
    words: &[u32],
    inputs: &[&Buffer],
    (groups, results): ([u32; 3], usize),
) -> Vec<u32> {
    let bindings = Bindings::new(context, &vec![vk::DescriptorType::STORAGE_BUFFER; inputs.len() + 1]);
    let pipeline = compute_pipeline(context, bindings.layout, words, "test", &[]).unwrap();
    let found = buffer(context, &vec![0u32; results]);
    for (binding, buffer) in (0..).zip(inputs.iter().copied().chain([&found])) {
        bindings.buffer(binding, buffer);
    }
    bindings.dispatch_grid(&pipeline, groups);
    found.read(0, results)
}

const CONES: &str = "#version 460
#extension GL_EXT_scalar_block_layout : require
#include \"lib/cone.glsl\"
layout(local_size_x = 64) in;
struct Pair { vec3 apex; float range; vec3 axis; float sine; float cosine; uint is_box; vec3 first, second; vec3 axes[3]; };
layout(scalar, binding = 0) readonly buffer Pairs { Pair pairs[]; };
layout(scalar, binding = 1) buffer Found { uint found[]; };
void main() {
    Pair pair = pairs[gl_GlobalInvocationID.x];
    Sector sector = Sector(pair.apex, pair.range, pair.axis, pair.sine, pair.cosine);
    sector = grown_sector(sector, 2e-5);
    Solid cell = pair.is_box != 0u ? solid_of_box(pair.first, pair.second, mat3(pair.axes[0], pair.axes[1], pair.axes[2]))
                                   : solid_of_piece(pair.first.xy, pair.second.xy, vec2(pair.first.z, pair.second.z));
    found[gl_GlobalInvocationID.x] = uint(sector_meets(cell, sector)) | uint(sector_separates(cell, sector)) << 1;
}
";

/// A pair as [`CONES`] reads it: of a piece of a frustum, low and high tangents and the two ends; of a box, centre and half extent.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Pair {
    apex: [f32; 3],
    range: f32,
    axis: [f32; 3],
    sine: f32,
    cosine: f32,
    is_box: u32,
    first: [f32; 3],
    second: [f32; 3],
    axes: [[f32; 3]; 3],
}

/// The corners and planes between tangents and between two z.
fn piece(low: DVec2, high: DVec2, ends: [f64; 2]) -> Hexahedron {
    let corner = |at: usize| {
        let (x, y) = (if at & 1 == 0 { low.x } else { high.x }, if at & 2 == 0 { low.y } else { high.y });
        DVec3::new(x, y, -1.0) * -ends[at >> 2]
    };
    let side = |normal: DVec3| Plane { normal: normal.normalize(), offset: 0.0 };
    let planes = [
        side(DVec3::new(1.0, 0.0, low.x)),
        side(-DVec3::new(1.0, 0.0, high.x)),
        side(DVec3::new(0.0, 1.0, low.y)),
        side(-DVec3::new(0.0, 1.0, high.y)),
        Plane { normal: DVec3::Z, offset: -ends[1] },
        Plane { normal: DVec3::NEG_Z, offset: ends[0] },
    ];
    Hexahedron { corners: std::array::from_fn(corner), planes }
}

/// A random pair for the device, and the same for the host.
fn pair(random: &mut Random) -> (Pair, Hexahedron, SphericalSector) {
    let is_box = random.0.next_u32() % 2 == 1;
    let extent = |random: &mut Random| {
        if random.0.next_u32() < u32::MAX / 8 { 0.0 } else { random.between(0.02, 3.0) }
    };
    let (first, second, axes) = if is_box {
        let x = random.direction();
        let y = x.any_orthonormal_vector();
        let center = DVec3::from_array([(); 3].map(|()| random.between(-20.0, 20.0)));
        (center, DVec3::from_array([(); 3].map(|()| extent(random))), [x, y, x.cross(y)])
    } else {
        let low = DVec2::new(random.between(-1.2, 1.0), random.between(-1.2, 1.0));
        let (size, near) =
            (DVec2::new(random.between(0.01, 0.3), random.between(0.01, 0.3)), random.between(0.1, 20.0));
        let high = (low + size).as_vec2().as_dvec2();
        let far = f64::from((near * random.between(1.0, 1.5)) as f32);
        (low.extend(-near), high.extend(-far), DVec3::AXES)
    };
    let cell = if is_box {
        Hexahedron::of_box(&OrientedBox { center: first, half_extent: second, axes })
    } else {
        piece(first.truncate(), second.truncate(), [first.z, second.z])
    };
    let sector = random.sector(cell.corners.iter().sum::<DVec3>() / 8.0);
    let single = |vector: DVec3| vector.as_vec3().to_array();
    let device = Pair {
        apex: single(sector.apex),
        range: sector.range as f32,
        axis: single(sector.axis),
        sine: sector.half_angle.sin() as f32,
        cosine: sector.half_angle.cos() as f32,
        is_box: is_box.into(),
        first: single(first),
        second: single(second),
        axes: axes.map(single),
    };
    (device, cell, sector)
}

/// No pair that meets is lost by either test, and both answer as the host where it is not too close to call.
#[test]
fn sectors_are_tested_as_on_the_host() {
    let mut random = Random::new();
    let pairs: Vec<_> = (0..64 * 512).map(|_| pair(&mut random)).collect();
    let mut found = vec![];
    silently(|context| {
        let words = shaders(&[("cones.comp", CONES)]).compile("cones.comp", &[]).unwrap();
        let device: Vec<Pair> = pairs.iter().map(|(device, ..)| *device).collect();
        found = run(context, &words, &[&buffer(context, &device)], ([512, 1, 1], pairs.len()));
    });
    let (mut meets, mut separate, mut close) = (0, 0, 0);
    for ((device, cell, sector), found) in pairs.iter().zip(found) {
        let exact = cell.sector_margin(sector);
        let separation = cell.separation_margin(sector);
        assert!(exact < 0.0 || found == 1, "lost, {exact}, {found}: {device:?}");
        let enough = 3e-4 / sector.half_angle.sin();
        close += u32::from(exact.abs() < enough);
        assert!(exact.abs() < enough || (found & 1 == 1) == (exact >= 0.0), "{exact}, {found}: {device:?}");
        assert!(
            separation.abs() < enough || (found & 2 == 2) == (separation < 0.0),
            "{separation}, {found}: {device:?}"
        );
        meets += found & 1;
        separate += found >> 1;
    }
    assert!(
        meets > 5000 && separate > 5000 && close < 3000,
        "{meets} meet, {separate} separate, {close} are close"
    );
}

/// What stands for the buffers of an engine: those of [`shells_are_made_as_on_the_host`].
fn buffers() -> String {
    let declared = [
        "readonly buffer Grid { GridData grid; }",
        "readonly buffer Planes { float slice_planes[]; }",
        "readonly buffer Vertices { vec4 mesh_vertices[]; }",
        "readonly buffer Triangles { uint mesh_triangles[]; }",
        "readonly buffer Frames { MeshFrame light_frames[]; }",
        "buffer Ranges { uint shell_ranges[]; }",
    ];
    let declare = |(binding, text): (usize, &str)| format!("layout(scalar, binding = {binding}) {text};\n");
    gpu_interface::glsl() + &declared.into_iter().enumerate().map(declare).collect::<String>()
}

/// Ranges of all lights and tiles, to the bit, of meshes of points and of spots: around the eye, behind it, cut by the near and the
/// far plane.
#[test]
fn shells_are_made_as_on_the_host() {
    let dimensions = [13, 7, 20];
    let planes: Vec<f32> =
        (0..=20).map(|plane| (0.4 * 125f64.powf(f64::from(plane) / 20.0)) as f32).collect();
    let step = 125f64.log2() / 20.0;
    let grid = GridData {
        dimensions,
        origin: [-1.0, -0.6, planes[0]],
        cell: [2.0 / 13.0, 1.3 / 7.0, step as f32],
        scale: [6.5, 7.0 / 1.3, (1.0 / step) as f32],
        ..Zeroable::zeroed()
    };
    let mut random = Random::new();
    let places: Vec<DVec3> = (0..150)
        .map(|_| {
            let depth = random.between(-3.0, 60.0);
            DVec3::new(depth * random.between(-1.2, 1.2), depth * random.between(-0.8, 0.8), -depth)
        })
        .collect();
    let sectors: Vec<SphericalSector> = places.into_iter().map(|place| random.sector(place)).collect();
    for kind in [MeshKind::Sphere(SphereLevel::V42), MeshKind::Spot] {
        let mesh = LightMesh::new(kind);
        let frame = |sector: &SphericalSector| {
            let volume = match kind {
                MeshKind::Spot => LightVolume::sector(*sector),
                MeshKind::Sphere(_) => LightVolume::sphere(sector.apex, sector.range),
            };
            gpu_interface::MeshFrame::from(&MeshFrame::of(&volume))
        };
        let frames: Vec<_> = sectors.iter().map(frame).collect();
        let on_host: Vec<u32> =
            frames.iter().flat_map(|frame| host_shell(&grid, &planes, &mesh, frame)).collect();
        let some = on_host.iter().filter(|range| **range != u32::MAX).count();
        assert!(some > 500 && on_host.len() - some > 500, "{some} of {}", on_host.len());
        silently(|context| {
            assert_eq!(device_shell(context, (&grid, &planes), &mesh, &frames), on_host, "{kind:?}")
        });
    }
}

fn host_shell(
    grid: &GridData,
    planes: &[f32],
    mesh: &LightMesh,
    frame: &gpu_interface::MeshFrame,
) -> Vec<u32> {
    let shell = cpu::placed_shell(&cpu::ShellGrid { grid, planes }, mesh, frame);
    shell.into_iter().map(cpu::SliceRange::to_word).collect()
}

fn device_shell(
    context: &Arc<Context>,
    (grid, planes): (&GridData, &[f32]),
    mesh: &LightMesh,
    frames: &[gpu_interface::MeshFrame],
) -> Vec<u32> {
    let generated = vec![("generated/gpu_interface.glsl".to_owned(), buffers())];
    let library = ShaderLibrary::new(None, generated).unwrap().with_cache(None);
    let is_spot = frames[0].tip != [0.0; 3];
    let defines = [
        ("SPACE", "SPACE_PERSPECTIVE".into()),
        ("SLICES", "SLICES_GEOMETRIC".into()),
        ("MESH", if is_spot { "MESH_SPOT" } else { "MESH_SPHERE" }.into()),
        ("MESH_VERTICES", mesh.vertices.len().to_string()),
        ("MESH_TRIANGLES", mesh.triangles.len().to_string()),
        ("FIRST_VERTEX", "0".into()),
        ("FIRST_TRIANGLE", "0".into()),
    ];
    let words = library.compile("raster/shell.comp", &defines).unwrap();
    let vertices: Vec<[f32; 4]> = mesh.vertices.iter().map(|vertex| vertex.as_vec4().to_array()).collect();
    let triangle = |&[a, b, c]: &[u16; 3]| u32::from(a) | u32::from(b) << 10 | u32::from(c) << 20;
    let triangles: Vec<u32> = mesh.triangles.iter().map(triangle).collect();
    let tiles = grid.dimensions[0] * grid.dimensions[1];
    let inputs = [
        buffer(context, std::slice::from_ref(grid)),
        buffer(context, planes),
        buffer(context, &vertices),
        buffer(context, &triangles),
        buffer(context, frames),
    ];
    let groups = [frames.len() as u32, 1, 1];
    run(context, &words, &inputs.each_ref(), (groups, (tiles as usize) * frames.len()))
}

/// No device here need have the hardware for it.
#[test]
fn shaders_that_draw_meshes_compile_for_hardware_and_without() {
    let generated = vec![("generated/gpu_interface.glsl".to_owned(), buffers())];
    let library = ShaderLibrary::new(None, generated).unwrap().with_cache(None);
    let words = ["0", "1"].map(|hardware| {
        let defines = [
            ("SPACE", "SPACE_PERSPECTIVE"),
            ("SLICES", "SLICES_GEOMETRIC"),
            ("MESH", "MESH_SPHERE"),
            ("FIRST_VERTEX", "0"),
            ("FIRST_TRIANGLE", "0"),
            ("HARDWARE", hardware),
        ];
        library.compile("raster/shell.vert", &defines.map(|(name, value)| (name, value.to_owned()))).unwrap()
    });
    assert!(words[0] != words[1]);
}
