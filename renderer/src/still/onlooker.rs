//! Looks at a frame that has ended, from any camera, and changes nothing of it.

use super::camera::{self, Camera};
use super::compose::{self, Layers};
use super::record::{self, Drawing, Outputs};
use super::{Base, Show};
use crate::clustering::view_data;
use crate::config::Config;
use crate::engine::{COUNTING_SLOT as SLOT, Engine, FramePlan, Mode, Session};
use crate::geometry::views::View;
use crate::gpu_interface::PixelData;
use crate::gpu_scene::GpuScene;
use crate::measure::ViewPixels;
use crate::passes::pixel_maps;
use crate::pipelines::{DebugPipelines, Line};
use crate::vk::{Buffer, Memory};
use crate::{Result, engine};
use ash::vk;
use half::f16;
use image::RgbImage;

/// One who looks at a frame from somewhere.
pub struct Onlooker<'a> {
    /// How the frame was rendered: the configuration of its run.
    pub run: &'a Config,
    /// Names of the recording's views.
    pub names: &'a [String],
    /// The frame that is looked at.
    pub plan: &'a FramePlan,
    /// Camera that looks.
    pub camera: Camera,
    /// What the picture shows.
    pub show: Show,
}

/// What an onlooker sees.
pub struct Seen {
    /// Picture as a display shows it.
    pub image: RgbImage,
    /// Colour in linear light, and everything known of the pixels.
    pub pixels: ViewPixels,
}

impl Onlooker<'_> {
    /// Looks from `eye` at the frame that `engine`, made for `mode`, counted last; `shaded` are its views,
    /// `lines`, relative to its origin, lie over the picture.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn look(
        &self,
        session: &mut Session,
        engine: &mut Engine,
        (mode, eye): (&Mode, &View),
        (shaded, lines): (Vec<ViewPixels>, &[Line]),
    ) -> Result<Seen> {
        let pipelines = session.store.debug(&engine::variant(self.run, mode))?;
        engine.bind(session, &pipelines.all)?;
        let layers = self.layers(session, engine, (&pipelines, eye), (shaded, lines))?;
        let empty = self.empty_pixels(eye);
        let (image, pixels) = compose::compose(&self.show, &layers, &self.plan.grids, empty);
        Ok(Seen { image, pixels })
    }

    /// The camera in the world; `shaded` are the frame's views.
    ///
    /// # Errors
    /// A resolution of zero.
    pub fn eye(&self, shaded: &[ViewPixels], scene: &GpuScene) -> Result<View> {
        let views = &self.plan.views;
        match self.camera {
            Camera::View(view) => Ok(views[view]),
            Camera::BirdsEye => {
                let far = views.iter().map(|view| view.frustum.far()).fold(0.0, f64::max);
                let distances = shaded.iter().flat_map(|view| view.depth.iter().copied());
                camera::birdseye(views, self.run.resolution, camera::reach(far, distances))
            }
            Camera::Placed(placed) => {
                let farthest = placed.eye.distance(scene.origin) + scene.reach;
                placed.view(views, self.run.resolution, farthest)
            }
        }
    }

    /// Draws what the camera sees. The frame has ended: what its views were is overwritten for an onlooker.
    fn layers(
        &self,
        session: &mut Session,
        engine: &mut Engine,
        (pipelines, eye): (&DebugPipelines, &View),
        (mut shaded, lines): (Vec<ViewPixels>, &[Line]),
    ) -> Result<Layers> {
        let grouped = engine.method().has_lists();
        let origin = self.plan.origin();
        let sharing = engine.method().kind().sharing;
        let all: Vec<usize> = (0..sharing.clusterings(self.plan.views.len())).collect();
        let (view, lookup, clusterings) = match self.camera {
            Camera::View(view) => (view, 0, vec![sharing.clustering_of(view)]),
            Camera::BirdsEye | Camera::Placed(_) => {
                let slot = &mut session.frame_slots[SLOT];
                slot.mirrored[0] = false;
                let near = eye.relative_to(origin);
                let data = view_data(&near, None, self.run.resolution, session.scene.reach);
                slot.views.write(0, &[data]);
                slot.draw_lists[0].update(&session.batches, std::slice::from_ref(eye));
                (0, 1, all)
            }
        };
        if self.show.no_scene {
            session.frame_slots[SLOT].draw_lists[view].update(&session.batches, &[]);
        }
        let line_buffer = (!lines.is_empty())
            .then(|| Buffer::with_data(&session.context, "lines", vk::BufferUsageFlags::VERTEX_BUFFER, lines))
            .transpose()?;
        let [color_bytes, pixel_bytes] = pixel_maps::view_bytes(self.run.resolution);
        let readback = |size| {
            let usage = vk::BufferUsageFlags::TRANSFER_DST;
            Buffer::new(&session.context, "still readback", size, usage, Memory::Readback)
        };
        let (clay, overlay) = (readback(color_bytes)?, readback(color_bytes)?);
        let known: Vec<Buffer> = clusterings.iter().map(|_| readback(pixel_bytes)).collect::<Result<_>>()?;
        let drawing = Drawing {
            pipelines,
            view,
            lookup: grouped.then_some(lookup),
            clusterings,
            lines: line_buffer.as_ref().map(|buffer| (buffer, lines.len() as u32)),
            spheres: self.show.lights,
        };
        let gbuffer = match self.show.base {
            Base::Gbuffer => Some([readback(color_bytes)?, readback(color_bytes)?]),
            _ => None,
        };
        let outputs =
            Outputs { clay: &clay, overlay: &overlay, clusterings: &known, gbuffer: gbuffer.as_ref() };
        engine.follow_up(session, SLOT, |r, frame| record::record(r, frame, &drawing, &outputs))?;
        let pixels = self.pixel_count();
        let color = |buffer: &Buffer| {
            buffer.read::<[u16; 4]>(0, pixels).into_iter().map(|t| t.map(f16::from_bits)).collect()
        };
        let mut clusterings: Vec<Vec<PixelData>> =
            known.iter().map(|buffer| buffer.read(0, pixels)).collect();
        let distance = clusterings[0].iter().map(|pixel| pixel.distance).collect();
        if !grouped {
            clusterings.clear();
        }
        let shaded = match self.camera {
            Camera::View(view) if !self.show.no_scene => Some(shaded.swap_remove(view).color),
            Camera::View(_) | Camera::BirdsEye | Camera::Placed(_) => None,
        };
        let gbuffer = gbuffer.as_ref().map(|parts| parts.each_ref().map(color));
        Ok(Layers { shaded, clay: color(&clay), overlay: color(&overlay), clusterings, distance, gbuffer })
    }

    fn pixel_count(&self) -> usize {
        self.run.resolution.map(|side| side as usize).into_iter().product()
    }

    /// The camera's name, size and matrices.
    fn empty_pixels(&self, eye: &View) -> ViewPixels {
        let [width, height] = self.run.resolution;
        ViewPixels {
            name: self.camera.name(self.names),
            width,
            height,
            color: vec![],
            background: [0.0; 3],
            depth: vec![],
            lights: 0,
            light_count: vec![],
            fragment_count: vec![],
            cluster_index: vec![],
            dimensions: [0; 3],
            world_from_view: eye.world_from_view(),
            clip_from_view: eye.clip_from_view(),
        }
    }
}
