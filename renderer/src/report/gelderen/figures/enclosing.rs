//! Enclosing clustering of views that look apart (4.7).

use crate::geometry::views::{Mirror, Pose, View};
use crate::geometry::{ClusterSpace, DisplacedVolume, Frustum, Grid};
use crate::methods::grid::plan;
use crate::methods::{Sharing, Space};
use crate::recording::{EyeRow, Hmd};
use crate::report::chart::{Chart, Key, Look};
use crate::report::computed::picture;
use crate::report::figure::Figure;
use crate::{Error, Result};
use glam::{DVec2, DVec3};

/// Pixels.
const SIZE: [u32; 2] = [540, 300];
/// Metres across the picture.
const WIDTH: f64 = 38.0;
/// What lies in its middle: x and z, metres.
const MIDDLE: DVec2 = DVec2::new(0.0, -3.0);
/// Half of the width of a line, metres.
const LINE: f64 = 0.08;
/// Distance of the far plane, metres.
const FAR: f64 = 12.0;
/// Distance of the mirror, metres.
const MIRROR: f64 = 3.0;

const PAPER: DVec3 = DVec3::splat(1.0);
const EYES: DVec3 = DVec3::new(0.0, 0.62, 0.45);
const SEEN: DVec3 = DVec3::new(0.0, 0.45, 0.7);
const BOX: DVec3 = DVec3::new(0.84, 0.37, 0.0);
const INK: DVec3 = DVec3::splat(0.0);

/// The two eyes of a Vive before a wall that reflects, with the box that Encl Ortho divides, from above.
///
/// # Errors
/// The picture cannot be encoded.
pub fn figure() -> Result<Figure> {
    let views = views()?;
    let grids = plan(Space::Ortho { metres: 2.0 }, Sharing::Encl, &views, [640, 720], DisplacedVolume::View)?;
    let grid = grids.first().ok_or_else(|| Error::Internal("Encl plans one grid".into()))?;
    let seen = |at: DVec2| seen_from_above(&views, grid, place(at));
    let plot = picture(SIZE, "Two eyes, a mirror and the box around their frusta, from above", seen)?;
    let key = |label: &str, color| Key { label: label.into(), look: Look::plain(color) };
    let chart = Chart {
        names: ["", "", "picture", "number"],
        columns: vec![String::new()],
        rows: vec![String::new()],
        panels: vec![Some(plot)],
        legend: vec![
            key("eyes", "green"),
            key("what they see in the mirror", "blue"),
            key("clustering", "vermillion"),
        ],
        ..Chart::default()
    };
    Ok(Figure {
        id: "4.7".into(),
        title: "Enclosing clustering for eyes and a mirror".into(),
        caption: format!(
            "Computed, not measured: the two eyes of an HTC Vive before a wall that reflects (black), {MIRROR} m \
             ahead, from above. The view in the mirror looks back, from behind the wall; what lies between is not \
             drawn in it (pale). No frustum encloses both. The box of Encl Ortho does, and is divided evenly."
        ),
        setting: String::new(),
        chart: Some(chart),
    })
}

fn views() -> Result<Vec<View>> {
    let mirror = Mirror { normal: DVec3::Z, offset: -MIRROR };
    let eyes = Hmd::vive().with_mirror(mirror).eyes;
    let view = |(row, mirror): (&EyeRow, Option<Mirror>)| {
        let [x0, x1, y0, y1] = row.tangents;
        let view = View {
            pose: Pose { mirror, ..row.pose },
            frustum: Frustum { x0, x1, y0, y1, z0: -FAR, z1: -0.4 },
        };
        view.validate().map(|()| view)
    };
    let rows = eyes.iter().flat_map(|eye| {
        let mirror = eye.mirror.first().map(|row| row.0);
        eye.rows.iter().map(move |row| (row, mirror))
    });
    rows.map(view).collect()
}

/// The world's (x, z) at a place of the picture, where -z is up.
fn place(at: DVec2) -> DVec2 {
    let height = WIDTH * f64::from(SIZE[1]) / f64::from(SIZE[0]);
    MIDDLE + (at - 0.5) * DVec2::new(WIDTH, height)
}

fn seen_from_above(views: &[View], grid: &Grid, at: DVec2) -> DVec3 {
    let world = DVec3::new(at.x, 0.0, at.y);
    let mut color = PAPER;
    for view in views {
        let local = view.pose.inverse_transform_point(world);
        if !view.frustum.contains(local) {
            continue;
        }
        let (tint, hidden) = match view.pose.mirror {
            Some(mirror) => (SEEN, mirror.plane().dot(world.extend(1.0)) < 0.0),
            None => (EYES, false),
        };
        color = color.lerp(tint, if hidden { 0.12 } else { 0.35 });
    }
    if let Some(strength) = box_line(grid, world) {
        color = color.lerp(BOX, strength);
    }
    let on_wall = (at.y + MIRROR).abs() < 1.5 * LINE && at.x.abs() < 5.0;
    let at_eye = views.iter().any(|view| view.eye().distance(world) < 3.0 * LINE);
    if on_wall || at_eye { INK } else { color }
}

/// How strongly a line of the grid is drawn at a point: its outline most; `None` off all lines.
fn box_line(grid: &Grid, world: DVec3) -> Option<f64> {
    let ClusterSpace::Orthographic { min, max } = grid.space else { return None };
    let local = grid.pose.inverse_transform_point(world);
    let lines = [0, 2].map(|axis| {
        let cell = (max - min)[axis] / f64::from(grid.dimensions[axis]);
        let across = if axis == 0 { 2 } else { 0 };
        let within = (min[across] - LINE..=max[across] + LINE).contains(&local[across]);
        let inside = (min[axis] - LINE..=max[axis] + LINE).contains(&local[axis]);
        let edge = (local[axis] - min[axis]).abs().min((local[axis] - max[axis]).abs()) < LINE;
        let part = (local[axis] - min[axis]) / cell;
        let inner = (part - part.round()).abs() * cell < 0.4 * LINE;
        match within && inside {
            true if edge => Some(1.0),
            true if inner => Some(0.4),
            _ => None,
        }
    });
    lines.into_iter().flatten().reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eyes_look_ahead_the_mirror_looks_back_and_the_box_holds_both() {
        let views = views().unwrap();
        let grid =
            plan(Space::Ortho { metres: 2.0 }, Sharing::Encl, &views, [640, 720], DisplacedVolume::View)
                .unwrap()
                .remove(0);
        let seen = |x: f64, z: f64| seen_from_above(&views, &grid, DVec2::new(x, z));
        // Ahead beyond the wall the eyes alone see; beside the head, the mirror alone; before the wall, both.
        let (ahead, behind, both, outside) =
            (seen(0.5, -11.5), seen(0.5, 4.5), seen(0.3, -2.5), seen(18.5, 8.0));
        assert!(ahead.y > ahead.z && behind.z > behind.y && outside == PAPER, "{ahead} {behind} {outside}");
        assert!(both.x < ahead.x && both.x < behind.x);
        assert_eq!(seen(0.0, -MIRROR), INK);
        for view in &views {
            for corner in view.frustum.corners() {
                assert!(grid.cluster_of(view.pose.transform_point(corner)).is_some());
            }
        }
    }
}
