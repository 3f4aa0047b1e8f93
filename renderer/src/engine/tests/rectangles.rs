//! Assignment by rectangles on the device: each step equal to its twin, and the lists those of brute force by the same test.

use super::bounds::{random_bounds, with_clusters, words_of};
use super::boxes::by_law;
use super::*;
use crate::assign::Bounds;
use crate::config::Assign;
use crate::cpu::{CellRange, CulledLights, Visible};
use crate::geometry::{SliceLaw, SphereTest};
use crate::gpu_interface::LightRectangle;
use crate::passes::{Lights, VisibleClusters};
use crate::selftest::cases::sliced;

/// How small a margin is too close to call, cells and metres.
const EPSILON: f64 = 2e-3;

fn seen(config: &Config, assign: Assign) -> Config {
    Config { assign: vec![assign], test: vec![SphereTest::Projected.into()], ..config.clone() }
}

/// Lights from centimetres to more than the grid, many of them around the eye.
fn mixed() -> Vec<Light> {
    let near = random_lights(400, 3, 4.0, |u| 0.05 + 3.0 * u);
    [random_lights(3001, 4, 40.0, |u| 0.02 * 3000f32.powf(u * u)), near].concat()
}

fn cells_of(rectangle: &LightRectangle) -> Option<CellRange> {
    let LightRectangle { first, last, .. } = *rectangle;
    (0..3).all(|axis| first[axis] <= last[axis]).then_some(CellRange { low: first, high: last })
}

#[test]
fn rectangles_and_their_lists_equal_their_twins() {
    for law in [SliceLaw::Geometric, SliceLaw::SecondPlane { metres: 5.0 }] {
        let (grid, lights) = (sliced(law), mixed());
        let (mut bench, clusters) =
            with_clusters(&seen(&by_law(law), Assign::Rectangles), (PERSP, grid), &lights);
        let run = |bench: &mut Bench, pass: fn(&mut Recorder, &Frame, Lights, VisibleClusters)| {
            bench.run(|r, frame| {
                let lights = light_upload::record(r, frame);
                pass(r, frame, lights, given());
            });
        };
        run(&mut bench, assign::transform_lights);
        let volumes = bench.volumes(BufferName::LightVolumes, lights.len());
        run(&mut bench, assign::light_rectangles);
        let words = size_of::<LightRectangle>() / 4 * lights.len();
        let device = bench.download(BufferName::LightRectangles, words);
        let device: &[LightRectangle] = bytemuck::cast_slice(&device);
        let CulledLights { candidates, borderline } = cpu::light_rectangles(&grid, &volumes, EPSILON);
        for (light, rectangle) in (0..).zip(device) {
            let twin = candidates.binary_search_by_key(&light, |candidate| candidate.light);
            let twin = twin.ok().map(|place| candidates[place].cells);
            let close = borderline.binary_search(&light).is_ok();
            assert!(close || cells_of(rectangle) == twin, "{law}: light {light}: {rectangle:?}, {twin:?}");
        }
        assert!(borderline.len() * 10 < lights.len(), "{law}: {} are too close to call", borderline.len());
        let lists = bench.lists();
        let twin = cpu::rectangles(&Visible { grid: &grid, clusters: &clusters }, &candidates);
        let sure = |list: &[u32]| -> Vec<u32> {
            list.iter().copied().filter(|light| borderline.binary_search(light).is_err()).collect()
        };
        for (place, list) in twin.iter().enumerate() {
            assert_eq!(sure(lists.of(place)), sure(list), "{law}: list {place}");
        }
        assert!(lists.indices.len() > 1000);
    }
}

/// By every law, and for what is measured of clusters.
#[test]
fn lists_by_rectangles_are_those_of_brute_force() {
    let measured = Config { bounds: vec![Bounds::Measured.into()], ..config() };
    let laws = SliceLaw::EXAMPLES.map(by_law).into_iter().zip(SliceLaw::EXAMPLES);
    for (config, law) in laws.chain([(measured, SliceLaw::Geometric)]) {
        let (grid, lights) = (sliced(law), mixed());
        let lists = |assign| {
            let (mut bench, clusters) = with_clusters(&seen(&config, assign), (PERSP, grid), &lights);
            if config.bounds == [Bounds::Measured.into()] {
                let bounds = random_bounds(&grid, &clusters);
                let words: Vec<u32> = bounds.iter().flat_map(|bounds| words_of(bounds, false)).collect();
                bench.upload(BufferName::ClusterBounds, &words);
            }
            bench.lists()
        };
        let brute = lists(Assign::Brute);
        assert!(lists(Assign::Rectangles) == brute, "{law}");
        assert!(brute.indices.len() > 1000, "{law}");
    }
}
