//! The candidates of a search: pure.
//!
//! Sizes go from twice the named one down to an eighth, by steps of a quarter to a half; where a method has two, by
//! halves. Those below what makes sense are left out, but for the named ones themselves. Of cells that are counted, a size is
//! that of one: fewer come first.

use crate::config::{Config, Exclude};
use crate::methods::{Method, Size, Unit};
use crate::output::{PlannedRun, planned_runs};

/// Parts of the named size, the largest first.
const FINE: [f64; 9] = [2.0, 1.5, 1.0, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125];

/// The same where two sizes vary.
const COARSE: [f64; 5] = [2.0, 1.0, 0.5, 0.25, 0.125];

/// The least size of pixels.
const LEAST_PIXELS: f64 = 4.0;

/// The least size of metres.
const LEAST_METRES: f64 = 0.25;

/// The least size of radii of the smallest light.
const LEAST_RADII: f64 = 0.25;

/// Most cells along an axis.
const MOST_CELLS: f64 = 64.0;

/// Methods like `named`, of all sizes that are tried: of those alike in their other sizes, the largest first.
pub fn ladder(named: &Method) -> Vec<Method> {
    let (kind, sizes) = (named.kind(), named.sizes());
    let parts: &[f64] = if sizes.len() > 1 { &COARSE } else { &FINE };
    let steps = kind.sizes.iter().zip(&sizes).map(|(name, &size)| {
        let mut steps: Vec<Size> =
            parts.iter().map(|&part| Size { number: step(name, size.number, part), ..size }).collect();
        steps.retain(|&step| makes_sense(name, step) || step == size);
        steps.dedup();
        steps
    });
    // The first size varies fastest.
    let products = steps.fold(vec![vec![]], |products: Vec<Vec<Size>>, steps| {
        let with = |step: Size| products.iter().map(move |sizes| [sizes.as_slice(), &[step]].concat());
        steps.iter().flat_map(|&step| with(step)).collect()
    });
    products.iter().filter(|sizes| kind.takes(sizes)).map(|sizes| kind.with_sizes(sizes)).collect()
}

/// A part of a size of this name; of cells that are counted, the count whose cells are that part as wide.
fn step(name: &str, size: f64, part: f64) -> f64 {
    if matches!(name, "CELLS" | "COLUMNS") { (size / part).round() } else { size * part }
}

/// Whether a size of this name is neither too small nor, of counts, too large.
fn makes_sense(name: &str, Size { number: size, unit }: Size) -> bool {
    match name {
        "CELLS" | "COLUMNS" => (1.0..=MOST_CELLS).contains(&size),
        // A screen has as many rows as its columns leave room for.
        "ROWS" => false,
        "PIXELS" => size >= LEAST_PIXELS,
        // A tree's memory and the time to build it grow with the cube of what a radius holds of its nodes.
        "SIZE" if unit == Unit::Own => size >= LEAST_RADII,
        // Where descent begins changes neither lists nor counts.
        "DEPTH" => false,
        _ => size >= LEAST_METRES,
    }
}

/// What a candidate shares with those that differ from it in their first size alone.
pub fn chain(run: &PlannedRun) -> String {
    let sizes = run.method.sizes();
    let others = sizes.get(1..).unwrap_or_default();
    let Config { clusters, bounds, slices, .. } = &run.config;
    format!("{others:?} {} {} {clusters:?} {bounds:?} {slices:?}", run.assign, run.test)
}

/// The runs that are tried in place of `named`, with ways of assignment, tests and choices of clusters, bounds and slices
/// as the configuration has them; and how many combinations cannot be, by a test that does not serve the method or by a rule.
pub fn candidates(named: &PlannedRun, config: &Config) -> (Vec<PlannedRun>, usize) {
    let Config { assign, test, clusters, bounds, slices, .. } = config.clone();
    let methods = ladder(&named.method);
    let all =
        planned_runs(&Config { methods, assign, test, clusters, bounds, slices, ..named.config.clone() });
    let ruled_out = |run: &PlannedRun| config.exclude.iter().any(|rule: &Exclude| rule.matches(&run.config));
    let count = all.len();
    let left: Vec<_> = all.into_iter().filter(|run| run.check().is_ok() && !ruled_out(run)).collect();
    let dropped = count - left.len();
    (left, dropped)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(named: &str) -> Vec<String> {
        ladder(&named.parse().unwrap()).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn sizes_go_from_twice_to_an_eighth_and_no_further_than_makes_sense() {
        let persp = names("indi-persp-64");
        assert_eq!(
            (persp.len(), persp[0].as_str(), persp[8].as_str()),
            (9, "indi-persp-128", "indi-persp-8")
        );
        let small =
            ["encl-ortho-1", "encl-ortho-0.75", "encl-ortho-0.5", "encl-ortho-0.375", "encl-ortho-0.25"];
        assert_eq!(names("encl-ortho-0.5"), small);
        assert_eq!(names("tiled-2"), ["tiled-4", "tiled-2"]);
        assert_eq!(names("g-20"), ["g-10", "g-13", "g-20", "g-27", "g-40", "g-53"]);
        assert_eq!(names("g-1"), ["g-1", "g-2", "g-3", "g-4", "g-5", "g-8"]);
        assert_eq!(names("ortiz-64-9-1"), ["ortiz-32-9-2", "ortiz-64-9-2", "ortiz-32-9-1", "ortiz-64-9-1"]);
        assert_eq!(names("all-lights"), ["all-lights"]);
        assert_eq!(names("hashed-0.5-3"), ["hashed-1-3", "hashed-0.5-3", "hashed-0.25-3"]);
        assert_eq!(names("hashed-0.5m-3"), ["hashed-1m-3", "hashed-0.5m-3", "hashed-0.25m-3"]);
        let slices = ["sc-e-8-20", "sc-e-4-20", "sc-e-8-10", "sc-e-4-10", "sc-e-8-5", "sc-e-4-5"];
        assert_eq!(names("sc-e-4-10"), slices, "slices are whole");
    }

    #[test]
    fn two_sizes_vary_each_by_halves() {
        let displ = names("indi-displ-64-32");
        assert_eq!(displ.len(), 25);
        let first = ["indi-displ-128-64", "indi-displ-64-64"];
        assert_eq!([displ[0].as_str(), &displ[1]], first);
        assert!(displ.contains(&"indi-displ-8-4".to_owned()));
    }

    #[test]
    fn candidates_are_the_product_without_what_cannot_be() {
        let config = Config {
            methods: vec!["indi-persp-8".parse().unwrap()],
            assign: ["brute", "scatter"].map(|name| name.parse().unwrap()).to_vec(),
            test: ["auto", "exact", "box"].map(|name| name.parse().unwrap()).to_vec(),
            exclude: vec!["method=indi-persp-4,assign=scatter".parse().unwrap()],
            ..Config::default()
        };
        let named = &planned_runs(&config)[0];
        let (runs, dropped) = candidates(named, &config);
        // Sizes 16, 12, 8, 6 and 4; boxes serve none of them, and of the last scatter is ruled out.
        assert_eq!((runs.len(), dropped), (5 * 4 - 2, 5 * 2 + 2));
        assert_eq!(chain(&runs[0]), chain(&runs[4]));
        assert_ne!(chain(&runs[0]), chain(&runs[1]));
    }
}
