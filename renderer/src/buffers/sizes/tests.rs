//! Sizes of buffers, and what they must not exceed.

use super::*;

/// What 10 000 lights need among 2^20 clusters.
fn sizes() -> ClusteringSizes {
    let capacities = Capacities { visible_clusters: 1000, light_indices: 1 << 20, ..Capacities::default() };
    let assigner = Assigner::Scatter;
    ClusteringSizes {
        clusters: 1 << 20,
        tiles: 1 << 14,
        listed: Clusters::Visible,
        bounds: ClusterBounds::Cell,
        normal_cones: NormalCones::OFF,
        boxed: false,
        compaction: Compaction::Ranks,
        lists: ListStore::Offsets,
        slice_planes: 65,
        lights: 10_000,
        spots: false,
        capacities,
        assigner,
        shell_layers: false,
        has_octree: false,
        counting: true,
        pixels: 64,
    }
}

/// What the least device has that the specification allows, but for larger storage buffers.
fn limits() -> Limits {
    Limits {
        max_storage_buffer_range: 1 << 27,
        max_texel_buffer_elements: 1 << 20,
        max_compute_work_group_count: [65_535; 3],
        ..Limits::default()
    }
}

fn refusal(sizes: &ClusteringSizes, limits: &Limits) -> String {
    sizes.check(limits).unwrap_err().to_string()
}

#[test]
fn what_fits_is_taken() {
    sizes().check(&limits()).unwrap();
}

#[test]
fn what_the_device_does_not_hold_read_or_dispatch_is_named() {
    let small = Limits { max_storage_buffer_range: 1 << 17, ..limits() };
    assert!(refusal(&sizes(), &small).starts_with("buffer light_volumes would need 320000 bytes"));
    let few = Limits { max_texel_buffer_elements: 29_999, ..limits() };
    let many_lights = refusal(&ClusteringSizes { capacities: few_indices(), ..sizes() }, &few);
    assert!(many_lights.starts_with("buffer lights would be read as 30000 texels"), "{many_lights}");
    let boxed = ClusteringSizes { boxed: true, ..sizes() };
    let few_boxes = Limits { max_storage_buffer_range: 1 << 24, ..limits() };
    assert!(refusal(&boxed, &few_boxes).starts_with("buffer cluster_boxes would need 33554432 bytes"));
    sizes().check(&few_boxes).unwrap();
    let few_texels = Limits { max_texel_buffer_elements: (1 << 21) - 1, ..limits() };
    assert!(refusal(&boxed, &few_texels).starts_with("buffer cluster_boxes would be read as 2097152 texels"));
    let narrow = Limits { max_compute_work_group_count: [31; 3], ..limits() };
    assert!(refusal(&sizes(), &narrow).contains("would need a dispatch of"));
}

#[test]
fn every_store_has_the_buffers_that_it_uses_and_no_others() {
    let brute = ClusteringSizes { assigner: Assigner::Brute, ..sizes() };
    let bytes = |sizes: ClusteringSizes| {
        [
            BufferName::ListOffsets,
            BufferName::ListLengths,
            BufferName::LightIndices,
            BufferName::LightMasks,
            BufferName::BlockSums,
        ]
        .map(|name| name.info().size.map_or(0, |size| size(&sizes)))
    };
    let masks = 4 * assign::mask_capacity(10_000, 1000);
    // 2^15 words of bits are ranked in 32 blocks.
    let ranked = 4 * 32;
    assert_eq!(bytes(brute), [4 * 1001, 4 * 1000, 4 << 20, masks, ranked]);
    let capacities = Capacities { list_entries: 70, ..brute.capacities };
    let fixed = ClusteringSizes { lists: ListStore::Fixed(64), capacities, ..brute };
    assert_eq!(bytes(fixed), [0, 4 * 1000, 4 * 1000 * 70, 0, ranked]);
    let few = ClusteringSizes { clusters: 300, ..fixed };
    assert_eq!(bytes(few)[2], 4 * 300 * 70, "no more lists than clusters");
    let capped = ClusteringSizes { lists: ListStore::Capped(100), ..brute };
    assert_eq!(bytes(capped), [4 * 1000, 4 * 1000, 4 << 20, 0, ranked]);
    let scattered = ClusteringSizes { assigner: Assigner::Scatter, ..fixed };
    assert_eq!(bytes(scattered)[3], masks, "bits are what such lists are read off");
    let places = |sizes: ClusteringSizes| {
        [BufferName::WordRanks, BufferName::ClusterPlaces]
            .map(|name| name.info().size.map_or(0, |size| size(&sizes)))
    };
    assert_eq!(places(brute), [4 << 15, 0]);
    let atomic = ClusteringSizes { compaction: Compaction::Atomic, ..brute };
    assert_eq!(places(atomic), [0, 4 << 20]);
    assert_eq!(places(ClusteringSizes { listed: Clusters::All, ..atomic }), [0, 0]);
}

#[test]
fn memory_grows_with_what_buffers_hold_and_frames_in_flight() {
    let sizes = sizes();
    let host = sizes.bytes(1) - sizes.bytes(0);
    assert_eq!(sizes.bytes(2), sizes.bytes(0) + 2 * host);
    assert!(host >= 65 * 4, "a slice plane is four bytes");
    let more = Capacities { light_indices: sizes.capacities.light_indices + 100, ..sizes.capacities };
    assert_eq!(ClusteringSizes { capacities: more, ..sizes }.bytes(2), sizes.bytes(2) + 400);
}

fn few_indices() -> Capacities {
    Capacities { visible_clusters: 2, light_indices: 1000, ..Capacities::default() }
}

#[test]
fn lists_grow_no_longer_than_they_can_be_read() {
    assert_eq!(sizes().most(&limits()).light_indices, 1 << 20);
    assert_eq!(
        sizes().most(&Limits { max_texel_buffer_elements: 1 << 30, ..limits() }).light_indices,
        1 << 25
    );
}
