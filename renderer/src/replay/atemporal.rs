//! The atemporal run: every frame once, with everything counted and read back; nothing is timed.

use super::RunSink;
use crate::Result;
use crate::engine::{Counted, Engine, FramePlan, Session};
use crate::frame::Frame;
use crate::geometry::views::View;
use crate::gpu_interface::{ClusteringState, PixelData};
use crate::lights::LightSource;
use crate::measure::{FrameCounts, ViewPixels};
use crate::methods::MethodSpec;
use crate::pass::Recorder;
use crate::passes::{mark, pixel_maps, readback};
use crate::vk::{Buffer, Memory};
use ash::vk;
use half::f16;

/// The slot that atemporal frames use: each is read before the next begins.
pub const SLOT: usize = 0;

/// Renders and counts one frame; where `view_names` are given, its pixels come too, a view each.
pub fn count_frame(
    engine: &mut Engine,
    session: &mut Session,
    plan: &FramePlan,
    lights: &mut LightSource,
    (time_s, view_names): (f64, Option<&[String]>),
    sink: &mut dyn RunSink,
) -> Result<(FrameCounts, Vec<ViewPixels>)> {
    let resolution = engine.resolution();
    let images = image_buffers(session, resolution, view_names.map_or(0, <[String]>::len))?;
    let lights = lights.at_frame(plan.frame);
    loop {
        let mut look_closer = |r: &mut Recorder, frame: &Frame| {
            if frame.clustered {
                (0..frame.clusterings.len()).for_each(|c| mark::count_fragments(r, frame, c));
            }
            for (view, buffer) in images.iter().enumerate() {
                pixel_maps::record(r, frame, view, buffer);
            }
        };
        engine.submit(session, SLOT, plan, lights, (&mut readback::clear_counters, &mut look_closer))?;
        session.slots[SLOT].wait()?;
        if !engine.grow_if_needed(session, SLOT, plan.frame)? {
            break;
        }
    }
    let counts = read_counts(engine, session, plan, (lights.len() as u32, time_s), sink)?;
    counts.check()?;
    let views = images.iter().zip(view_names.unwrap_or_default()).zip(plan.views.iter().enumerate());
    let pixels = views.map(|((buffer, name), (number, view))| ViewPixels {
        dimensions: grid_of(plan, number),
        ..view_pixels(buffer, name, view, resolution)
    });
    Ok((counts, pixels.collect()))
}

/// Cells a side of the grid that view `number` looks up; zeros where there is none.
fn grid_of(plan: &FramePlan, number: usize) -> [u32; 3] {
    plan.grids.get(number).or(plan.grids.first()).map_or([0; 3], |grid| grid.dimensions)
}

fn image_buffers(session: &Session, resolution: [u32; 2], count: usize) -> Result<Vec<Buffer>> {
    let size = pixel_maps::view_bytes(resolution).iter().sum();
    let usage = vk::BufferUsageFlags::TRANSFER_DST;
    (0..count)
        .map(|_| Buffer::new(&session.context, "image readback", size, usage, Memory::Readback))
        .collect()
}

fn read_counts(
    engine: &mut Engine,
    session: &mut Session,
    plan: &FramePlan,
    (lights, time_s): (u32, f64),
    sink: &mut dyn RunSink,
) -> Result<FrameCounts> {
    let states = engine.states(session, SLOT);
    let clustered = engine.method() != MethodSpec::AllLights;
    let views = plan.views.len() as u32;
    let mut counts = FrameCounts { frame: plan.frame, time_s, views, ..Default::default() };
    for (c, state) in states.into_iter().enumerate() {
        let state = if clustered { state } else { ClusteringState::default() };
        let read = Counted::read(engine, session, (SLOT, plan.frame, c), (state, lights))?;
        read.check(lights)?;
        counts.counters.add(&read.counters);
        counts.lights_per_fragment.push(read.lights_per_fragment());
        if clustered {
            let capacity = engine.capacities().light_indices;
            counts.clusterings.push(read.clustering(plan.grids[c].dimensions, capacity));
            sink.lists(read.lists)?;
        }
    }
    Ok(counts)
}

fn view_pixels(buffer: &Buffer, name: &str, view: &View, resolution: [u32; 2]) -> ViewPixels {
    let [color_bytes, _] = pixel_maps::view_bytes(resolution);
    let [width, height] = resolution;
    let count = (width * height) as usize;
    let color: Vec<[u16; 4]> = buffer.read(0, count);
    let pixels: Vec<PixelData> = buffer.read(color_bytes, count);
    ViewPixels {
        name: name.to_owned(),
        width,
        height,
        color: color.into_iter().map(|texel| texel.map(f16::from_bits)).collect(),
        depth: pixels.iter().map(|p| p.distance).collect(),
        light_count: pixels.iter().map(|p| p.light_count).collect(),
        fragment_count: pixels.iter().map(|p| p.fragment_count).collect(),
        cluster_index: pixels.iter().map(|p| p.cluster_index).collect(),
        dimensions: [0; 3],
        world_from_view: view.world_from_view(),
        clip_from_view: view.clip_from_view(),
    }
}
