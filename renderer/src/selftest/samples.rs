//! Where the samples of a pixel lie, by the rasteriser and by the table that clusters are found with.

use super::{Context, Verdict};
use crate::Result;
use crate::buffers::BufferName;
use crate::config::Scopes;
use crate::engine::{COUNTING_SLOT, Mode, nothing, variant};
use crate::lights::LightTally;
use crate::methods::Method;
use crate::pass::{BufferCopy, Recorder};
use crate::passes::{Frame, probes};
use crate::vk::{Buffer, Memory};
use ash::vk;

/// Samples a pixel besides one.
const MANY: u32 = 4;
/// How far a sample may lie from its place, in parts of 65 536 of a pixel: a sixteenth, which is how finely positions are
/// given.
const MOST: u32 = 4096;

/// The numbers of samples that the device can render so that clusters of samples are found.
pub fn counts(context: &mut Context) -> Result<Vec<u32>> {
    let limits = &context.frames(1)?.session.context.limits;
    let many = limits.sample_counts.contains(&MANY)
        && limits.standard_sample_locations
        && limits.sample_rate_shading;
    Ok(if many { vec![1, MANY] } else { vec![1] })
}

/// Samples lie where the table says.
pub fn check(context: &mut Context) -> Result<Verdict> {
    if !counts(context)?.contains(&MANY) {
        return Ok(Verdict::Note("the device cannot shade four samples a pixel at known places".into()));
    }
    let [fragments, said, ran] = measure(context)?;
    if fragments == 0 {
        return Ok(Verdict::Wrong("nothing was drawn".into()));
    }
    let pixels = |parts: u32| f64::from(parts) / 65_536.0;
    let off = said.max(ran);
    Ok(Verdict::of(
        (off > MOST).then(|| format!("a sample lies {:.3} pixels from its place", pixels(off))),
        || format!("{MANY} samples a pixel lie at their places in {fragments} fragments"),
    ))
}

/// Fragments, and how far the places that the driver tells and those where fragments run are from the table's, at most.
fn measure(context: &mut Context) -> Result<[u32; 3]> {
    let (frames, inputs) = context.frames_and_inputs(MANY)?;
    let method: Method = "indi-persp-64".parse()?;
    let run = frames.run(method);
    frames.with_engine(inputs, (method, Scopes::All), |engine, session, input| {
        let variant = variant(&run, &Mode::counting(&run, LightTally::of(input.1.list)));
        let probe = session.store.surface_probe(&variant, "selftest/sample_positions.frag")?;
        engine.bind(session, std::slice::from_ref(&probe))?;
        let (usage, size) = (vk::BufferUsageFlags::TRANSFER_DST, size_of::<[u32; 3]>() as u64);
        let target = Buffer::new(&session.context, "sample positions", size, usage, Memory::Readback)?;
        let mut draw = |r: &mut Recorder, frame: &Frame| {
            probes::surfaces(r, frame, &probe);
            let from = &frame.clusterings[0].buffers[BufferName::Measurements];
            r.copy(&BufferCopy { from, to: &target, offset: 0, size });
            r.hand_over(&target);
        };
        engine.render(session, COUNTING_SLOT, input, (&mut nothing, &mut draw))?;
        let words: Vec<u32> = target.read(0, 3);
        Ok([words[0], words[1], words[2]])
    })
}
