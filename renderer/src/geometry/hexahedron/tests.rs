//! The tests of sectors against cells that are pieces of frusta, boxes along any axes, and what has no extent.

use super::super::sector::testing::{direction, half_angle};
use super::*;
use crate::geometry::views::Pose;
use crate::geometry::{ClusterSpace, Frustum};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// A cell of a perspective grid, from 10 cm to 40 m before the eye.
fn piece() -> impl Strategy<Value = Hexahedron> {
    let frustum = Frustum { x0: -1.3, x1: 0.9, y0: -0.7, y1: 1.1, z0: -40.0, z1: -0.1 };
    let dimensions = [9u32, 6, 15];
    let ratio = 400f64.powf(1.0 / 15.0) - 1.0;
    let grid = Grid { pose: Pose::IDENTITY, space: ClusterSpace::geometric(frustum, ratio), dimensions };
    (0..9u32, 0..6u32, 0..15u32).prop_map(move |(x, y, z)| Hexahedron::of_cell(&grid, [x, y, z]))
}

/// A box along any axes; some of its sides may have no extent.
fn oriented() -> impl Strategy<Value = Hexahedron> {
    let extent = prop_oneof![4 => 0.02..4.0f64, 1 => Just(0.0)];
    let centre = prop::array::uniform3(-20.0..20.0f64).prop_map(DVec3::from_array);
    (centre, prop::array::uniform3(extent), direction()).prop_map(|(center, half, first)| {
        let second = first.any_orthonormal_vector();
        let axes = [first, second, first.cross(second)];
        Hexahedron::of_box(&OrientedBox { center, half_extent: DVec3::from_array(half), axes })
    })
}

/// A cell and a sector whose ball mostly reaches it: beside it, in it, or around it.
fn pair() -> impl Strategy<Value = (Hexahedron, SphericalSector)> {
    let cell = prop_oneof![piece(), oriented()];
    let place = (direction(), 0.0..1.2f64);
    (cell, place, direction(), 0.3..30.0f64, half_angle()).prop_map(
        |(cell, (away, part), axis, range, half_angle)| {
            let apex = cell.centre() + away * (part * range);
            (cell, SphericalSector { apex, axis, range, half_angle })
        },
    )
}

/// As many random pairs as asked, the same every time.
fn pairs(count: usize) -> impl Iterator<Item = (Hexahedron, SphericalSector)> {
    let (mut runner, strategy) = (TestRunner::deterministic(), pair());
    (0..count).map(move |_| strategy.new_tree(&mut runner).unwrap().current())
}

fn meets((cell, sector): &(Hexahedron, SphericalSector)) -> bool {
    let meets = cell.least_distance(sector) <= sector.range;
    assert_eq!(cell.meets(sector), meets, "{sector:?} {cell:?}");
    meets
}

/// The point of a cell at parts along its sides.
fn point_of(cell: &Hexahedron, parts: [f64; 3]) -> DVec3 {
    let weight =
        |corner: usize, axis: usize| if corner >> axis & 1 == 1 { parts[axis] } else { 1.0 - parts[axis] };
    (0..8)
        .map(|corner| cell.corners[corner] * (weight(corner, 0) * weight(corner, 1) * weight(corner, 2)))
        .sum()
}

/// How far a cell and a sector lie apart, as (at least, at most), metres, by walking to the point of their difference that is
/// nearest to the origin (Gilbert 1966): in each step along the line to the point that is farthest in its direction.
fn apart(cell: &Hexahedron, sector: &SphericalSector) -> (f64, f64) {
    let farthest = |towards: DVec3| {
        let along = |corner: &DVec3| corner.dot(towards);
        let of_cell = cell.corners.into_iter().max_by(|a, b| along(a).total_cmp(&along(b))).unwrap();
        let out = sector.nearest_direction(-towards) * sector.range;
        of_cell - sector.apex - if out.dot(towards) < 0.0 { out } else { DVec3::ZERO }
    };
    let (mut nearest, mut least) = (cell.centre() - sector.apex, 0.0_f64);
    for _ in 0..400 {
        if least > 0.0 || nearest.length() < 1e-9 {
            break;
        }
        let next = farthest(-nearest);
        least = least.max(nearest.dot(next) / nearest.length());
        let step = next - nearest;
        if step == DVec3::ZERO {
            break;
        }
        nearest += step * (-nearest.dot(step) / step.length_squared()).clamp(0.0, 1.0);
    }
    (least, nearest.length())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// The exact test answers as a search of the nearest points does, and its margin is not more than there is.
    #[test]
    fn the_exact_test_agrees_with_a_search(pair in pair()) {
        let margin = pair.0.sector_margin(&pair.1);
        let (least, most) = apart(&pair.0, &pair.1);
        prop_assert_eq!(margin >= 0.0, meets(&pair));
        prop_assert!(margin < 0.0 || least < 1e-7, "meet by {}, but {} apart", margin, least);
        prop_assert!(margin >= 0.0 || most > -margin - 1e-9, "{} apart, but {} at most", -margin, most);
    }

    /// Whoever moves by less than a margin gets the same answer.
    #[test]
    fn margins_are_safe(pair in pair(), away in direction(), part in 0.0..0.99f64) {
        let (cell, sector) = pair;
        let moved = |margin: f64| SphericalSector { apex: sector.apex + away * (part * margin), ..sector };
        let exact = cell.sector_margin(&sector);
        prop_assert_eq!(meets(&(cell, moved(exact))), exact >= 0.0, "{}", exact);
        let separation = cell.separation_margin(&sector);
        prop_assert_eq!(cell.separation_margin(&moved(separation)) >= 0.0, separation >= 0.0, "{}", separation);
    }
}

