//! H4, H5, H6 and H11: what octrees take.

use super::places::{Place, in_every_scene, spread, told};
use crate::methods::Method;
use crate::report::claim::{Findings, Number, Outcome, mean, milliseconds, number};
use crate::report::results::{ResultSet, metric};
use crate::report::tegelaers::evaluation::{Case, Corner, HASHED, lights, node, start_depth};
use crate::report::tegelaers::octree::{construction, memory};

/// The cube, and how far exponents may lie off it: of memory, and of times.
const CUBE: f64 = 3.0;
const OFF: [f64; 2] = [0.2, 0.5];
/// What counts as the same: memory by seed, times by seed; computations by starting depth, memory by it.
const BY_SEED: [f64; 2] = [1.01, 1.25];
const BY_DEPTH: [f64; 2] = [1.02, 1.1];

pub(super) fn cubic(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let pipeline = place.evaluation.counting();
        let methods: Vec<_> =
            place.evaluation.hashed().into_iter().map(|method| (method, pipeline)).collect();
        let cases = methods.iter().filter_map(|&of| place.case(of, &methods, Corner::Many));
        let cases: Vec<&Case<'_>> = cases.collect();
        for (what, of, off) in
            [("memory", memory as fn(&_) -> _, OFF[0]), ("time of building", construction, OFF[1])]
        {
            let point = |case: &&Case<'_>| Some((node(case.run.method)?, of(case.run)?));
            let points: Vec<(f64, f64)> = cases.iter().filter_map(point).collect();
            let exponents: Vec<Number> = points.windows(2).map(|pair| exponent(pair[1], pair[0])).collect();
            let Some(finest) = exponents.first().map(|exponent| exponent.value) else {
                findings.lack(format!(
                    "runs of {HASHED} with nodes of two sizes up to a radius, in {}",
                    place.scene.name()
                ));
                continue;
            };
            let comparison =
                format!("exponent of {what} from size to size of nodes, {}", lights(cases[0].lights));
            let outcome = Outcome::within(finest, [CUBE - off, CUBE + off]);
            findings.compare_in(place.name(), comparison, exponents, outcome);
        }
    })
}

/// By which power of the nodes along an axis a number grows from one size, in radii, to a smaller one.
fn exponent(from: (f64, f64), to: (f64, f64)) -> Number {
    number(format!("{} to {}", from.0, to.0), (to.1 / from.1).ln() / (from.0 / to.0).ln())
}

pub(super) fn seeds(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let most = place.scene.seeds.iter().map(|(_, case)| case.lights).max();
        let of_most: Vec<&(u64, Case<'_>)> =
            place.scene.seeds.iter().filter(|(_, case)| Some(case.lights) == most).collect();
        for (what, of, bound, unit) in [
            ("memory", memory as fn(&_) -> _, BY_SEED[0], "bytes"),
            ("time of building", construction, BY_SEED[1], "ms"),
        ] {
            let of_seed = |(seed, case): &&(u64, Case<'_>)| Some((*seed, of(case.run)?));
            let numbers: Vec<(u64, f64)> = of_most.iter().filter_map(of_seed).collect();
            if numbers.len() < 2 {
                findings.lack(format!(
                    "runs of {HASHED} with two seeds at least (--octree seed-1,seed-2), in {}",
                    place.scene.name()
                ));
                continue;
            }
            let values = || numbers.iter().map(|(_, value)| *value);
            let (least, greatest) = (values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max));
            let told = |name: &str, value| Number { name: name.into(), value, unit };
            let ratio = number("ratio", greatest / least);
            let numbers = vec![told("least", least), told("most", greatest), ratio];
            let comparison = format!("{what} by seed, {}", most.map_or_else(String::new, lights));
            findings.compare_in(
                place.name(),
                comparison,
                numbers,
                Outcome::within(greatest / least, [0.0, bound]),
            );
        }
    })
}

pub(super) fn starting_depths(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let pipeline = place.evaluation.counting();
        let methods: Vec<_> = by_depth(place).into_iter().map(|method| (method, pipeline)).collect();
        let cases: Option<Vec<&Case<'_>>> =
            methods.iter().map(|&of| place.case(of, &methods, Corner::Many)).collect();
        let Some(cases) = cases.filter(|cases| cases.len() > 1) else {
            return findings.lack(format!(
                "runs of {HASHED} with two starting depths of one size, in {}",
                place.scene.name()
            ));
        };
        for (what, of, bound) in [
            ("lighting computations", (|run| mean(run, metric::COMPUTATIONS)) as fn(&_) -> _, BY_DEPTH[0]),
            ("memory", memory, BY_DEPTH[1]),
        ] {
            let number_of = |case: &&Case<'_>| Some((case.run.method, of(case.run)?));
            let Some(numbers) = cases.iter().map(number_of).collect::<Option<Vec<_>>>() else { continue };
            let spread = spread(&numbers);
            let mut told = told(&numbers, "");
            told.push(number("most over least", spread));
            let comparison = format!("{what} by starting depth, {}", cases[0].size());
            findings.compare_in(place.name(), comparison, told, Outcome::within(spread, [0.0, bound]));
        }
    })
}

/// The hashed methods of the size of nodes that was measured from most starting depths.
fn by_depth(place: Place<'_>) -> Vec<Method> {
    let methods = place.evaluation.methods(HASHED);
    let of_size = |size: Method| -> Vec<Method> {
        let is_as_large = |method: &&Method| method.sizes().first() == size.sizes().first();
        methods.iter().filter(is_as_large).copied().collect()
    };
    let all = methods.iter().rev().map(|method| of_size(*method));
    let mut most = all.max_by_key(Vec::len).unwrap_or_default();
    most.sort_by(|a, b| start_depth(*a).total_cmp(&start_depth(*b)));
    most
}

pub(super) fn deepest(set: &ResultSet) -> Findings {
    in_every_scene(set, |place, findings| {
        let pipeline = place.evaluation.counting();
        let methods: Vec<_> =
            place.evaluation.hashed().into_iter().map(|method| (method, pipeline)).collect();
        let mut found = false;
        for of in &methods {
            let case = place.case(*of, &methods, Corner::Many);
            let Some((case, built)) = case.and_then(|case| Some((case, case.run.octree.as_ref()?))) else {
                continue;
            };
            let Some(all) = memory(case.run) else { continue };
            let depths = built.depths();
            let two: f64 = depths.iter().rev().take(2).map(|&depth| built.bytes_at(depth)).sum();
            let number_of = |name: &str, value| Number { name: name.into(), value, unit: "bytes" };
            let mut numbers =
                vec![number_of("two deepest", two), number_of("all", all), number("part", two / all)];
            numbers.extend(construction(case.run).map(|ms| milliseconds("building", ms)));
            let comparison =
                format!("memory by depth, {}, {}", super::places::called(case), lights(case.lights));
            findings.compare_in(place.name(), comparison, numbers, Outcome::above(two / all, 0.5));
            found = true;
        }
        if !found {
            findings.lack(format!("runs of {HASHED} with nodes up to a radius, in {}", place.scene.name()));
        }
    })
}
