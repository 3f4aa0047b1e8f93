//! The road and the pavements.

use glam::Vec3;

use super::super::Detail;
use super::super::maths::{Place, noise};
use super::super::mesh::Chunk;
use super::super::palette::Surface;
use super::{ROWS, distance_to_flight};

/// Side of a ground tile, metres.
const TILE: f32 = 10.0;
/// Width of the pavement along the houses, without its kerb.
const PAVEMENT: f32 = 2.2;
/// Height of the pavement over the road.
const PAVEMENT_HEIGHT: f32 = 0.14;

/// Road tiles under the streets, each in its own space.
pub(super) fn tiles(detail: &Detail) -> Vec<(Chunk, Place)> {
    let mut tiles = Vec::new();
    for i in -6..8 {
        for j in -6..6 {
            let corner = Vec3::new(i as f32 * TILE, 0.0, j as f32 * TILE);
            if is_paved(corner + Vec3::new(TILE, 0.0, TILE) * 0.5) {
                tiles.push((tile(corner, detail), Place::at(corner.x, 0.0, corner.z)));
            }
        }
    }
    tiles
}

/// Whether a tile lies near the flight through the streets or in front of a row.
fn is_paved(centre: Vec3) -> bool {
    let before_row = ROWS.iter().flat_map(|row| row.points.windows(2)).any(|ends| {
        let (ex, ez) = (ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
        let length = (ex * ex + ez * ez).sqrt();
        let (px, pz) = (centre.x - ends[0][0], centre.z - ends[0][1]);
        let (along, out) = ((px * ex + pz * ez) / length, (pz * ex - px * ez) / length);
        (-4.0..length + 4.0).contains(&along) && (-8.0..10.0).contains(&out)
    });
    before_row || distance_to_flight(centre) < 11.0
}

fn tile(corner: Vec3, detail: &Detail) -> Chunk {
    let mut chunk = Chunk::default();
    let cells = if detail.level == 0 { 2 } else { detail.cells(TILE * 0.9) };
    chunk.on(Surface::Road).surface([cells; 2], |u, v| {
        let (x, z) = (corner.x + TILE * u, corner.z + TILE * (1.0 - v));
        // Dips worn into the road, and single setts that stand out.
        let worn = noise(x * 0.3, z * 0.3, 1 << 20, 1);
        let sett = noise(x * 3.1, z * 3.1, 1 << 20, 2);
        let lift = if detail.level == 0 { 0.0 } else { 0.05 * worn + 0.02 * sett };
        (Vec3::new(TILE * u, lift, TILE * (1.0 - v)), [x, -z])
    });
    if detail.level > 0 {
        let mut cover = Chunk::default();
        let profile = [[0.42, 0.0], [0.42, 0.075], [0.36, 0.08], [0.36, 0.07], [0.0, 0.07]];
        cover.on(Surface::Iron).lathe(&profile, detail.around(1.0, 12), false);
        chunk.append(&cover, &Place::at(TILE * 0.37, 0.0, TILE * 0.58));
    }
    chunk
}

/// Pavement and kerb before the stretch `x` of a front; its ends move by `mitre` for each metre of z.
pub(super) fn pavement(x: [f32; 2], mitre: [f32; 2], detail: &Detail, chunk: &mut Chunk) {
    let y = PAVEMENT_HEIGHT;
    let kerb = PAVEMENT + 0.25;
    let outline = [[kerb, 0.0], [kerb, y], [PAVEMENT, y], [PAVEMENT, y], [0.0, y]];
    let end = |side: usize, z: f32| x[side] + mitre[side] * z;
    let mesh = chunk.on(Surface::Pavement);
    for span in outline.windows(2).filter(|span| span[0] != span[1]) {
        let [[z0, y0], [z1, y1]] = [span[0], span[1]];
        let rise = (z0 - z1) + (y1 - y0);
        mesh.surface([detail.cells(x[1] - x[0]), detail.cells(rise)], |u, v| {
            let (z, y) = (z0 + (z1 - z0) * v, y0 + (y1 - y0) * v);
            let along = end(0, z) + (end(1, z) - end(0, z)) * u;
            (Vec3::new(along, y, z), [along, rise * v - z0])
        });
    }
    for side in [0, 1] {
        let mut points =
            [[0.0, 0.0], [kerb, 0.0], [kerb, y], [0.0, y]].map(|[z, y]| Vec3::new(end(side, z), y, z));
        let mut along = Vec3::Z;
        if side == 1 {
            points.reverse();
            along = -Vec3::Z;
        }
        mesh.polygon(&points, [along, Vec3::Y]);
    }
}
