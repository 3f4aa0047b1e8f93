//! From the deepest cells up (Tegelaers section 7.1.2): cells that lights fill, merged eight by eight.

use super::light_grid::LightGrid;
use super::tree::Node;
use glam::UVec3;
use rayon::prelude::*;

/// Nodes of a depth by their code, ascending; those without lights are left out.
type Level = Vec<(u64, Node)>;

/// The scene's octree of the grids of its lights, `depth` levels below its root; `None` where its deepest cells hold more than `most`
/// lights together.
pub(super) fn join(grids: &[LightGrid], depth: u32, most: usize) -> Option<Node> {
    let mut filled: Vec<(u64, u32)> = Vec::new();
    for (light, grid) in (0..).zip(grids) {
        filled.extend(grid.cells().map(|cell| (code(cell), light)));
        if filled.len() > most {
            return None;
        }
    }
    filled.par_sort_unstable();
    let mut level: Level = filled
        .chunk_by(|a, b| a.0 == b.0)
        .map(|cell| (cell[0].0, Node::Leaf(cell.iter().map(|(_, light)| *light).collect())))
        .collect();
    for _ in 0..depth {
        level = parents(level);
    }
    Some(level.pop().map_or(Node::EMPTY, |(_, root)| root))
}

/// The nodes one depth above.
fn parents(level: Level) -> Level {
    let mut above: Vec<(u64, [Node; 8])> = Vec::new();
    for (code, node) in level {
        let parent = code >> 3;
        if above.last().is_none_or(|(last, _)| *last != parent) {
            above.push((parent, [Node::EMPTY; 8]));
        }
        let (_, children) = above.last_mut().expect("the parent was just put there");
        children[(code & 7) as usize] = node;
    }
    above.into_iter().map(|(code, children)| (code, Node::of_children(children))).collect()
}

/// The code of a cell (Morton): three bits a depth, x + 2y + 4z of the child that holds it.
fn code(cell: UVec3) -> u64 {
    spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2
}

/// The lowest 21 bits, each with two zeros before it.
fn spread(value: u32) -> u64 {
    (0..21).fold(0, |spread, bit| spread | u64::from(value >> bit & 1) << (3 * bit))
}
