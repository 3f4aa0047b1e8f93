//! The figures of chapters 2 to 7, each from the evaluations that have data for it.

mod computed;
mod nodes;
mod over;
mod overdraw;
mod parts;
mod pictures;
mod plans;
mod shares;
mod trees;

use super::evaluation::Evaluation;
use super::octree::{construction, depth, indices, texels};
use crate::Result;
use crate::report::chart::Chart;
use crate::report::claim::mean;
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::results::{ResultSet, metric};
use plans::Plan;

/// Every figure in the order of the thesis.
///
/// # Errors
/// A picture cannot be read or encoded.
pub fn all(set: &ResultSet) -> Result<Vec<Figure>> {
    let evaluations = Evaluation::all(set);
    let planned =
        |plans: &[Plan]| plans.iter().flat_map(|plan| plan.figures(&evaluations)).collect::<Vec<_>>();
    let drawn = |wanted: &Wanted<'_>, draw: &dyn Fn(&Evaluation<'_>) -> Option<Chart>| {
        let drawn = evaluations.iter().filter_map(|evaluation| {
            let (chart, setting) = (draw(evaluation)?, &evaluation.setting);
            Some(Drawn { setting, chart, remark: String::new() })
        });
        figures(wanted, drawn.collect())
    };
    let [fading, material, colors] = computed::figures()?;
    let mut all = vec![fading, material];
    all.extend(pictures::scenes(&evaluations)?);
    all.push(colors);
    all.extend(drawn(&OVERDRAW, &overdraw::chart));
    all.extend(pictures::gbuffers(&evaluations)?);
    all.extend(planned(&plans::PIPELINES));
    all.extend(planned(&plans::TILES));
    all.extend(shares::TILES.figures(&evaluations)?);
    all.extend(planned(&plans::TILES_ON_AVERAGE));
    all.extend(drawn(&PARTS, &parts::chart));
    all.extend(planned(&plans::CLUSTERS));
    all.extend(shares::CLUSTERS.figures(&evaluations)?);
    all.extend(planned(&plans::CLUSTERS_ON_AVERAGE));
    all.extend(drawn(&BUILDING_BY_SEED, &trees::construction_by_seed));
    all.extend(drawn(&MEMORY_BY_SEED, &trees::memory_by_seed));
    for (wanted, what, of) in BY_NODE {
        all.extend(drawn(&wanted, &|evaluation| nodes::by_lights(evaluation, what, of)));
    }
    all.extend(drawn(&STEPS, &trees::steps));
    for (wanted, what, of) in STORED_BY_NODE {
        all.extend(drawn(&wanted, &|evaluation| nodes::by_lights(evaluation, what, of)));
    }
    all.extend(drawn(&SIDES, &trees::sides));
    all.extend(planned(&plans::NODES));
    all.extend(drawn(&TIME_BY_NODE, &|evaluation| {
        nodes::by_lights(evaluation, "frame ms", |run| mean(run, metric::FRAME))
    }));
    all.extend(drawn(&COMPUTATIONS_BY_NODE, &|evaluation| {
        nodes::by_lights(evaluation, "computations", |run| mean(run, metric::COMPUTATIONS))
    }));
    all.extend(shares::NODES.figures(&evaluations)?);
    for (wanted, what, of) in BY_DEPTH {
        all.extend(drawn(&wanted, &|evaluation| nodes::by_depth(evaluation, what, of)));
    }
    all.extend(drawn(&TIME_BY_DEPTH, &|evaluation| {
        nodes::by_depth(evaluation, "frame ms", |run| mean(run, metric::FRAME))
    }));
    all.extend(planned(&plans::COMPARED));
    Ok(all)
}

const OVERDRAW: Wanted<'static> = Wanted {
    id: "T4.1",
    title: "Overdraw",
    caption: "Fragments that are shaded in a frame over pixels, forward, frame by frame. With a prepass none is shaded that something hides.",
    missing: "needs runs with pipeline forward",
};

const PARTS: Wanted<'static> = Wanted {
    id: "T6.8",
    title: "Clusters over frames, by stage",
    caption: "GPU time of a frame (ms) by the clustered method of the size with most runs, under the most lights and with the most pixels. \
              In the thesis sorting keys takes the most, for it reads them back.",
    missing: "needs temporal runs of clustered-mm",
};

/// A figure, what its row is called, and the number that it is of.
type OfOctree = (Wanted<'static>, &'static str, nodes::Number);

const NEEDS_SIZES: &str = "needs runs of hashed with two sizes of nodes at least, in radii";
const NEEDS_SEEDS: &str = "needs runs of hashed with two seeds at least: --octree seed-1,seed-2";

