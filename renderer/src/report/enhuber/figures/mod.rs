//! The figures of chapter 4, each from the evaluations that have data for it.

mod counts;
mod discontinuity;
mod intersections;
mod over_time;
mod radii;
mod sizes;

use super::evaluation::{Evaluation, Scene};
use crate::Result;
use crate::report::chart::Chart;
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::results::ResultSet;

/// Every figure in the order of the thesis.
///
/// # Errors
/// A picture cannot be read.
pub fn all(set: &ResultSet) -> Result<Vec<Figure>> {
    let evaluations = Evaluation::all(set);
    let together = |wanted: &Wanted<'_>, draw: &dyn Fn(&Evaluation<'_>) -> Option<Chart>| {
        let drawn = evaluations.iter().filter_map(|evaluation| {
            Some(Drawn { setting: &evaluation.setting, chart: draw(evaluation)?, remark: evaluation.tests() })
        });
        figures(wanted, drawn.collect())
    };
    let by_scene = |wanted: &Wanted<'_>, draw: &OfScene<'_>| -> Result<Vec<Figure>> {
        let mut drawn = vec![];
        for (evaluation, scene) in each_scene(&evaluations) {
            if let Some(chart) = draw(evaluation, scene)? {
                drawn.push(Drawn { setting: &scene.setting, chart, remark: evaluation.tests() });
            }
        }
        Ok(figures(wanted, drawn))
    };
    let mut all = vec![radii::figure()?];
    all.extend(together(&TILES, &|evaluation| sizes::bars(evaluation, &["t-i", "t-e"])));
    all.extend(together(&DENSE, &|evaluation| sizes::lines(evaluation, &["dc-i", "dc-e"])));
    all.extend(together(&SPARSE, &|evaluation| sizes::lines(evaluation, &["sc-i", "sc-e"])));
    all.extend(together(&WORLD, &|evaluation| sizes::bars(evaluation, &["g"])));
    for (wanted, kind) in [(TESTS_OF_TILES, "t-e"), (TESTS_OF_CLUSTERS, "sc-e")] {
        all.extend(figures(&wanted, by_every_test(&evaluations, kind)));
    }
    all.extend(together(&FRAMES, &over_time::chart));
    all.extend(by_scene(&VIEWS, &discontinuity::views)?);
    for (wanted, kinds) in [(GROUPS_OF_VIEWS, ["t-e", "sc-e"]), (GROUPS_OF_THE_WORLD, ["g", "m"])] {
        all.extend(by_scene(&wanted, &|evaluation, scene| discontinuity::lights(evaluation, scene, kinds))?);
    }
    all.extend(by_scene(&COUNTS, &|evaluation, scene| Ok(counts::bars(set, evaluation, scene)))?);
    all.extend(by_scene(&LINES, &|evaluation, scene| Ok(counts::lines(set, evaluation, scene)))?);
    all.extend(by_scene(&SLOPES, &|evaluation, scene| Ok(counts::slopes(set, evaluation, scene)))?);
    Ok(all)
}

fn by_every_test<'a>(evaluations: &'a [Evaluation<'_>], kind: &str) -> Vec<Drawn<'a>> {
    let drawn = evaluations.iter().filter_map(|evaluation| {
        let (setting, chart) = (&evaluation.setting, intersections::chart(evaluation, kind)?);
        Some(Drawn { setting, chart, remark: String::new() })
    });
    drawn.collect()
}

/// Draws a scene of an evaluation, where there are data for it.
type OfScene<'a> = dyn Fn(&Evaluation<'_>, &Scene<'_>) -> Result<Option<Chart>> + 'a;

fn each_scene<'a, 'b>(
    evaluations: &'b [Evaluation<'a>],
) -> impl Iterator<Item = (&'b Evaluation<'a>, &'b Scene<'a>)> {
    evaluations.iter().flat_map(|evaluation| evaluation.scenes.iter().map(move |scene| (evaluation, scene)))
}

const TILES: Wanted<'static> = Wanted {
    id: "E4.2",
    title: "Tiles by size",
    caption: "Mean GPU time of a frame (ms) under 10 000 lights or, where there are no such runs, the most: assignment (everything \
              before shading) and shading, by the side of a tile in pixels. The black line is the 95 % interval of the whole.",
    missing: "needs temporal runs of T-I or T-E in two sizes at least",
};

