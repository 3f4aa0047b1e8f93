//! Which lattice has so many lights.

use super::LightSet;

/// The set of one volume whose lattice is to be found: the one asked for, if it divides the number of lights.
pub(super) fn set_of_one(count: u32, asked: Option<LightSet>) -> Result<LightSet, String> {
    let set = asked.unwrap_or(LightSet::ONE);
    let factor = set.factor();
    if count.is_multiple_of(factor) {
        return Ok(set);
    }
    let near = (count / factor).max(1) * factor;
    Err(format!("{count} lights: the set {set} has a multiple of {factor}, such as {near}"))
}

/// The set of `count` lights over lattices with `base` lights in all: the one asked for, or the one that has so many
/// and the greater factor along the earlier axis.
pub(super) fn set_of_base(count: u32, base: u64, asked: Option<LightSet>) -> Result<LightSet, String> {
    let lights = |set: &LightSet| base * u64::from(set.factor());
    if let Some(set) = asked {
        return match lights(&set) {
            wanted if wanted == u64::from(count) => Ok(set),
            wanted => Err(format!(
                "{count} lights: the set {set} of lattices with {base} in all has {wanted}: ask for so many"
            )),
        };
    }
    if let Some(set) = LightSet::descending().find(|set| lights(set) == u64::from(count)) {
        return Ok(set);
    }
    let mut possible: Vec<u64> = LightSet::descending().map(|set| lights(&set)).collect();
    possible.sort_unstable();
    possible.dedup();
    let possible = possible.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
    Err(format!(
        "{count} lights: no set of lattices with {base} in all has so many: ask for one of {possible}"
    ))
}

/// The lattice of `count` points whose cells in a box of these sides (metres) are nearest to cubes: the longest side of
/// a cell over its shortest is least. Of equal ones it has the fewest points along x, then y. A side of no length has
/// one point, where the count allows it.
pub(super) fn nearest_to_cubes(count: u32, sides: [f64; 3]) -> [u32; 3] {
    let longest = sides.into_iter().fold(0.0, f64::max);
    let sides = sides.map(|side| side.max(1e-9 * longest).max(f64::MIN_POSITIVE));
    let divisors =
        |of: u32| (1..=of.isqrt()).filter(move |n| of.is_multiple_of(*n)).flat_map(move |n| [n, of / n]);
    let lattices = divisors(count).flat_map(|x| divisors(count / x).map(move |y| [x, y, count / x / y]));
    let flatness = |lattice: [u32; 3]| {
        let cell: [f64; 3] = std::array::from_fn(|axis| sides[axis] / f64::from(lattice[axis]));
        let (longest, shortest) =
            (cell.into_iter().fold(0.0, f64::max), cell.into_iter().fold(f64::MAX, f64::min));
        longest / shortest
    };
    let better = |a: &[u32; 3], b: &[u32; 3]| flatness(*a).total_cmp(&flatness(*b)).then(a.cmp(b));
    lattices.min_by(better).unwrap_or([count, 1, 1])
}
