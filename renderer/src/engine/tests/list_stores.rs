//! Stores of lists and compaction by a counter: lists are those of offsets, cluster by cluster, or the part of them that has
//! room.

use super::bounds::words_of;
use super::*;
use crate::assign::{Bounds, Compaction, ListStore};
use crate::config::Assign;
use crate::geometry::MeasuredBounds;
use crate::gpu_interface::COUNTER_COUNT;
use crate::measure::DeviceCounts;
use std::cell::Cell;

const WAYS: [Assign; 3] = [Assign::Brute, Assign::Hierarchy, Assign::Scatter];

/// A grid with lights of many sizes, by a configuration.
struct Scenario {
    config: Config,
    method: Method,
    grid: Grid,
    lights: Vec<Light>,
    /// Where the last lists were made, whose device and shaders serve the next.
    last: Cell<Option<Bench>>,
}

impl Scenario {
    fn new(config: &Config, method: Method, grid: Grid, lights: &[Light]) -> Self {
        Self { config: config.clone(), method, grid, lights: lights.to_vec(), last: Cell::default() }
    }
}

fn scenarios() -> Vec<Scenario> {
    let lights = random_lights(3001, 4, 40.0, |u| 0.02 * 3000f32.powf(u * u));
    let measured = Config { bounds: vec![Bounds::Measured.into()], ..config() };
    vec![
        Scenario::new(&config(), PERSP, frustum_grid([13, 9, 21]), &lights),
        Scenario::new(&config(), ORTHO, box_grid([17, 13, 11]), &lights),
        Scenario::new(&measured, PERSP, frustum_grid([13, 9, 21]), &lights),
    ]
}

/// What a bench leaves of one way and store.
struct Made {
    lists: Lists,
    state: ClusteringState,
    counts: DeviceCounts,
}

impl Scenario {
    fn bench(&self, assign: Assign, lists: ListStore, compaction: Compaction) -> Bench {
        let visible_clusters = self.grid.cluster_count() as u32;
        let capacities = Capacities { visible_clusters, light_indices: 6_000_000, ..Capacities::default() };
        let config = Config {
            assign: vec![assign],
            lists: vec![lists],
            compaction: vec![compaction],
            ..self.config.clone()
        };
        let case = Case { method: self.method, grid: self.grid, lights: &self.lights, capacities };
        match self.last.take() {
            Some(Bench(bench)) => Bench(bench.replace(&config, case).unwrap()),
            None => Bench::with_scene(&config, &street(), case),
        }
    }

    /// Lists of a seventh of the clusters.
    fn make(&self, assign: Assign, lists: ListStore) -> Made {
        self.make_compacted((assign, Room::Plenty), lists, Compaction::Ranks)
    }

    fn make_compacted(&self, way: (Assign, Room), lists: ListStore, compaction: Compaction) -> Made {
        let (assign, room) = way;
        let mut bench = self.bench(assign, lists, compaction);
        bench.leave(room);
        bench.compact(&random_bits(self.grid.cluster_count(), 7, 11));
        self.measure(&mut bench);
        bench.upload(BufferName::Counters, &[0; 2 * COUNTER_COUNT]);
        let lists = bench.lists();
        let words = bench.download(BufferName::Counters, 2 * COUNTER_COUNT);
        let state = bench.state().unwrap();
        self.last.set(Some(bench));
        Made { lists, state, counts: DeviceCounts::from_words(&words) }
    }

    /// Bounds that are the same whatever the places of clusters: what their cells have between a fifth and four fifths.
    fn measure(&self, bench: &mut Bench) {
        if self.config.bounds != [Bounds::Measured.into()] {
            return;
        }
        let visible = bench.state().unwrap().visible as usize;
        let clusters = bench.download(BufferName::VisibleClusters, visible);
        let words: Vec<u32> =
            clusters.iter().flat_map(|&cluster| words_of(&self.bounds_of(cluster), false)).collect();
        bench.upload(BufferName::ClusterBounds, &words);
    }

    /// Every fifth cluster holds no sample.
    fn bounds_of(&self, cluster: u32) -> MeasuredBounds {
        let cell = DVec3::from_array(self.grid.cluster_at(cluster).map(f64::from));
        let mut bounds = MeasuredBounds::EMPTY;
        if !cluster.is_multiple_of(5) {
            bounds.include(&self.grid, self.grid.point_at(cell + 0.2));
            bounds.include(&self.grid, self.grid.point_at(cell + 0.8));
        }
        bounds
    }
}

/// The longest list.
fn longest(lists: &Lists) -> u32 {
    lists.offsets.windows(2).map(|ends| ends[1] - ends[0]).max().unwrap_or(0)
}

fn count(lists: &Lists) -> usize {
    lists.offsets.len() - 1
}

#[test]
fn every_store_has_the_lists_of_offsets_by_all_ways() {
    for (case, scenario) in scenarios().iter().enumerate() {
        let offsets = scenario.make(Assign::Brute, ListStore::Offsets);
        let most = longest(&offsets.lists);
        assert!(most > 20 && most <= 1024 && offsets.lists.indices.len() > 1000, "case {case}: {most}");
        for store in [ListStore::Fixed(most), ListStore::Fixed(most + 7), ListStore::Capped(1024)] {
            for assign in WAYS {
                let made = scenario.make(assign, store);
                assert!(made.lists == offsets.lists, "case {case}: {store} by {assign}");
                assert_eq!((made.state.longest, made.counts.lights_dropped), (0, 0), "case {case}: {store}");
                if assign == Assign::Brute {
                    let tests = (made.counts.intersection_tests, offsets.counts.intersection_tests);
                    assert_eq!(tests.0, tests.1, "case {case}: {store}");
                }
            }
        }
    }
}

