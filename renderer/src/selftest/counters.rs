//! The same frame twice: once with every stage timed, once with the frame timed alone, so that no timestamp between passes
//! makes one wait for another. A device that does one thing after the other hides what does not wait; with the validation layers
//! on, these tell.

use super::frames::{Look, METHODS};
use super::{Context, Verdict};
use crate::Result;
use crate::config::Scopes;

/// All methods count and shade alike both times.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let (frames, inputs) = context.frames_and_inputs(1)?;
    for (place, method) in METHODS.into_iter().enumerate() {
        let again = frames.look(inputs, method, Scopes::Frame)?;
        if let Some(fault) = unlike(&frames.looks[place], &again) {
            return Ok(Verdict::Wrong(fault));
        }
    }
    Ok(Verdict::Fine(format!("{} methods count and shade alike in two replays of a frame", METHODS.len())))
}

fn unlike(first: &Look, second: &Look) -> Option<String> {
    let method = first.method;
    let [a, b] = [first, second].map(|look| look.counts.counters);
    if a != b {
        return Some(format!("{method} counts {a:?}, then {b:?}"));
    }
    if first.counts != second.counts {
        return Some(format!("{method} has other lists or clusters the second time"));
    }
    let pixels = first.pixels.iter().zip(&second.pixels);
    let differing = pixels.filter(|(a, b)| a != b).count();
    (differing > 0).then(|| format!("{method} shades {differing} views otherwise the second time"))
}
