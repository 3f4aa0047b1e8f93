//! What cases of a configuration are refused, and how choices are read.

use super::*;
use crate::lights::Lighting;

fn config(methods: &[&str], tests: &[&str]) -> Config {
    Config {
        methods: methods.iter().map(|name| name.parse().unwrap()).collect(),
        test: tests.iter().map(|name| name.parse().unwrap()).collect(),
        ..Config::default()
    }
}

fn ways(config: &Config) -> Vec<String> {
    let way = |run: &Config| format!("{} {} {}", run.methods[0], run.assign[0], run.test[0]);
    config.cases().iter().map(way).collect()
}

#[test]
fn cases_are_the_product_with_equal_ones_once() {
    let mut config = config(&["indi-persp-64", "indi-ortho-4"], &["auto", "hs", "exact"]);
    let expected = [
        "indi-persp-64 brute hs",
        "indi-persp-64 brute exact",
        "indi-ortho-4 brute box",
        "indi-ortho-4 brute hs",
        "indi-ortho-4 brute exact",
    ];
    assert_eq!(ways(&config), expected);
    config.assign = vec![Assign::Scatter, Assign::Auto];
    config.lights = vec![Lighting::with_count(1), Lighting::with_count(2)];
    assert_eq!(config.cases().len(), 4 * expected.len());
    assert_eq!(ways(&config)[1], "indi-persp-64 scatter exact");
    assert_eq!(ways(&config)[2], "indi-persp-64 auto hs");
}

#[test]
fn a_method_without_clusters_knows_no_ways() {
    let config = Config {
        assign: vec![Assign::Hierarchy, Assign::Brute],
        ..config(&["all-lights"], &["hs", "exact"])
    };
    assert_eq!(ways(&config), ["all-lights hierarchy auto"]);
}

#[test]
fn fragments_lie_on_their_models() {
    let refused = |method: &str, msaa, marking| {
        let config = Config { msaa, marking, ..config(&[method], &["auto"]) };
        config.cases()[0].check_case().err()
    };
    assert!(refused("m", 4, Marking::Geometry).unwrap().contains("use depth"));
    for (method, msaa, marking) in
        [("m", 4, Marking::Depth), ("m", 1, Marking::Geometry), ("g-20", 4, Marking::Geometry)]
    {
        assert_eq!(refused(method, msaa, marking), None, "{method} {msaa} {marking:?}");
    }
}

#[test]
fn deferred_samples_lie_where_they_are_marked() {
    let refused = |msaa, marking| {
        let pipeline = vec![ShadingPipeline::Deferred];
        let config = Config { msaa, marking, pipeline, ..config(&["g-20"], &["auto"]) };
        config.cases()[0].check_case().err()
    };
    assert!(refused(4, Marking::Geometry).unwrap().contains("G-buffer"));
    assert_eq!((refused(4, Marking::Depth), refused(1, Marking::Geometry)), (None, None));
}

#[test]
fn a_counter_gives_places_where_clusters_are_marked_and_neighbours_do_not_matter() {
    let refused = |method: &str, assign, clusters: &str| {
        let config = Config {
            assign: vec![assign],
            clusters: vec![clusters.parse().unwrap()],
            compaction: vec![Compaction::Atomic],
            ..config(&[method], &["auto"])
        };
        config.cases()[0].check_case().err()
    };
    for (method, assign) in [
        ("sc-i-48-40", Assign::Brute),
        ("encl-ortho-4", Assign::Hierarchy),
        ("g-20", Assign::Scatter),
        ("all-lights", Assign::Auto),
    ] {
        assert_eq!(refused(method, assign, "auto"), None, "{method}");
    }
    for assign in [Assign::Scatter, Assign::Auto] {
        assert!(refused("sc-i-48-40", assign, "auto").unwrap().contains("no neighbours"), "{assign}");
    }
    for (method, clusters) in [("dc-i-128-64", "auto"), ("sc-i-48-40", "all")] {
        let refused = refused(method, Assign::Brute, clusters).unwrap();
        assert!(refused.contains("all clusters of"), "{refused}");
    }
    assert_eq!(refused("dc-i-128-64", Assign::Brute, "visible"), None);
}

#[test]
fn samples_are_sorted_in_tiles_of_whole_pixels() {
    let refused = |method: &str, marking| {
        let config = Config { marking, compaction: vec![Compaction::Sort], ..config(&[method], &["auto"]) };
        config.cases()[0].check_case().err()
    };
    let by_depth = |method| refused(method, Marking::Depth);
    for method in
        ["clustered-mm-32", "indi-persp-64", "tiled-16", "sc-e-48-40", "ortiz-16-9-24", "g-20", "all-lights"]
    {
        assert_eq!(by_depth(method), None, "{method}");
    }
    for (method, told) in [
        ("encl-persp-64", "do not lie in such"),
        ("indi-ortho-4", "do not lie in such"),
        ("indi-displ-64-32", "do not lie in such"),
        ("clustered-mm-12.5", "have 12.5"),
        ("tiled-mm-32", "all clusters of tiled-mm-32"),
    ] {
        let message = by_depth(method).unwrap();
        assert!(message.contains(told), "{message}");
    }
    assert!(refused("clustered-mm-32", Marking::Geometry).unwrap().contains("use --marking depth"));
}

#[test]
fn rectangles_ask_for_their_test() {
    let refused = |method: &str, test: &str| {
        let config = Config { assign: vec![Assign::Rectangles], ..config(&[method], &[test]) };
        config.cases()[0].check_case().err()
    };
    for (method, test) in
        [("tiled-mm-32", "auto"), ("clustered-mm-32", "mm"), ("encl-persp-64", "mm"), ("all-lights", "auto")]
    {
        assert_eq!(refused(method, test), None, "{method} {test}");
    }
    for (method, test) in [("t-i-28", "auto"), ("tiled-mm-32", "exact"), ("g-20", "auto"), ("m", "auto")] {
        let message = refused(method, test).unwrap();
        assert!(message.contains("use --test mm"), "{message}");
    }
}

#[test]
fn boxes_serve_boxes_alone() {
    let refused = |method: &str| config(&[method], &["box"]).cases()[0].check_case().err();
    assert_eq!(refused("encl-ortho-4"), None);
    assert_eq!(refused("all-lights"), None);
    assert!(refused("encl-persp-64").unwrap().contains("encl-persp-64 are no boxes"));
    assert!(refused("indi-displ-64-32").is_some());
    let seen = |method: &str| config(&[method], &["mm"]).cases()[0].check_case().err();
    for method in ["indi-persp-64", "encl-displ-64-32", "ortiz-16-9-24", "t-e-28", "all-lights"] {
        assert_eq!(seen(method), None);
    }
    for method in ["encl-ortho-4", "g-20"] {
        assert!(seen(method).unwrap().contains("no pieces of a frustum"));
    }
    assert_eq!(refused("g-20"), None);
    assert_eq!(refused("ortiz-16-9-24"), None);
    assert_eq!(ways(&config(&["ortiz-16-9-24"], &["auto"])), ["ortiz-16-9-24 brute box"]);
    for test in ["box", "hs", "sat-n"] {
        let refused = config(&["m"], &[test]).cases()[0].check_case().unwrap_err();
        assert!(refused.contains("`exact` alone") && refused.contains(test), "{refused}");
    }
    for test in ["auto", "exact"] {
        assert_eq!(ways(&config(&["m"], &[test])), ["m brute exact"]);
    }
}
