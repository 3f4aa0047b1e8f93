//! No fragment is shaded without its cluster, at one sample a pixel and at four.

use super::{Context, Verdict, samples};
use crate::Result;

/// All fragments of all methods find their cluster.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let mut shaded = 0;
    for samples in samples::counts(context)? {
        for look in &context.frames(samples)?.looks {
            let counters = &look.counts.counters;
            if counters.fragments_without_cluster > 0 {
                return Ok(Verdict::Wrong(format!(
                    "{} of {} fragments find no cluster by {} at {samples} samples a pixel",
                    counters.fragments_without_cluster, counters.fragments_shaded, look.method
                )));
            }
            shaded += counters.fragments_shaded;
        }
    }
    Ok(Verdict::Fine(format!("all of {shaded} fragments find their cluster")))
}
