//! Light lists by all ways: the same word for word, and those of the CPU twin but for pairs that it marks as too close to
//! call.

use super::cases::{ORTHO, PERSP, box_grid, fragments_of, frustum_grid, rain, random_bits, random_lights};
use super::{Context, Verdict};
use crate::config::{Assign, Test};
use crate::engine::workbench::{Case, Lists, Room};
use crate::geometry::Grid;
use crate::lights::Light;
use crate::measure::Capacities;
use crate::methods::Method;
use crate::{Result, cpu};

/// How close to a boundary f32 may decide otherwise, metres.
const EPSILON: f64 = 1e-4;

const WAYS: [(Assign, Room); 5] = [
    (Assign::Brute, Room::None),
    (Assign::Hierarchy, Room::Plenty),
    (Assign::Hierarchy, Room::None),
    (Assign::Scatter, Room::Plenty),
    (Assign::Scatter, Room::None),
];

/// Grids of both spaces, and lights of one size and of very many.
pub fn check(context: &mut Context) -> Result<Verdict> {
    let mixed = || random_lights(3001, 4, 40.0, |u| 0.02 * 10_000f32.powf(u * u));
    let mut indices = 0;
    for (method, grid) in [(PERSP, frustum_grid([13, 9, 21])), (ORTHO, box_grid([17, 13, 11]))] {
        for lights in [rain(1000)?, mixed()] {
            let brute = lists_by(context, (Assign::Brute, Room::Plenty), (method, grid), &lights)?;
            let twin = twin_of((method, grid), &lights);
            if let Some(fault) = twin_fault(&brute, &twin) {
                return Ok(Verdict::Wrong(format!("brute force of {method}: {fault}")));
            }
            for way in WAYS {
                let lists = lists_by(context, way, (method, grid), &lights)?;
                if let Some(fault) = unlike(&lists, &brute) {
                    let how = if way.1 == Room::None { ", counted and sorted" } else { "" };
                    return Ok(Verdict::Wrong(format!("{}{how} of {method}: {fault}", way.0)));
                }
            }
            indices += brute.indices.len();
        }
    }
    Ok(Verdict::Fine(format!("brute force, hierarchy and scatter list the CPU twin's {indices} lights")))
}

fn bits(grid: &Grid) -> Vec<u32> {
    random_bits(grid.cluster_count(), 7, 11)
}

fn lists_by(
    context: &mut Context,
    (assign, room): (Assign, Room),
    (method, grid): (Method, Grid),
    lights: &[Light],
) -> Result<Lists> {
    let capacities = Capacities {
        visible_clusters: grid.cluster_count() as u32,
        light_indices: 6_000_000,
        ..Capacities::default()
    };
    let bench = context.bench((assign, Test::Auto), Case { method, grid, lights, capacities })?;
    bench.leave(room);
    bench.compact(&bits(&grid))?;
    bench.lists()
}

fn twin_of((method, grid): (Method, Grid), lights: &[Light]) -> cpu::LightLists {
    let clusters = grid.cluster_count();
    let visible = cpu::compact(&fragments_of(&bits(&grid), clusters)).visible;
    cpu::assign(&grid, &visible, lights, Test::Auto.of(&method), EPSILON)
}

/// The first list that differs from another way's, if there is one.
fn unlike(lists: &Lists, others: &Lists) -> Option<String> {
    if lists.offsets != others.offsets {
        let [own, other] = [lists, others].map(|lists| lists.offsets.last().copied().unwrap_or(0));
        return Some(format!("lists of {own} lights in all, {other} by brute force"));
    }
    let count = lists.offsets.len() - 1;
    let differing = (0..count).filter(|&list| lists.of(list) != others.of(list)).count();
    (differing > 0).then(|| format!("{differing} of {count} lists are not those of brute force"))
}

/// The first list that differs from its twin's by more than pairs too close to call, or does not ascend.
pub fn twin_fault(lists: &Lists, twin: &cpu::LightLists) -> Option<String> {
    if lists.offsets.len() != twin.offsets.len() {
        return Some(format!("{} lists, {} by the CPU", lists.offsets.len() - 1, twin.offsets.len() - 1));
    }
    twin.borderline.iter().enumerate().find_map(|(number, close)| {
        let sure = |list: &[u32]| -> Vec<u32> {
            list.iter().copied().filter(|light| close.binary_search(light).is_err()).collect()
        };
        let (own, wanted) = (sure(lists.of(number)), sure(twin.list(number)));
        let ascends = lists.of(number).is_sorted();
        (own != wanted || !ascends).then(|| match ascends {
            false => format!("list {number} does not ascend"),
            true if own.len() == wanted.len() => format!("list {number} has other lights than by the CPU"),
            true => format!("list {number} has {} lights, {} by the CPU", own.len(), wanted.len()),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_that_differ_are_told_apart_but_for_pairs_too_close_to_call() {
        let lists = |indices: &[u32]| Lists { offsets: vec![0, 1, 3], indices: indices.to_vec() };
        let twin = |close: Vec<u32>| cpu::LightLists {
            offsets: vec![0, 1, 3],
            indices: vec![4, 1, 2],
            borderline: vec![vec![], close],
        };
        assert_eq!(twin_fault(&lists(&[4, 1, 2]), &twin(vec![])), None);
        assert!(
            twin_fault(&lists(&[4, 1, 3]), &twin(vec![])).unwrap().starts_with("list 1 has other lights")
        );
        assert_eq!(twin_fault(&lists(&[4, 1, 3]), &twin(vec![2, 3])), None);
        assert_eq!(twin_fault(&lists(&[4, 2, 1]), &twin(vec![])).unwrap(), "list 1 does not ascend");
        assert_eq!(unlike(&lists(&[4, 1, 2]), &lists(&[4, 1, 2])), None);
        assert!(unlike(&lists(&[4, 1, 2]), &lists(&[4, 1, 3])).unwrap().starts_with("1 of 2 lists"));
    }
}
