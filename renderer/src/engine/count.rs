//! A counted frame: rendered with everything counted and read back; nothing is timed.

use super::{Counted, Engine, FramePlan, Session};
use crate::Result;
use crate::geometry::views::View;
use crate::gpu_interface::{ClusteringState, PixelData};
use crate::lights::FrameLights;
use crate::measure::{ClusterLists, FrameCounts, ViewPixels};
use crate::pass::Recorder;
use crate::passes::{Frame, depth_steps, mark, pixel_maps, readback, seen, shade};
use crate::vk::{Buffer, Memory};
use ash::vk;
use half::f16;

/// The slot that counted frames use: each is read before the next begins.
pub const COUNTING_SLOT: usize = 0;

/// What is counted of one frame.
pub struct CountedFrame {
    /// Record of the frame.
    pub counts: FrameCounts,
    /// Pixels of the frame, one entry a view, where they were asked for.
    pub pixels: Vec<ViewPixels>,
}

/// Renders and counts one frame at `time_s` seconds of the recording; where names of views are given, their pixels come
/// too. `lists` takes the light lists of each clustering.
///
/// # Errors
/// Whatever fails on the device or in `lists`; counts that must never be.
pub fn count_frame(
    engine: &mut Engine,
    session: &mut Session,
    input: (&FramePlan, FrameLights),
    about: (f64, Option<&[String]>),
    lists: &mut dyn FnMut(ClusterLists) -> Result<()>,
) -> Result<CountedFrame> {
    let frame = look_at_frame(engine, session, input, about, lists)?;
    frame.counts.check()?;
    Ok(frame)
}

/// The same, whatever the counts are.
///
/// # Errors
/// Whatever fails on the device or in `lists`.
pub fn look_at_frame(
    engine: &mut Engine,
    session: &mut Session,
    (plan, lights): (&FramePlan, FrameLights),
    (time_s, view_names): (f64, Option<&[String]>),
    lists: &mut dyn FnMut(ClusterLists) -> Result<()>,
) -> Result<CountedFrame> {
    let resolution = engine.resolution();
    let images = image_buffers(session, resolution, view_names.map_or(0, <[String]>::len))?;
    let (has_lists, sharing) = (engine.method().has_lists(), engine.method().kind().sharing);
    let mut look_closer = |r: &mut Recorder, frame: &Frame| {
        seen::record(r, frame);
        if has_lists {
            (0..frame.clusterings.len()).for_each(|c| mark::count_fragments(r, frame, c));
        }
        depth_steps::record(r, frame);
        for (view, buffer) in images.iter().enumerate() {
            pixel_maps::record(r, frame, view, buffer);
        }
    };
    let extend = (&mut readback::clear_counters as _, &mut look_closer as _);
    let light_count = lights.list.len() as u32;
    engine.render(session, COUNTING_SLOT, (plan, lights), extend)?;
    let counts = read_counts(engine, session, plan, (light_count, time_s), lists)?;
    let views = images.iter().zip(view_names.unwrap_or_default()).zip(plan.views.iter().enumerate());
    let pixels = views.map(|((buffer, name), (number, view))| ViewPixels {
        dimensions: engine.dimensions(sharing.clustering_of(number)),
        lights: light_count,
        ..view_pixels(buffer, name, view, resolution)
    });
    Ok(CountedFrame { pixels: pixels.collect(), counts })
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
    lists: &mut dyn FnMut(ClusterLists) -> Result<()>,
) -> Result<FrameCounts> {
    let states = engine.states(session, COUNTING_SLOT);
    let (has_lists, assigns) = (engine.method().has_lists(), engine.method().assigns());
    let views = plan.views.len() as u32;
    let mut counts = FrameCounts { frame: plan.frame, time_s, views, ..Default::default() };
    for (c, state) in states.into_iter().enumerate() {
        let state = if assigns { state } else { ClusteringState::default() };
        let read = Counted::read(engine, session, (COUNTING_SLOT, plan.frame, c), (state, lights))?;
        read.check(lights)?;
        counts.counters.add(&read.counters);
        counts.lights_per_fragment.push(read.lights_per_fragment());
        if has_lists {
            let capacity = if assigns { engine.capacities().light_indices } else { u32::MAX };
            counts.clusterings.push(read.clustering(engine.dimensions(c), capacity));
            lists(read.lists)?;
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
        background: shade::BACKGROUND,
        depth: pixels.iter().map(|p| p.distance).collect(),
        lights: 0,
        light_count: pixels.iter().map(|p| p.light_count).collect(),
        fragment_count: pixels.iter().map(|p| p.fragment_count).collect(),
        cluster_index: pixels.iter().map(|p| p.cluster_index).collect(),
        dimensions: [0; 3],
        world_from_view: view.world_from_view(),
        clip_from_view: view.clip_from_view(),
    }
}
