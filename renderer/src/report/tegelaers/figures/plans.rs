//! The figures that are lines over frames, lights or pixels, each a row of a table.

use super::over::{Over, Row, frames, means};
use crate::report::chart::Chart;
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::results::metric;
use crate::report::tegelaers::evaluation::{Corner, Evaluation, Pipeline};
use crate::report::tegelaers::lines::{self, Line};

/// A figure, before there are data for it.
pub struct Plan {
    /// Its number.
    id: &'static str,
    title: &'static str,
    /// The runs that it needs.
    needs: &'static str,
    lines: fn(&Evaluation<'_>, Pipeline) -> Vec<Line>,
    of: Of,
    over: Abscissa,
    within: Within,
}

/// What is drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Of {
    Time,
    /// Of building lists, all stages that cluster.
    Building,
    Computations,
}

/// What it is drawn over.
#[derive(Clone, Copy)]
enum Abscissa {
    /// In the corners of what was measured.
    Frames(&'static [(Corner, &'static str)]),
    Means(Over),
}

/// Whose runs are drawn.
#[derive(Clone, Copy)]
enum Within {
    One(Pipeline),
    /// A row each.
    Each,
    /// In one panel: the lines are of both.
    Both,
    /// That in which the thesis counts.
    Counting,
}

const FEW: (Corner, &str) = (Corner::Few, "few lights and pixels");
const MANY: (Corner, &str) = (Corner::Many, "many lights and pixels");
const FRAMES: Abscissa = Abscissa::Frames(&[FEW, MANY]);
const LIGHTS: Abscissa = Abscissa::Means(Over::Lights);
const PIXELS: Abscissa = Abscissa::Means(Over::Pixels);
const FORWARD: Within = Within::One(Pipeline::Forward);
const DEFERRED: Within = Within::One(Pipeline::Deferred);

/// The pipelines (chapter 4).
pub static PIPELINES: [Plan; 3] = [
    pipelines("T4.4", "Forward and deferred over frames", FRAMES),
    pipelines("T4.7", "Forward and deferred over lights", LIGHTS),
    pipelines("T4.8", "Forward and deferred over pixels", PIXELS),
];

const fn pipelines(id: &'static str, title: &'static str, over: Abscissa) -> Plan {
    let needs = "temporal runs of all-lights, in both pipelines at best";
    Plan {
        id,
        title,
        needs,
        lines: |evaluation, _| lines::pipelines(evaluation),
        of: Of::Time,
        over,
        within: Within::Both,
    }
}

/// Tiles up to the heat maps (chapter 5).
pub static TILES: [Plan; 3] = [
    tiles("T5.5", "Tiles over frames, forward", (Of::Time, FRAMES), FORWARD),
    tiles("T5.6", "Tiles over frames, deferred", (Of::Time, FRAMES), DEFERRED),
    Plan {
        lines: lines::tile_sizes,
        ..tiles("T5.7", "Lighting computations of tiles over frames", COUNTED_FRAMES, Within::Counting)
    },
];

/// Tiles after them.
pub static TILES_ON_AVERAGE: [Plan; 6] = [
    tile_sizes("T5.9", "Tiles over lights", (Of::Time, LIGHTS), Within::Each),
    tile_sizes(
        "T5.10",
        "Lighting computations of tiles over lights",
        (Of::Computations, LIGHTS),
        Within::Counting,
    ),
    grids("T5.11", "Building tiles over lights", LIGHTS),
    tile_sizes("T5.12", "Tiles over pixels", (Of::Time, PIXELS), Within::Each),
    tile_sizes(
        "T5.13",
        "Lighting computations of tiles over pixels",
        (Of::Computations, PIXELS),
        Within::Counting,
    ),
    grids("T5.14", "Building tiles over pixels", PIXELS),
];

const COUNTED_FRAMES: (Of, Abscissa) = (Of::Computations, FRAMES);