const BUILDING_BY_SEED: Wanted<'static> = Wanted {
    id: "T7.15",
    title: "Building octrees, by seed",
    caption: "What the host takes to build the octree (ms, the least over all builds), over the seed of its hashes, a line a set of lights.",
    missing: NEEDS_SEEDS,
};

const MEMORY_BY_SEED: Wanted<'static> = Wanted {
    id: "T7.16",
    title: "Memory of octrees, by seed",
    caption: "Bytes of tables and light indices of each depth, over the seed of the hashes, under the most lights.",
    missing: NEEDS_SEEDS,
};

const BY_NODE: [OfOctree; 2] = [
    (
        Wanted {
            id: "T7.17",
            title: "Depth of octrees over the size of nodes",
            caption: "Depth of the deepest leaves, a line a set of lights.",
            missing: NEEDS_SIZES,
        },
        "depth",
        depth,
    ),
    (
        Wanted {
            id: "T7.18",
            title: "Building octrees over the size of nodes",
            caption: "What the host takes to build the octree (ms, the least over all builds), a line a set of lights.",
            missing: NEEDS_SIZES,
        },
        "building ms",
        construction,
    ),
];

const STEPS: Wanted<'static> = Wanted {
    id: "T7.19",
    title: "Steps of building octrees over the size of nodes",
    caption: "What the host takes for each step (ms, the least over all builds), under the fewest and the most lights.",
    missing: NEEDS_SIZES,
};

const STORED_BY_NODE: [OfOctree; 2] = [
    (
        Wanted {
            id: "T7.20",
            title: "Texels over the size of nodes",
            caption: "Slots and offsets of all tables, m³ + r³ each, a line a set of lights.",
            missing: NEEDS_SIZES,
        },
        "texels",
        texels,
    ),
    (
        Wanted {
            id: "T7.21",
            title: "Light indices over the size of nodes",
            caption: "Light indices of all leaves, a line a set of lights.",
            missing: NEEDS_SIZES,
        },
        "light indices",
        indices,
    ),
];

const SIDES: Wanted<'static> = Wanted {
    id: "T7.22",
    title: "Sides of tables over the size of nodes",
    caption: "Slots m and offsets r along an axis of the tables of branches (structure) and of filled leaves (data), a line a depth, under the most \
              lights.",
    missing: NEEDS_SIZES,
};

const BY_DEPTH: [OfOctree; 3] = [
    (
        Wanted {
            id: "T7.30",
            title: "Building octrees over the size of nodes, by starting depth",
            caption: "What the host takes to build the octree (ms, the least over all builds), under the most lights.",
            missing: NEEDS_SIZES,
        },
        "building ms",
        construction,
    ),
    (
        Wanted {
            id: "T7.31",
            title: "Texels over the size of nodes, by starting depth",
            caption: "Slots and offsets of all tables, m³ + r³ each, under the most lights.",
            missing: NEEDS_SIZES,
        },
        "texels",
        texels,
    ),
    (
        Wanted {
            id: "T7.32",
            title: "Light indices over the size of nodes, by starting depth",
            caption: "Light indices of all leaves, under the most lights.",
            missing: NEEDS_SIZES,
        },
        "light indices",
        indices,
    ),
];

const TIME_BY_NODE: Wanted<'static> = Wanted {
    id: "T7.27",
    title: "Frame time over the size of nodes",
    caption: "Mean GPU time of a frame (ms), a line a set of lights, with as many pixels as most sizes. The thesis calls this texels, by a caption \
              that belongs to another of its figures.",
    missing: "needs temporal runs of hashed with two sizes of nodes at least, in radii",
};

const COMPUTATIONS_BY_NODE: Wanted<'static> = Wanted {
    id: "T7.28",
    title: "Lighting computations over the size of nodes",
    caption: "Evaluations of a light for a fragment in a frame, mean over the frames, a line a set of lights, with as many pixels as most sizes. The \
              thesis calls this light indices, by a caption that belongs to another of its figures.",
    missing: "needs runs of hashed with two sizes of nodes at least, in radii",
};

const TIME_BY_DEPTH: Wanted<'static> = Wanted {
    id: "T7.33",
    title: "Frame time over the size of nodes, by starting depth",
    caption: "Mean GPU time of a frame (ms), a line a starting depth, under the most lights, with as many pixels as most sizes.",
    missing: "needs temporal runs of hashed with two sizes of nodes at least, in radii",
};

#[cfg(test)]
mod tests;