/// How many pairs meet by their spheres, by axes as well, and exactly.
#[derive(Default)]
struct Found {
    by_sphere: u32,
    by_axes: u32,
    exact: u32,
}

impl Found {
    /// What meets in vain by axes, in parts of what does so by spheres.
    fn in_vain(&self) -> f64 {
        f64::from(self.by_axes - self.exact) / f64::from(self.by_sphere - self.exact)
    }
}

/// Takes a pair, of which no test may lose what another has.
fn compare(found: &mut Found, pair: &(Hexahedron, SphericalSector)) {
    let ((cell, sector), exact) = (pair, meets(pair));
    let separation = cell.separation_margin(sector);
    assert!(!exact || separation > -1e-9 * (1.0 + sector.range), "separated by {separation}: {pair:?}");
    let (apex, range) = sector.bounding_sphere();
    let half = SphericalSector { apex, range, half_angle: 90f64.to_radians(), ..*sector };
    let by_sphere =
        [half, SphericalSector { axis: -half.axis, ..half }].iter().any(|half| meets(&(*cell, *half)));
    assert!(by_sphere || !exact, "outside the sphere: {pair:?}");
    found.by_sphere += u32::from(by_sphere);
    found.by_axes += u32::from(by_sphere && separation >= 0.0);
    found.exact += u32::from(exact);
}

/// What any point of a cell shows to meet does so by all tests. Of the pairs whose spheres meet in vain, few are left by the axes,
/// of narrow cones and of wide ones.
#[test]
fn no_pair_is_lost_that_has_a_point_in_common() {
    let parts = |sample: u32, step: f64| (f64::from(sample) * step).fract();
    let (mut common, mut narrow, mut wide) = (0, Found::default(), Found::default());
    for (at, pair) in (0u32..).zip(pairs(100_000)) {
        let (cell, sector) = &pair;
        let sample = |sample: u32| {
            point_of(cell, [0.618_034, 0.732_051, 0.414_214].map(|step| parts(8 * at + sample, step)))
        };
        if (0..8).any(|number| sector.contains(sample(number))) {
            common += 1;
            assert!(meets(&pair), "{pair:?}");
        }
        compare(if sector.half_angle > 1.2 { &mut wide } else { &mut narrow }, &pair);
    }
    let exact = narrow.exact + wide.exact;
    assert!(common > 20_000 && exact - common > 1000, "{common} of {exact} have samples in common");
    let in_vain = [narrow.in_vain(), wide.in_vain()];
    assert!(in_vain[0] < 0.045 && in_vain[1] < 0.008, "{in_vain:?}");
}

#[test]
fn what_has_no_extent_is_a_point() {
    let sector = SphericalSector { apex: DVec3::ZERO, axis: DVec3::X, range: 2.0, half_angle: 0.5 };
    let point = |center: DVec3| Hexahedron::of_box(&OrientedBox::along_axes(center, DVec3::ZERO));
    let distance = |x: f64, y: f64| point(DVec3::new(x, y, 0.0)).least_distance(&sector);
    assert!((distance(1.5, 0.4) - 1.5f64.hypot(0.4)).abs() < 1e-12);
    assert_eq!(distance(1.5, 1.4), f64::INFINITY);
    assert_eq!(distance(-1.0, 0.0), f64::INFINITY);
    assert_eq!(distance(0.0, 0.0), 0.0);
}