const fn tiles(id: &'static str, title: &'static str, (of, over): (Of, Abscissa), within: Within) -> Plan {
    let needs = "runs of all-lights and tiled-mm";
    Plan { id, title, needs, lines: lines::naive_and_tiled, of, over, within }
}

const fn tile_sizes(id: &'static str, title: &'static str, what: (Of, Abscissa), within: Within) -> Plan {
    Plan { lines: lines::tile_sizes, ..tiles(id, title, what, within) }
}

const fn grids(id: &'static str, title: &'static str, over: Abscissa) -> Plan {
    let needs = "temporal runs of tiled-mm";
    Plan { needs, lines: lines::tiles, ..tiles(id, title, (Of::Building, over), Within::Counting) }
}

/// Clusters up to the heat maps (chapter 6).
pub static CLUSTERS: [Plan; 1] = [clusters("T6.9", "Lighting computations of clusters over frames", FRAMES)];

/// Clusters after them.
pub static CLUSTERS_ON_AVERAGE: [Plan; 2] = [
    clusters("T6.11", "Lighting computations of clusters over lights", LIGHTS),
    clusters("T6.12", "Lighting computations of clusters over pixels", PIXELS),
];

const fn clusters(id: &'static str, title: &'static str, over: Abscissa) -> Plan {
    let needs = "runs of all-lights, tiled-mm and clustered-mm";
    Plan {
        id,
        title,
        needs,
        lines: lines::cluster_sizes,
        of: Of::Computations,
        over,
        within: Within::Counting,
    }
}

/// Hashed methods by the size of nodes, over frames (chapter 7).
pub static NODES: [Plan; 4] = [
    nodes("T7.23", "Nodes by size over frames, few lights", Of::Time, &[FEW]),
    nodes("T7.24", "Nodes by size over frames, many lights", Of::Time, &[MANY]),
    nodes(
        "T7.25",
        "Lighting computations by size of nodes over frames, few lights",
        Of::Computations,
        &[FEW],
    ),
    nodes(
        "T7.26",
        "Lighting computations by size of nodes over frames, many lights",
        Of::Computations,
        &[MANY],
    ),
];

const fn nodes(
    id: &'static str,
    title: &'static str,
    of: Of,
    corners: &'static [(Corner, &'static str)],
) -> Plan {
    let (needs, over) = ("runs of hashed", Abscissa::Frames(corners));
    Plan { id, title, needs, lines: lines::nodes, of, over, within: Within::Counting }
}

/// All methods compared (chapter 7).
pub static COMPARED: [Plan; 9] = [
    compared("T7.34", "Hashed methods and tiles over frames, forward", FRAMES, FORWARD),
    compared("T7.35", "Hashed methods and tiles over frames, deferred", FRAMES, DEFERRED),
    counted("T7.36", "Lighting computations of all methods over frames", FRAMES),
    compared("T7.37", "Hashed methods and tiles over lights, forward", LIGHTS, FORWARD),
    compared("T7.38", "Hashed methods and tiles over lights, deferred", LIGHTS, DEFERRED),
    compared("T7.39", "Hashed methods and tiles over pixels, forward", PIXELS, FORWARD),
    compared("T7.40", "Hashed methods and tiles over pixels, deferred", PIXELS, DEFERRED),
    counted("T7.41", "Lighting computations of all methods over lights", LIGHTS),
    counted("T7.42", "Lighting computations of all methods over pixels", PIXELS),
];

const fn compared(id: &'static str, title: &'static str, over: Abscissa, within: Within) -> Plan {
    let needs = "temporal runs of all-lights, tiled-mm and hashed";
    Plan { id, title, needs, lines: lines::all_but_clusters, of: Of::Time, over, within }
}

const fn counted(id: &'static str, title: &'static str, over: Abscissa) -> Plan {
    let needs = "runs of all-lights, tiled-mm, clustered-mm and hashed";
    Plan { id, title, needs, lines: lines::all, of: Of::Computations, over, within: Within::Counting }
}

