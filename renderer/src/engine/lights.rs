//! The lights on the device.
//!
//! ```text
//! FrameLights ──(relative to the origin)──> staging of the slot ──(frame, where they are others)──> `lights`, `spots`, `mesh_frames`
//! ```

use crate::Result;
use crate::assign::MeshDetail;
use crate::buffers::BufferName;
use crate::clustering::{FRAME_SLOTS, SharedBuffer, make_buffer};
use crate::geometry::{self, LightMesh, VolumeKind};
use crate::gpu_interface::{LightData, MeshFrame, SpotData};
use crate::lights::{ConeFalloff, FrameLights, Light, LightTally};
use crate::pass::BufferCopy;
use crate::passes::LightUpload;
use crate::vk::{Buffer, Context, Memory};
use ash::vk;
use glam::DVec3;
use std::sync::Arc;

/// Least bytes of a buffer.
const LEAST_BYTES: u64 = 16;

/// The lights of an engine, there and on their way.
pub(super) struct DeviceLights {
    lights: Buffer,
    spots: Buffer,
    meshes: Meshes,
    staging: [Staging; FRAME_SLOTS],
    data: Vec<LightData>,
    cones: Vec<SpotData>,
    frames: Vec<MeshFrame>,
    room: Room,
    /// The revision and origin of the lights on the device.
    there: Option<(u64, DVec3)>,
    /// Whether the frame at hand brings others.
    changed: bool,
}

/// Where the host writes the lights of a frame in flight.
struct Staging {
    lights: Buffer,
    spots: Buffer,
    frames: Buffer,
}

/// The meshes around lights: those of lights, and their templates.
struct Meshes {
    frames: Buffer,
    vertices: Buffer,
    triangles: Buffer,
}

/// How many lights there is room for, and what of them is kept.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room {
    /// Most lights, and whether some have cones.
    pub tally: LightTally,
    /// How fine the meshes around them are, where these are rasterised.
    pub meshes: Option<MeshDetail>,
}

impl Room {
    /// Bytes of lights, of their cones, and of what places their meshes.
    fn bytes(self) -> [u64; 3] {
        let of =
            |wanted: bool, size: usize| if wanted { u64::from(self.tally.count) * size as u64 } else { 0 };
        [
            of(true, size_of::<LightData>()),
            of(self.tally.spots, size_of::<SpotData>()),
            of(self.meshes.is_some(), size_of::<MeshFrame>()),
        ]
    }

    /// How many lights have what is kept where `wanted`.
    fn count(self, wanted: bool) -> usize {
        if wanted { self.tally.count as usize } else { 0 }
    }
}

impl Meshes {
    /// The templates of all meshes of a detail, and room for what places them.
    fn new(context: &Arc<Context>, detail: Option<MeshDetail>, frames: u64) -> Result<Self> {
        let meshes = detail.map(|detail| detail.meshes()).unwrap_or_default();
        let templates: Vec<_> = meshes.into_iter().map(LightMesh::new).collect();
        let vertices: Vec<[f32; 4]> = templates
            .iter()
            .flat_map(|mesh| &mesh.vertices)
            .map(|vertex| vertex.as_vec4().to_array())
            .collect();
        let word = |&[a, b, c]: &[u16; 3]| u32::from(a) | u32::from(b) << 10 | u32::from(c) << 20;
        let triangles: Vec<u32> = templates.iter().flat_map(|mesh| &mesh.triangles).map(word).collect();
        let written = |name: BufferName, bytes: &[u8]| {
            let size = LEAST_BYTES.max(bytes.len() as u64);
            let buffer = make_buffer(context, name, size, Memory::Upload)?;
            buffer.write(0, bytes);
            Ok::<_, crate::Error>(buffer)
        };
        Ok(Self {
            frames: make_buffer(context, BufferName::MeshFrames, frames, Memory::Device)?,
            vertices: written(BufferName::MeshVertices, bytemuck::cast_slice(&vertices))?,
            triangles: written(BufferName::MeshTriangles, bytemuck::cast_slice(&triangles))?,
        })
    }
}