const DENSE: Wanted<'static> = Wanted {
    id: "E4.3",
    title: "Dense clusters by size",
    caption: "Mean GPU time of a frame (ms) under 10 000 lights or, where there are no such runs, the most, over the number of \
              slices, a line a side of a tile in pixels; the least in each panel's corner.",
    missing: "needs temporal runs of DC-I or DC-E in two sizes at least",
};

const SPARSE: Wanted<'static> = Wanted {
    id: "E4.4",
    title: "Sparse clusters by size",
    missing: "needs temporal runs of SC-I or SC-E in two sizes at least",
    ..DENSE
};

const WORLD: Wanted<'static> = Wanted {
    id: "E4.5",
    title: "Cells of the world by number",
    caption: "Mean GPU time of a frame (ms) under 10 000 lights or, where there are no such runs, the most: assignment (everything \
              before shading) and shading, by the number of cells along each axis. The black line is the 95 % interval of the whole.",
    missing: "needs temporal runs of G in two sizes at least",
};

const TESTS_OF_TILES: Wanted<'static> = Wanted {
    id: "E4.6",
    title: "Tests of sphere against frustum, T-E",
    caption: "Mean GPU time of a frame (ms) under 10 000 lights or, where there are no such runs, the most: assignment (everything \
              before shading) and shading, by each test (hs half spaces; sat- axes along e edges, n to the nearest vertex, p \
              normals, v to all vertices). The black line is the 95 % interval of the whole.",
    missing: "needs temporal runs of T-E by two tests at least",
};

const TESTS_OF_CLUSTERS: Wanted<'static> = Wanted {
    id: "E4.7",
    title: "Tests of sphere against frustum, SC-E",
    missing: "needs temporal runs of SC-E by two tests at least",
    ..TESTS_OF_TILES
};

const FRAMES: Wanted<'static> = Wanted {
    id: "E4.8",
    title: "Frame time over frames",
    caption: "GPU time of each frame (ms) under 10 000 lights or, where there are no such runs, the most. M has a scale of its own. \
              Mean, standard deviation and their ratio are told by the table of variability below.",
    missing: "needs temporal runs of the methods",
};

const VIEWS: Wanted<'static> = Wanted {
    id: "E4.9",
    title: "Views of little and of much depth discontinuity",
    caption: "Of the frames that were rendered to files, tone-mapped, those of least and most depth discontinuity, under 10 000 lights or, \
              where there are no such runs, the most.",
    missing: "needs rendered frames of T-E, SC-E, G or M: replay with --exr discontinuity",
};

const GROUPS_OF_VIEWS: Wanted<'static> = Wanted {
    id: "E4.10",
    title: "Lights of tiles and of sparse clusters",
    caption: "Left: the lights of each pixel's group, blended with the frame: blue for none to red for 150, green for more. Right: how \
              many groups hold so many lights, in bins of 25; groups without lights stand apart (grey) where all groups have lists. The \
              frames are those of the views above.",
    missing: "needs rendered frames of T-E or SC-E: replay with --exr discontinuity",
};

const GROUPS_OF_THE_WORLD: Wanted<'static> = Wanted {
    id: "E4.11",
    title: "Lights of cells of the world and of models",
    missing: "needs rendered frames of G or M: replay with --exr discontinuity",
    ..GROUPS_OF_VIEWS
};

const COUNTS: Wanted<'static> = Wanted {
    id: "E4.12",
    title: "Frame time by number of lights",
    caption: "Mean GPU time of a frame (ms) under 100, 1000 and 10 000 lights, as far as they were measured, each panel with its \
              own axis: assignment (everything before shading) and shading. The black line is the 95 % interval of the whole. \
              G and M serve any number of views as they are: what an enclosing grid costs other methods they have for nothing.",
    missing: "needs temporal runs of the methods",
};

const LINES: Wanted<'static> = Wanted {
    id: "E4.13",
    title: "Frame time over lights",
    caption: "Mean GPU time (ms) at each number of lights (dots), and the least-squares lines through them.",
    missing: "needs temporal runs of a method under three numbers of lights or more",
};

const SLOPES: Wanted<'static> = Wanted {
    id: "E4.13-fit",
    title: "Slope and offset",
    caption: "Of the lines above, each panel with its own axis. The black line is the 95 % interval of measuring, cut off where \
              it reaches far.",
    ..LINES
};

#[cfg(test)]
mod tests;
