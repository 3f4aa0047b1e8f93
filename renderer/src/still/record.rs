//! The commands of a still, after its frame has ended: what one camera sees, and what lies over it.

use crate::pass::Recorder;
use crate::passes::gbuffer_picture::{self, Shown};
use crate::passes::{
    Eyes, Frame, clay, depth, draws, gbuffer, lines, pixel_clusters, pixel_maps, resolve, spheres,
};
use crate::pipelines::DebugPipelines;
use crate::targets::TargetName;
use crate::vk::Buffer;

/// What is drawn for an onlooker.
pub struct Drawing<'a> {
    /// Pipelines of overlays and maps.
    pub pipelines: &'a DebugPipelines,
    /// Index of the camera among the views.
    pub view: usize,
    /// Index into [`DebugPipelines::pixel_clusters`] of what looks pixels up; `None` where there are no clusters.
    pub lookup: Option<usize>,
    /// Clusterings that pixels are looked up in.
    pub clusterings: Vec<usize>,
    /// Vertex buffer of [`crate::pipelines::Line`], and how many lines it holds.
    pub lines: Option<(&'a Buffer, u32)>,
    /// Whether the lights' volumes are drawn.
    pub spheres: bool,
}

/// Buffers that results go to.
pub struct Outputs<'a> {
    /// Colours of the surfaces.
    pub clay: &'a Buffer,
    /// Colours of lines and spheres.
    pub overlay: &'a Buffer,
    /// What each of the clusterings knows of the pixels.
    pub clusterings: &'a [Buffer],
    /// What the G-buffer holds, in the order of [`Shown::ALL`], where that is asked for.
    pub gbuffer: Option<&'a [Buffer; Shown::ALL.len()]>,
}

/// Records stage `still > depth, clay, pixel_clusters[c], overlay`, and `gbuffer, gbuffer_picture` where that is asked for.
pub fn record(r: &mut Recorder, frame: &Frame, drawing: &Drawing, outputs: &Outputs) {
    let view = drawing.view;
    r.scope("still", |r| {
        depth::record(r, frame, Eyes::One(view));
        clay::record(r, frame, drawing.pipelines, view);
        copy_out(r, frame, view, outputs.clay);
        let maps = &frame.pipelines.pixel_maps;
        let lookups = drawing.lookup.zip(drawing.pipelines.pixel_clusters.as_ref());
        let pipeline = lookups.map_or(maps, |(lookup, pipelines)| &pipelines[lookup]);
        for (&clustering, output) in drawing.clusterings.iter().zip(outputs.clusterings) {
            pixel_clusters::record(r, frame, pipeline, (view, clustering), output);
        }
        r.scope("overlay", |r| {
            let spheres = drawing.spheres.then(|| spheres::overlay(frame, drawing.pipelines));
            let lines = drawing.lines.map(|batch| lines::overlays(drawing.pipelines, batch));
            let overlays: Vec<_> = spheres.into_iter().chain(lines.into_iter().flatten()).collect();
            draws::overlays(r, frame, view, &overlays);
        });
        copy_out(r, frame, view, outputs.overlay);
        if let (Some(pipeline), Some(targets)) = (&drawing.pipelines.gbuffer_picture, outputs.gbuffer) {
            let surfaces = gbuffer::record(r, frame, Eyes::One(view));
            for (shown, target) in Shown::ALL.into_iter().zip(targets) {
                gbuffer_picture::record(r, frame, (pipeline, shown), (view, surfaces));
                copy_out(r, frame, view, target);
            }
        }
    });
}

fn copy_out(r: &mut Recorder, frame: &Frame, view: usize, target: &Buffer) {
    let name = TargetName::Radiance;
    resolve::resolve(r, &frame.targets[view][name], frame.resolution);
    pixel_maps::copy_target(r, frame, (view, name), target);
    r.hand_over(target);
}
