//! All methods shade a frame as brute force over all lights does, at one sample a pixel and at four.

use super::{Context, Verdict, samples};
use crate::Result;
use crate::assign::Marking;
use crate::measure::{FrameCounts, ViewPixels};
use crate::output::tone_map;

/// Most that a colour may differ after tone mapping, in steps of 1/255: sums of lights round otherwise.
const MOST_MAPPED: u8 = 1;
/// Most that it may differ in HDR, in parts of itself.
const MOST_RELATIVE: f32 = 0.005;

/// Pictures and counts of every method fit those of the truth.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let mut pictures = 0;
    let counts = samples::counts(context)?;
    for &samples in &counts {
        let looks = &context.frames(samples)?.looks;
        let truth = &looks[0];
        for look in &looks[1..] {
            let faults =
                look.pixels.iter().zip(&truth.pixels).find_map(|(view, truth)| picture_fault(view, truth));
            let fault = faults.or_else(|| count_fault(&look.counts, &truth.counts, Marking::Depth));
            if let Some(fault) = fault {
                return Ok(Verdict::Wrong(format!("{} at {samples} samples a pixel: {fault}", look.method)));
            }
            pictures += look.pixels.len();
        }
    }
    let samples = counts.iter().map(u32::to_string).collect::<Vec<_>>().join(" and ");
    Ok(Verdict::Fine(format!("{pictures} pictures at {samples} samples a pixel equal those of all lights")))
}

/// How a picture differs from that of all lights by more than rounding, if it does.
pub fn picture_fault(view: &ViewPixels, truth: &ViewPixels) -> Option<String> {
    let (mapped, relative) = difference(view, truth);
    (mapped > MOST_MAPPED || relative > MOST_RELATIVE)
        .then(|| format!("view {} is {mapped}/255, and {relative} in HDR, from all lights", view.name))
}

/// Largest differences of colour between two pictures of one size: after tone mapping in steps of 1/255, and relative in
/// HDR.
pub fn difference(a: &ViewPixels, b: &ViewPixels) -> (u8, f32) {
    let rgb = |pixels: &ViewPixels, at: usize| [0, 1, 2].map(|channel| pixels.color[at][channel].to_f32());
    let mut most = (0, 0.0f32);
    for at in 0..a.color.len() {
        let (x, y) = (rgb(a, at), rgb(b, at));
        let (mapped_x, mapped_y) = (tone_map(x), tone_map(y));
        for channel in 0..3 {
            most.0 = most.0.max(mapped_x[channel].abs_diff(mapped_y[channel]));
            let scale = x[channel].abs().max(y[channel].abs()).max(1e-3);
            most.1 = most.1.max((x[channel] - y[channel]).abs() / scale);
        }
    }
    most
}

/// What of a method's counts cannot be, if anything, given those of all lights in the same frame after a prepass. With overdraw
/// what is hidden needs lights as well.
pub fn count_fault(counts: &FrameCounts, truth: &FrameCounts, marking: Marking) -> Option<String> {
    let (own, all) = (&counts.counters, &truth.counters);
    let (shaded, hidden) = (own.fragments_shaded, own.fragments_hidden);
    let seen = shaded.wrapping_sub(hidden);
    let marked: u64 =
        counts.clusterings.iter().flat_map(|c| &c.clusters).map(|c| u64::from(c.fragments)).sum();
    // The depth buffer holds one surface a sample; where several of equal depth meet, each is shaded.
    let coplanar = if marking == Marking::Geometry { 0 } else { seen / 50 };
    let by_lights: u64 = counts.lights_per_fragment.iter().flatten().map(|(_, fragments)| fragments).sum();
    let grouped = !counts.clusterings.is_empty();
    // Where no light reaches, an octree has no leaf.
    let of_leaves = counts.clusterings.iter().any(|clustering| clustering.octree.is_some());
    let in_the_dark: u64 = counts
        .lights_per_fragment
        .iter()
        .flatten()
        .filter(|(lights, _)| of_leaves && *lights == 0)
        .map(|(_, n)| n)
        .sum();
    let dropped = counts.light_indices_dropped() + counts.visible_clusters_dropped();
    let faults = [
        (own.fragments_without_cluster > 0, "fragments find no cluster"),
        (seen != all.fragments_shaded, "other fragments are shaded than by all lights"),
        (own.needed_computations < all.needed_computations, "lights that are needed are lost"),
        (
            hidden == 0 && own.needed_computations > all.needed_computations,
            "more lights are needed than by all",
        ),
        (own.lighting_computations < own.needed_computations, "fewer lights are evaluated than needed"),
        (
            grouped && (marked > seen || seen - marked > coplanar + in_the_dark),
            "other fragments are marked than shaded",
        ),
        (by_lights != shaded, "the histogram of lights per fragment is not of all fragments"),
        (dropped > 0, "clusters or light indices were dropped"),
    ];
    faults.into_iter().find(|(is, _)| *is).map(|(_, what)| format!("{what} ({own:?}, all lights {all:?})"))
}
