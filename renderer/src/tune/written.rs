//! The configuration that replays chosen runs and no others: pure.
//!
//! Its axes hold the values of all of them; what the product has beyond that, rules leave out, as few as values can be
//! put together in: all that is unwanted on an axis in one, and what goes on alike in one.

use crate::config::{AXES, Axis, Config, Exclude};

/// A run of the product, and whether it is wanted.
type Judged<'r> = (&'r Config, bool);

/// Axes with the values that a rule names.
type Given = Vec<(&'static Axis, Vec<String>)>;

/// Axes on which rules tell the runs of a scene apart, in the order in which they are asked.
const ASKED: [&str; 5] = ["lights", "method", "clusters", "assign", "test"];

/// `config` with the methods, ways and tests of `chosen` runs in place of its own, and rules that leave those runs alone.
pub fn configuration(config: &Config, chosen: &[Config]) -> Config {
    let listed: Vec<&Config> = chosen.iter().filter(|run| run.methods[0].assigns()).collect();
    let mut whole =
        Config { methods: union(chosen.iter().map(|run| run.methods[0])), exclude: vec![], ..config.clone() };
    if !listed.is_empty() {
        whole.assign = union(listed.iter().map(|run| run.assign[0]));
        whole.test = union(listed.iter().map(|run| run.test[0]));
        whole.clusters = union(listed.iter().map(|run| run.clusters[0]));
        whole.lists = union(listed.iter().map(|run| run.lists[0]));
        whole.compaction = union(listed.iter().map(|run| run.compaction[0]));
    }
    let scenes = whole.by_scene();
    let rules = scenes.iter().flat_map(|scene| rules_of_scene(scene, scenes.len() > 1, chosen)).collect();
    Config { exclude: rules, ..whole }
}

/// What tells a run from all others, a value an axis.
fn key(run: &Config) -> Vec<String> {
    AXES.iter().map(|axis| axis.value(run)).collect()
}

fn rules_of_scene(scene: &Config, several: bool, chosen: &[Config]) -> Vec<Exclude> {
    let keys: Vec<_> = chosen.iter().map(key).collect();
    let runs = scene.cases();
    let judged: Vec<Judged> = runs.iter().map(|run| (run, keys.contains(&key(run)))).collect();
    let axes: Vec<&'static Axis> = ASKED.iter().filter_map(|name| Axis::named(name)).collect();
    let named = ["scene", "recording", "resolution"].iter().filter_map(|name| Axis::named(name));
    let given = named.filter(|_| several).map(|axis| (axis, vec![axis.value(&runs[0])]));
    rules(&judged, &axes, &given.collect())
}

fn rules(runs: &[Judged], axes: &[&'static Axis], given: &Given) -> Vec<Exclude> {
    if runs.iter().all(|(_, wanted)| *wanted) {
        return vec![];
    }
    if runs.iter().all(|(_, wanted)| !wanted) {
        return vec![Exclude::of(given)];
    }
    let Some((axis, rest)) = axes.split_first() else { return vec![] };
    let groups = alike(runs, axis, rest);
    if let [(_, of)] = groups.as_slice() {
        return rules(of, rest, given);
    }
    let of_group = |(values, of): &(Vec<String>, Vec<Judged>)| {
        let given = given.iter().cloned().chain([(*axis, values.clone())]).collect();
        rules(of, rest, &given)
    };
    groups.iter().flat_map(of_group).collect()
}

/// Values of an axis, those together that the rest of the axes go on alike with, and the runs of one of them.
fn alike<'r>(
    runs: &[Judged<'r>],
    axis: &'static Axis,
    rest: &[&'static Axis],
) -> Vec<(Vec<String>, Vec<Judged<'r>>)> {
    let mut groups: Vec<(Vec<String>, Vec<Judged>)> = vec![];
    for value in union(runs.iter().map(|(run, _)| axis.value(run))) {
        let of: Vec<Judged> = runs.iter().copied().filter(|(run, _)| axis.value(run) == value).collect();
        match groups.iter_mut().find(|(_, other)| outline(other, rest) == outline(&of, rest)) {
            Some((values, _)) => values.push(value),
            None => groups.push((vec![value], of)),
        }
    }
    groups
}

/// What runs have on the rest of the axes, and which are wanted; nothing where none is.
fn outline(runs: &[Judged], rest: &[&'static Axis]) -> Vec<(Vec<String>, bool)> {
    if runs.iter().all(|(_, wanted)| !wanted) {
        return vec![];
    }
    let of = |(run, wanted): &Judged| (rest.iter().map(|axis| axis.value(run)).collect(), *wanted);
    runs.iter().map(of).collect()
}

/// Each value once, in order.
fn union<T: PartialEq>(values: impl Iterator<Item = T>) -> Vec<T> {
    values.fold(vec![], |mut known, value| {
        if !known.contains(&value) {
            known.push(value);
        }
        known
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lights::Lighting;
    use crate::sweep::parts;
    use proptest::prelude::*;

    const METHODS: [&str; 5] =
        ["indi-persp-64", "indi-persp-16", "encl-ortho-4", "encl-ortho-1.5", "all-lights"];

    fn config(scenes: &[&str]) -> Config {
        let read = |name: &str| name.parse().unwrap();
        Config {
            scenes: scenes.iter().map(|text| text.parse().unwrap()).collect(),
            lights: [1, 20, 300].map(Lighting::with_count).to_vec(),
            methods: METHODS.map(read).to_vec(),
            assign: ["brute", "hierarchy", "scatter"].map(|name| name.parse().unwrap()).to_vec(),
            test: ["auto", "exact", "hs+sat-n"].map(|name| name.parse().unwrap()).to_vec(),
            ..Config::default()
        }
    }

    fn runs(config: &Config) -> Vec<Config> {
        let parts = parts(config).unwrap();
        parts.iter().flat_map(|part| part.runs.iter().map(|run| run.config.clone())).collect()
    }

    /// What the configuration for some runs, numbered by the product, replays; and the rules of it.
    fn replayed(config: &Config, chosen: &[usize]) -> (Vec<Vec<String>>, Vec<String>) {
        let all = runs(config);
        let chosen: Vec<Config> = chosen.iter().map(|&number| all[number % all.len()].clone()).collect();
        let written = serde_json::to_string(&configuration(config, &chosen)).unwrap();
        let written: Config = serde_json::from_str(&written).unwrap();
        let product = Config { exclude: vec![], ..written.clone() };
        let cases: Vec<Config> = product.by_scene().iter().flat_map(Config::cases).collect();
        for rule in &written.exclude {
            assert!(cases.iter().any(|run| rule.matches(run)), "{rule} matches nothing");
        }
        let mut expected = union(chosen.iter().map(key));
        let mut found: Vec<_> = runs(&written).iter().map(key).collect();
        expected.sort();
        found.sort();
        assert_eq!(found, expected);
        (found, written.exclude.iter().map(ToString::to_string).collect())
    }

    proptest! {
        #[test]
        fn the_chosen_runs_are_replayed_and_no_others(
            chosen in proptest::collection::vec(0..1000_usize, 1..12),
            several: bool,
        ) {
            let scenes: &[&str] = if several { &["street=bistro", "street=bistro-vive", "temple=suntem"] } else { &[] };
            replayed(&config(scenes), &chosen);
        }
    }

    #[test]
    fn rules_are_put_together() {
        // indi-persp-64 by brute with hs under all three lightings.
        let config = config(&[]);
        let all = runs(&config);
        let numbers = |wanted: &dyn Fn(&Config) -> bool| -> Vec<usize> {
            (0..all.len()).filter(|&number| wanted(&all[number])).collect()
        };
        let of = |method: &'static str, assign: &'static str, test: &'static str| {
            move |run: &Config| {
                let value = |name: &str| Axis::named(name).unwrap().value(run);
                (value("method"), value("assign"), value("test"))
                    == (method.into(), assign.into(), test.into())
            }
        };
        let one = of("indi-persp-64", "brute", "hs");
        assert_eq!(replayed(&config, &numbers(&one)).1, [""; 0]);
        let other = of("indi-persp-16", "scatter", "exact");
        let both = numbers(&|run| one(run) || other(run));
        assert_eq!(
            replayed(&config, &both).1,
            [
                "method=indi-persp-64,assign=brute,test=exact",
                "method=indi-persp-64,assign=scatter",
                "method=indi-persp-16,assign=brute",
                "method=indi-persp-16,assign=scatter,test=hs",
            ]
        );
    }
}
