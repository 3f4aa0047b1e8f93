//! Lights that touch clusters by the last bit of their radius: the slack of the radii must keep every one.

use super::cases::{ORTHO, ORTIZ, PERSP, box_grid, fragments_of, frustum_grid, noise, rain, random_bits};
use super::{Context, Verdict};
use crate::config::{Assign, Test};
use crate::engine::workbench::Case;
use crate::geometry::{CellTest, Grid, LightVolume, SphereTest};
use crate::lights::Light;
use crate::measure::Capacities;
use crate::{Result, cpu};
use glam::DVec3;

/// How many lights touch in each case.
const COUNT: usize = 2000;

/// Lights that touch are on the lists of what they touch.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let (persp, ortho) = ((PERSP, frustum_grid([7, 6, 13])), (ORTHO, box_grid([11, 9, 13])));
    let boxed = (ORTIZ, persp.1);
    let cases = [
        (persp, SphereTest::HALF_SPACES),
        (persp, SphereTest::Exact),
        (boxed, SphereTest::Box),
        (ortho, SphereTest::Box),
    ];
    for ((method, grid), test) in cases {
        let clusters = grid.cluster_count();
        let bits = random_bits(clusters, 2, 5);
        let visible = cpu::compact(&fragments_of(&bits, clusters)).visible;
        let (touched, lights): (Vec<u32>, Vec<Light>) =
            touching_lights(&grid, &visible, 30.0, COUNT)?.into_iter().unzip();
        let capacities = Capacities {
            visible_clusters: clusters as u32,
            light_indices: 4_000_000,
            ..Capacities::default()
        };
        let case = Case { method, grid, lights: &lights, capacities };
        let bench = context.bench((Assign::Brute, Test::from(test)), case)?;
        bench.compact(&bits)?;
        let lists = bench.lists()?;
        let lost = (0u32..).zip(&touched).filter(|(light, cluster)| {
            let place = visible.binary_search(cluster);
            place.is_ok_and(|list| lists.of(list).binary_search(light).is_err())
        });
        let lost = lost.count();
        if lost > 0 {
            return Ok(Verdict::Wrong(format!(
                "{lost} of {COUNT} lights that touch a cluster of {method} are not on its list by test {test}"
            )));
        }
    }
    Ok(Verdict::Fine(format!("{} lights that touch a cluster by a bit are on its list", cases.len() * COUNT)))
}

/// Lights with the clusters that each touches, by the last bit of its radius or little more; they lie in all directions from
/// these, up to `farthest` metres away.
///
/// # Errors
/// As [`rain`], of which they are made.
pub fn touching_lights(
    grid: &Grid,
    visible: &[u32],
    farthest: f64,
    count: usize,
) -> Result<Vec<(u32, Light)>> {
    let template = rain(1)?[0];
    let mut random = noise(77);
    let mut unit = move || f64::from(random() % 65_536) / 65_536.0;
    let mut found = Vec::new();
    while found.len() < count {
        let cluster = visible[(unit() * visible.len() as f64) as usize];
        let cell = grid.cluster_at(cluster);
        let inside = DVec3::from_array(cell.map(|index| f64::from(index) + unit()));
        let away = DVec3::new(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalize_or(DVec3::X);
        let local = grid.point_at(inside) + away * farthest * 1e-3f64.powf(unit());
        let position = grid.pose.transform_point(local).as_vec3();
        let center = grid.pose.inverse_transform_point(position.as_dvec3());
        let distance =
            -CellTest::new(SphereTest::Exact, grid, cell).margin(&LightVolume::sphere(center, 0.0));
        if distance > 0.01 {
            let r1 = (distance as f32).next_up();
            found.push((cluster, Light { position: position.to_array(), r1, ..template }));
        }
    }
    Ok(found)
}
