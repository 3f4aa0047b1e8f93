//! Lighting computations of pixels relative to the naive method's (5.8, 6.10, 7.29).

use super::pictures::pictured;
use crate::Result;
use crate::methods::Method;
use crate::report::chart::{Chart, Plot};
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::pictures::{Kind, shown};
use crate::report::results::Picture;
use crate::report::tegelaers::evaluation::{CLUSTERED, Case, Evaluation, Scene, TILED, name};
use std::collections::BTreeMap;
use std::path::Path;

/// A figure: the frame, then a heat map a method.
pub struct Shares {
    wanted: Wanted<'static>,
    methods: fn(&Evaluation<'_>) -> Vec<Method>,
}

/// Tiles of every size.
pub const TILES: Shares = Shares {
    wanted: Wanted {
        id: "T5.8",
        title: "Computations of pixels by tiles",
        missing: "needs rendered frames of tiled-mm: replay with --exr and frame numbers",
        ..NODES.wanted
    },
    methods: |evaluation| evaluation.methods(TILED),
};

/// Tiles of one size, and clusters of every size.
pub const CLUSTERS: Shares = Shares {
    wanted: Wanted {
        id: "T6.10",
        title: "Computations of pixels by clusters",
        missing: "needs rendered frames of clustered-mm: replay with --exr and frame numbers",
        ..NODES.wanted
    },
    methods: |evaluation| {
        let clusters = evaluation.methods(CLUSTERED);
        // Tiles alone are the figure before.
        let tiles = evaluation.chosen(TILED).filter(|_| !clusters.is_empty());
        tiles.into_iter().chain(clusters).collect()
    },
};

/// Nodes of every size.
pub const NODES: Shares = Shares {
    wanted: Wanted {
        id: "T7.29",
        title: "Computations of pixels by nodes",
        caption: "A frame under the fewest lights, then, under the most with pictures of most methods, the lights that are computed for each \
                  pixel as a part of all, which is what the naive method computes: black for none, white for all (the colours of T3.5), dark grey \
                  where nothing was hit.",
        missing: "needs rendered frames of hashed: replay with --exr and frame numbers",
    },
    methods: |evaluation| evaluation.nodes(),
};

/// A run with one of its pictures, and the heat map of that.
type Seen<'a> = (&'a Case<'a>, &'a Picture, &'a Path);

impl Shares {
    /// A figure an evaluation that has heat maps: a row a scene.
    ///
    /// # Errors
    /// A picture cannot be read.
    pub fn figures(&self, evaluations: &[Evaluation<'_>]) -> Result<Vec<Figure>> {
        let mut drawn = vec![];
        for evaluation in evaluations {
            if let Some(chart) = self.chart(evaluation)? {
                let remark = format!(" Pipeline: {}.", evaluation.counting().name());
                drawn.push(Drawn { setting: &evaluation.setting, chart, remark });
            }
        }
        Ok(figures(&self.wanted, drawn))
    }

    /// `None` where there are no heat maps.
    fn chart(&self, evaluation: &Evaluation<'_>) -> Result<Option<Chart>> {
        let mut methods = (self.methods)(evaluation);
        let of_scene = |scene| (scene, seen(evaluation, scene, &methods));
        let mut found: Vec<(&Scene<'_>, Vec<Seen<'_>>)> = evaluation.scenes.iter().map(of_scene).collect();
        found.retain(|(_, seen)| !seen.is_empty());
        let is_seen = |method: &Method| {
            found.iter().flat_map(|(_, seen)| seen).any(|seen| seen.0.run.method == *method)
        };
        methods.retain(is_seen);
        let mut chart = Chart {
            names: ["scene", "method", "picture", "number"],
            columns: [vec!["frame".to_owned()], methods.iter().map(|&method| name(method)).collect()]
                .concat(),
            rows: found.iter().map(|(scene, _)| scene.name()).collect(),
            ..Chart::default()
        };
        for (scene, seen) in &found {
            chart.panels.push(frame(scene, seen[0].1.frame)?);
            for method in &methods {
                let of_method = seen.iter().find(|(case, ..)| case.run.method == *method);
                chart.panels.push(of_method.map(drawn_share).transpose()?);
            }
        }
        Ok((!chart.rows.is_empty()).then_some(chart))
    }
}

/// The frame itself.
fn frame(scene: &Scene<'_>, number: u32) -> Result<Option<Plot>> {
    let found = pictured(scene, |run| run.pictures.iter().find(|picture| picture.frame == number));
    let alt = format!("Frame {number} of {}", scene.setting.scene);
    found.map(|picture| shown(&picture.image, number, alt, Kind::Photo)).transpose()
}

fn drawn_share((case, picture, path): &Seen<'_>) -> Result<Plot> {
    let alt = format!("Computations of frame {} by {}, {}", picture.frame, case.run.method, case.size());
    shown(path, picture.frame, alt, Kind::Drawing)
}

/// The heat maps of methods where most of them have one, of as many the most pixels and lights: of the first frame that has one.
fn seen<'a>(evaluation: &Evaluation<'_>, scene: &'a Scene<'a>, methods: &[Method]) -> Vec<Seen<'a>> {
    let pipeline = evaluation.counting();
    let of_methods =
        scene.cases.iter().filter(|case| case.pipeline == pipeline && methods.contains(&case.run.method));
    let mut places: BTreeMap<(u64, u32), Vec<Seen<'a>>> = BTreeMap::new();
    for case in of_methods {
        let first =
            case.run.pictures.iter().find_map(|picture| Some((case, picture, picture.share.as_deref()?)));
        if let Some(first) = first {
            places.entry((case.pixels, case.lights)).or_default().push(first);
        }
    }
    places.into_values().max_by_key(Vec::len).unwrap_or_default()
}