impl Plan {
    /// A figure an evaluation that has data for it.
    pub fn figures(&self, evaluations: &[Evaluation<'_>]) -> Vec<Figure> {
        let drawn = evaluations.iter().filter_map(|evaluation| {
            let (chart, setting) = (self.chart(evaluation)?, &evaluation.setting);
            Some(Drawn { setting, chart, remark: self.remark(evaluation) })
        });
        let caption = format!("{}{}", self.of.caption(), self.over.caption());
        let missing = format!("needs {}{}{}", self.needs, self.within.needs(), self.over.needs());
        let wanted = Wanted { id: self.id, title: self.title, caption: &caption, missing: &missing };
        figures(&wanted, drawn.collect())
    }

    fn chart(&self, evaluation: &Evaluation<'_>) -> Option<Chart> {
        let rows = self.rows(evaluation);
        match self.over {
            Abscissa::Frames(corners) => frames(evaluation, &rows.first()?.lines, self.of.metric(), corners),
            Abscissa::Means(over) => means(evaluation, rows, self.of.metric(), over),
        }
    }

    fn rows(&self, evaluation: &Evaluation<'_>) -> Vec<Row> {
        let row = |pipeline: Pipeline| {
            let name = format!("{} ({})", self.of.name(), pipeline.name());
            Row { name, lines: (self.lines)(evaluation, pipeline) }
        };
        match self.within {
            Within::One(pipeline) => vec![row(pipeline)],
            Within::Each => Pipeline::BOTH.map(row).into(),
            Within::Both => vec![Row { name: self.of.name().into(), ..row(Pipeline::Forward) }],
            Within::Counting => vec![row(evaluation.counting())],
        }
    }

    /// In which pipeline was counted, where neither title nor rows say it.
    fn remark(&self, evaluation: &Evaluation<'_>) -> String {
        match (self.within, self.over) {
            (Within::Counting, Abscissa::Frames(_)) => {
                format!(" Pipeline: {}.", evaluation.counting().name())
            }
            _ => String::new(),
        }
    }
}

impl Of {
    fn metric(self) -> &'static str {
        match self {
            Self::Time => metric::FRAME,
            Self::Building => metric::CLUSTER,
            Self::Computations => metric::COMPUTATIONS,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Time => "frame ms",
            Self::Building => "building ms",
            Self::Computations => "computations",
        }
    }

    fn caption(self) -> &'static str {
        match self {
            Self::Time => "GPU time of a frame (ms)",
            Self::Building => {
                "GPU time of all that builds light lists (ms; the thesis builds them on the CPU)"
            }
            Self::Computations => "Evaluations of a light for a fragment in a frame",
        }
    }
}

impl Abscissa {
    fn caption(self) -> &'static str {
        match self {
            Self::Frames(corners) if corners.len() > 1 => {
                ", frame by frame: with the fewest lights and pixels that all methods drawn were measured with, and with the most."
            }
            Self::Frames(_) => {
                ", frame by frame, with as many lights and pixels as all methods drawn were measured with."
            }
            Self::Means(Over::Lights) => {
                ", mean over the frames, at each number of lights; with as many pixels as most was measured with."
            }
            Self::Means(Over::Pixels) => {
                ", mean over the frames, at each number of pixels of a view; under as many lights as most was measured with."
            }
        }
    }

    fn needs(self) -> &'static str {
        match self {
            Self::Frames(_) => "",
            Self::Means(Over::Lights) => ", under two numbers of lights at least",
            Self::Means(Over::Pixels) => ", at two resolutions at least",
        }
    }
}

impl Within {
    fn needs(self) -> &'static str {
        match self {
            Self::One(Pipeline::Forward) => " with pipeline forward",
            Self::One(Pipeline::Deferred) => " with pipeline deferred",
            Self::Each | Self::Both | Self::Counting => "",
        }
    }
}
