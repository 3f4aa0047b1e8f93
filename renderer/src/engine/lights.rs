//! The lights on the device.
//!
//! ```text
//! FrameLights ──(relative to the origin)──> staging of the slot ──(frame, where they are others)──> `lights`, `spots`
//! ```

use crate::Result;
use crate::buffers::BufferName;
use crate::clustering::{FRAME_SLOTS, SharedBuffer, make_buffer};
use crate::geometry::VolumeKind;
use crate::gpu_interface::{LightData, SpotData};
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
    staging: [Staging; FRAME_SLOTS],
    data: Vec<LightData>,
    cones: Vec<SpotData>,
    has_spots: bool,
    /// The revision and origin of the lights on the device.
    there: Option<(u64, DVec3)>,
    /// Whether the frame at hand brings others.
    changed: bool,
}

/// Where the host writes the lights of a frame in flight.
struct Staging {
    lights: Buffer,
    spots: Buffer,
}

/// Bytes of lights and of their cones.
fn bytes(tally: LightTally) -> [u64; 2] {
    let count = u64::from(tally.count);
    [
        count * size_of::<LightData>() as u64,
        if tally.spots { count * size_of::<SpotData>() as u64 } else { 0 },
    ]
}

impl DeviceLights {
    /// Room for so many lights.
    pub fn new(context: &Arc<Context>, tally: LightTally) -> Result<Self> {
        let [lights, spots] = bytes(tally).map(|bytes| bytes.max(LEAST_BYTES));
        let staged = |name, bytes| {
            Buffer::new(context, name, bytes, vk::BufferUsageFlags::TRANSFER_SRC, Memory::Upload)
        };
        let staging = || {
            Ok::<_, crate::Error>(Staging {
                lights: staged("light staging", lights)?,
                spots: staged("spot staging", spots)?,
            })
        };
        Ok(Self {
            lights: make_buffer(context, BufferName::Lights, lights, Memory::Device)?,
            spots: make_buffer(context, BufferName::Spots, spots, Memory::Device)?,
            staging: [staging()?, staging()?],
            data: Vec::with_capacity(tally.count as usize),
            cones: Vec::with_capacity(if tally.spots { tally.count as usize } else { 0 }),
            has_spots: tally.spots,
            there: None,
            changed: false,
        })
    }

    /// What an engine with so many lights needs for them, bytes.
    pub fn bytes(tally: LightTally) -> u64 {
        (FRAME_SLOTS as u64 + 1) * bytes(tally).iter().sum::<u64>()
    }

    /// The buffers that shaders see.
    pub fn shared(&self) -> [SharedBuffer<'_>; 2] {
        [(BufferName::Lights, [&self.lights; FRAME_SLOTS]), (BufferName::Spots, [&self.spots; FRAME_SLOTS])]
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
        if self.has_spots {
            self.cones.clear();
            self.cones.extend(lights.list.iter().map(spot_data));
            self.staging[slot].spots.write(0, &self.cones);
        }
    }

    /// What the frame in `slot` copies.
    pub fn upload(&self, slot: usize) -> LightUpload<'_> {
        let Staging { lights, spots } = &self.staging[slot];
        let size = |bytes: usize| if self.changed { bytes as u64 } else { 0 };
        LightUpload {
            copies: [
                BufferCopy {
                    from: lights,
                    to: &self.lights,
                    offset: 0,
                    size: size(size_of_val(self.data.as_slice())),
                },
                BufferCopy {
                    from: spots,
                    to: &self.spots,
                    offset: 0,
                    size: size(size_of_val(self.cones.as_slice())),
                },
            ],
            count: self.data.len() as u32,
        }
    }
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