impl DeviceLights {
    /// Room for so many lights, and the templates of their meshes.
    pub fn new(context: &Arc<Context>, room: Room) -> Result<Self> {
        let [lights, spots, frames] = room.bytes().map(|bytes| bytes.max(LEAST_BYTES));
        let staged = |name, bytes| {
            Buffer::new(context, name, bytes, vk::BufferUsageFlags::TRANSFER_SRC, Memory::Upload)
        };
        let staging = || {
            Ok::<_, crate::Error>(Staging {
                lights: staged("light staging", lights)?,
                spots: staged("spot staging", spots)?,
                frames: staged("mesh staging", frames)?,
            })
        };
        Ok(Self {
            lights: make_buffer(context, BufferName::Lights, lights, Memory::Device)?,
            spots: make_buffer(context, BufferName::Spots, spots, Memory::Device)?,
            meshes: Meshes::new(context, room.meshes, frames)?,
            staging: [staging()?, staging()?],
            data: Vec::with_capacity(room.count(true)),
            cones: Vec::with_capacity(room.count(room.tally.spots)),
            frames: Vec::with_capacity(room.count(room.meshes.is_some())),
            room,
            there: None,
            changed: false,
        })
    }

    /// What an engine with so many lights needs for them, bytes.
    pub fn bytes(room: Room) -> u64 {
        (FRAME_SLOTS as u64 + 1) * room.bytes().iter().sum::<u64>()
    }

    /// The buffers that shaders see.
    pub fn shared(&self) -> [SharedBuffer<'_>; 5] {
        let Meshes { frames, vertices, triangles } = &self.meshes;
        [
            (BufferName::Lights, [&self.lights; FRAME_SLOTS]),
            (BufferName::Spots, [&self.spots; FRAME_SLOTS]),
            (BufferName::MeshFrames, [frames; FRAME_SLOTS]),
            (BufferName::MeshVertices, [vertices; FRAME_SLOTS]),
            (BufferName::MeshTriangles, [triangles; FRAME_SLOTS]),
        ]
    }

    /// Writes the lights relative to the origin, unless the device has them so already.
    pub fn write(&mut self, slot: usize, lights: FrameLights, origin: DVec3) {
        let wanted = Some((lights.revision, origin));
        self.changed = self.there != wanted;
        if !self.changed {
            return;
        }
        self.there = wanted;
        self.data.clear();
        self.data.extend(lights.list.iter().map(|light| light_data(light, origin)));
        self.staging[slot].lights.write(0, &self.data);
        if self.room.tally.spots {
            self.cones.clear();
            self.cones.extend(lights.list.iter().map(spot_data));
            self.staging[slot].spots.write(0, &self.cones);
        }
        if self.room.meshes.is_some() {
            self.frames.clear();
            self.frames.extend(lights.list.iter().map(|light| mesh_frame(light, origin)));
            self.staging[slot].frames.write(0, &self.frames);
        }
    }

    /// What the frame in `slot` copies.
    pub fn upload(&self, slot: usize) -> LightUpload<'_> {
        let Staging { lights, spots, frames } = &self.staging[slot];
        let copy = |from, to, bytes: usize| BufferCopy {
            from,
            to,
            offset: 0,
            size: if self.changed { bytes as u64 } else { 0 },
        };
        LightUpload {
            copies: [
                copy(lights, &self.lights, size_of_val(self.data.as_slice())),
                copy(spots, &self.spots, size_of_val(self.cones.as_slice())),
                copy(frames, &self.meshes.frames, size_of_val(self.frames.as_slice())),
            ],
            count: self.data.len() as u32,
        }
    }
}

/// What places the mesh around a light in a frame with this origin.
fn mesh_frame(light: &Light, origin: DVec3) -> MeshFrame {
    (&geometry::MeshFrame::of(&light.volume(origin))).into()
}

/// A light as shaders read it in a frame with this origin.
fn light_data(light: &Light, origin: DVec3) -> LightData {
    LightData {
        position: (light.place() - origin).as_vec3().to_array(),
        r1: light.r1,
        tint: light.tint,
        intensity: light.intensity,
        cutoff: light.cutoff,
        r0: light.r0,
        kind: if light.spot.is_some() { VolumeKind::Sector } else { VolumeKind::Sphere } as u32,
        ..Default::default()
    }
}

/// A light's cone as shaders read it.
fn spot_data(light: &Light) -> SpotData {
    let Some(spot) = &light.spot else {
        let ConeFalloff { scale, offset } = ConeFalloff::NONE;
        return SpotData {
            radius: light.r1,
            scale: scale as f32,
            offset: offset as f32,
            cosine: -1.0,
            ..Default::default()
        };
    };
    let ConeFalloff { scale, offset } = spot.falloff();
    let (middle, radius) = spot.sector(DVec3::ZERO, light.r1.into()).bounding_sphere();
    SpotData {
        axis: spot.direction,
        along: middle.length() as f32,
        radius: radius as f32,
        scale: scale as f32,
        offset: offset as f32,
        cosine: libm::cos(spot.outer.into()) as f32,
        ..Default::default()
    }
}