#[test]
fn lists_that_are_too_long_say_by_how_much() {
    for (case, scenario) in scenarios().iter().enumerate() {
        let offsets = scenario.make(Assign::Brute, ListStore::Offsets).lists;
        let most = longest(&offsets);
        for entries in [8, most - 1] {
            for assign in WAYS {
                let made = scenario.make(assign, ListStore::Fixed(entries));
                assert_eq!(made.state.longest, most, "case {case}: {entries} entries by {assign}");
                for list in 0..count(&offsets) {
                    let (kept, _) = cpu::cap_list(offsets.of(list), entries);
                    assert_eq!(made.lists.of(list), kept, "case {case}: list {list} by {assign}");
                }
            }
        }
    }
}

#[test]
fn capped_lists_keep_their_first_lights_and_the_others_are_counted() {
    for (case, scenario) in scenarios().iter().enumerate() {
        let offsets = scenario.make(Assign::Brute, ListStore::Offsets).lists;
        for cap in [1, longest(&offsets) - 1] {
            let capped = (0..count(&offsets)).map(|list| cpu::cap_list(offsets.of(list), cap));
            let (kept, dropped): (Vec<&[u32]>, Vec<u64>) = capped.unzip();
            for assign in WAYS {
                let made = scenario.make(assign, ListStore::Capped(cap));
                for (list, kept) in kept.iter().enumerate() {
                    assert_eq!(made.lists.of(list), *kept, "case {case}: list {list} of {cap} by {assign}");
                }
                let told = made.counts.lights_dropped;
                assert_eq!(told, dropped.iter().sum::<u64>(), "case {case}: {cap} by {assign}");
                assert_eq!(made.state.index_total as usize, kept.concat().len());
                assert!(told > 0);
            }
        }
    }
}

#[test]
fn bits_without_room_leave_empty_lists_and_say_so() {
    let scenario = scenarios().remove(0);
    for store in [ListStore::Fixed(2000), ListStore::Capped(1000)] {
        for assign in [Assign::Hierarchy, Assign::Scatter] {
            let made = scenario.make_compacted((assign, Room::None), store, Compaction::Ranks);
            assert_eq!((made.state.masked, made.lists.indices.len()), (0, 0), "{store} by {assign}");
        }
        // Brute force needs none.
        let brute = scenario.make_compacted((Assign::Brute, Room::None), store, Compaction::Ranks);
        assert!(brute.lists.indices.len() > 1000, "{store}");
    }
}

#[test]
fn a_counter_gives_every_visible_cluster_a_place_of_its_own() {
    for (case, clusters) in [1u32, 31, 33, 1023, 70_000].into_iter().enumerate() {
        let scenario = Scenario::new(&config(), ORTHO, box_grid([clusters, 1, 1]), &lights(10));
        let mut bench = scenario.bench(Assign::Brute, ListStore::Offsets, Compaction::Atomic);
        let bits = random_bits(clusters.into(), 3, case as u64 + 1);
        let twin = cpu::compact(&fragments_of(&bits, clusters.into())).visible;
        let state = bench.compact(&bits);
        assert_eq!((state.visible_total as usize, state.visible as usize), (twin.len(), twin.len()));
        let visible = bench.download(BufferName::VisibleClusters, twin.len().max(1));
        let places = bench.download(BufferName::ClusterPlaces, clusters as usize);
        let mut sorted = visible[..twin.len()].to_vec();
        sorted.sort_unstable();
        assert_eq!(sorted, twin, "{clusters} clusters");
        for (place, &cluster) in (0..).zip(&visible[..twin.len()]) {
            assert_eq!(places[cluster as usize], place);
        }
    }
}

#[test]
fn clusters_without_a_place_are_counted() {
    let room = Capacities { visible_clusters: 100, light_indices: 16, ..Capacities::default() };
    let config = Config { compaction: vec![Compaction::Atomic], ..config() };
    let mut bench = Bench::with_config(&config, ORTHO, box_grid([5000, 1, 1]), &lights(10), room);
    let bits = random_bits(5000, 2, 9);
    let twin = cpu::compact(&fragments_of(&bits, 5000)).visible;
    let state = bench.compact(&bits);
    assert_eq!((state.visible_total as usize, state.visible), (twin.len(), 100));
}

#[test]
fn lists_do_not_depend_on_the_places_of_clusters() {
    for (case, scenario) in scenarios().iter().enumerate() {
        let ranked = scenario.make(Assign::Brute, ListStore::Offsets);
        let entries = longest(&ranked.lists);
        for store in [ListStore::Offsets, ListStore::Fixed(entries), ListStore::Capped(1024)] {
            for assign in [Assign::Brute, Assign::Hierarchy] {
                let way = (assign, Room::Plenty);
                let made = scenario.make_compacted(way, store, Compaction::Atomic);
                assert!(made.lists == ranked.lists, "case {case}: {store} by {assign}");
            }
        }
    }
}
