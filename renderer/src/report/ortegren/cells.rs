//! Clusters as they lie before the camera, from the side, from above and from the eye: those that the mesh of one spot light meets
//! (KF11), and those that hold what is seen, near the camera (KF16) and far from it (KF17).
//!
//! ```text
//! a spot ─mesh─> shell of each tile ──────────────────┐
//! EXR ─cluster of each pixel─> grid of the recording ─┴─> clusters ─(as one along the direction of sight)─> picture
//! ```

use super::evaluation::{Case, Evaluation};
use crate::cpu::{ShellGrid, placed_shell, shell_grid};
use crate::geometry::views::{Pose, View};
use crate::geometry::{
    ClusterSpace, DisplacedVolume, Frustum, Grid, LightMesh, MeshFrame, MeshKind, SphericalSector,
};
use crate::gpu_interface;
use crate::methods::Method;
use crate::methods::grid::Division;
use crate::report::chart::{Chart, Plot};
use crate::report::computed::picture;
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::results::{Run, Setting};
use crate::report::way::Way;
use crate::{Error, Result, recording};
use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const PAPER: DVec3 = DVec3::splat(1.0);
/// Within the camera's frustum.
const SEEN: DVec3 = DVec3::splat(0.93);
/// Clusters, by the parity of their two indices.
const CLUSTERS: [DVec3; 2] = [DVec3::new(0.35, 0.62, 0.9), DVec3::new(0.16, 0.42, 0.75)];
/// Edges of a mesh.
const INK: DVec3 = DVec3::new(0.84, 0.37, 0.0);
/// Half of the width of an edge, in parts of a picture's height.
const EDGE: f64 = 0.004;

/// Where clusters are looked at from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum From {
    /// Depth goes to the right, up is up.
    Side,
    /// Depth goes to the right, the camera's right is down.
    Above,
    /// As the camera sees them, at a depth of one metre.
    Eye,
}

impl From {
    /// The two axes of cells that are told apart.
    const fn axes(self) -> [usize; 2] {
        match self {
            Self::Side => [2, 1],
            Self::Above => [2, 0],
            Self::Eye => [0, 1],
        }
    }

    fn key(self, cell: [u32; 3]) -> [u32; 2] {
        self.axes().map(|axis| cell[axis])
    }

    /// Where a point of the camera's space is seen, metres: to the right, up.
    fn projected(self, point: DVec3) -> DVec2 {
        match self {
            Self::Side => DVec2::new(-point.z, point.y),
            Self::Above => DVec2::new(-point.z, -point.x),
            Self::Eye => point.truncate() / -point.z,
        }
    }

    /// A point of the camera's space that is seen at a place, in the middle of what lies behind it.
    fn unprojected(self, at: DVec2, frustum: &Frustum) -> DVec3 {
        let middle = DVec2::new(frustum.x0 + frustum.x1, frustum.y0 + frustum.y1) / 2.0;
        match self {
            Self::Side => DVec3::new(middle.x * at.x, at.y, -at.x),
            Self::Above => DVec3::new(-at.y, middle.y * at.x, -at.x),
            Self::Eye => at.extend(-1.0) * (frustum.z0 * frustum.z1).sqrt(),
        }
    }
}

/// Some clusters of a perspective grid, with edges of a mesh in its space.
struct Shown<'a> {
    grid: &'a Grid,
    frustum: Frustum,
    clusters: &'a BTreeSet<u32>,
    edges: &'a [[DVec3; 2]],
}

/// A part of what is seen: its lower left and upper right corner, metres.
type Window = [DVec2; 2];

impl Shown<'_> {
    fn picture(&self, size: [u32; 2], alt: &str, from: From, [low, high]: Window) -> Result<Plot> {
        let keys: BTreeSet<[u32; 2]> =
            self.clusters.iter().map(|&cluster| from.key(self.grid.cluster_at(cluster))).collect();
        let edges: Vec<[DVec2; 2]> =
            self.edges.iter().map(|edge| edge.map(|end| from.projected(end))).collect();
        let width = EDGE * (high.y - low.y);
        picture(size, alt, |at| {
            let place = low + (high - low) * DVec2::new(at.x, 1.0 - at.y);
            match edges.iter().any(|edge| distance(*edge, place) < width) {
                true => INK,
                false => self.color(from, &keys, place),
            }
        })
    }

    fn color(&self, from: From, keys: &BTreeSet<[u32; 2]>, place: DVec2) -> DVec3 {
        let cell = self.grid.cluster_of_local(from.unprojected(place, &self.frustum));
        match cell.map(|cell| from.key(cell)) {
            None => PAPER,
            Some(key) if keys.contains(&key) => CLUSTERS[(key[0] + key[1]) as usize % 2],
            Some(_) => SEEN,
        }
    }
}

/// How far a point lies from a segment.
fn distance([from, to]: [DVec2; 2], point: DVec2) -> f64 {
    let step = to - from;
    let along = ((point - from).dot(step) / step.length_squared()).clamp(0.0, 1.0);
    (from + step * along).distance(point)
}

/// The grid of KF11 in the paper, 24x12x64 exponential, of its camera.
fn grid_of_a_spot() -> Result<Grid> {
    let y = (45f64.to_radians() / 2.0).tan();
    let frustum = Frustum { x0: -2.0 * y, x1: 2.0 * y, y0: -y, y1: y, z0: -60.0, z1: -0.2 };
    let view = View { pose: Pose::IDENTITY, frustum };
    planned("raster-24-12-64-e".parse()?, &[view], [1536, 768])
}

/// One grid of one view, with slices by the law of a method's name.
fn planned(method: Method, views: &[View], resolution: [u32; 2]) -> Result<Grid> {
    let Method::Grid(grid) = method else { return Err(Error::Internal(format!("{method} has no grid"))) };
    let division = Division { volume: DisplacedVolume::View, slices: grid.slices };
    let grids = grid.plan(&views[..1], resolution, division)?;
    grids.into_iter().next().ok_or_else(|| Error::Internal(format!("{method} plans no grid")))
}

fn frustum_of(grid: &Grid) -> Result<Frustum> {
    match grid.space {
        ClusterSpace::Perspective { frustum, .. } => Ok(frustum),
        ClusterSpace::Orthographic { .. } => Err(no_frustum()),
    }
}

fn no_frustum() -> Error {
    Error::Internal("a grid of boxes has no frustum".into())
}

/// The clusters that a mesh meets, by the twin of the device's shells, in the grid's own space.
fn clusters_of(grid: &Grid, mesh: &LightMesh, frame: &MeshFrame) -> Result<BTreeSet<u32>> {
    let [columns, rows, slices] = grid.dimensions;
    let (data, planes) = shell_grid(grid).ok_or_else(no_frustum)?;
    let frame = gpu_interface::MeshFrame::from(frame);
    let ranges = placed_shell(&ShellGrid { grid: &data, planes: &planes }, mesh, &frame);
    let of_tile = |(tile, range): (u32, Option<[u32; 2]>)| {
        let [first, last] = range.unwrap_or([1, 0]);
        (first..=last).map(move |slice| tile + columns * rows * slice)
    };
    Ok((0..).zip(ranges.into_iter().map(|range| range.slices(slices))).flat_map(of_tile).collect())
}

/// KF11.
///
/// # Errors
/// A picture cannot be encoded.
pub fn spot() -> Result<Figure> {
    let grid = grid_of_a_spot()?;
    let sector = SphericalSector {
        apex: DVec3::new(1.2, 1.2, -6.0),
        axis: DVec3::new(-0.7, -1.0, -0.6).normalize(),
        range: 3.3,
        half_angle: 0.5,
    };
    let (mesh, frame) = (LightMesh::new(MeshKind::Spot), MeshFrame::of_sector(&sector));
    let clusters = clusters_of(&grid, &mesh, &frame)?;
    let placed = |end: u16| frame.place(mesh.vertices[usize::from(end)]);
    let edges: Vec<[DVec3; 2]> = mesh.edges().map(|edge| edge.map(placed)).collect();
    let shown = Shown { grid: &grid, frustum: frustum_of(&grid)?, clusters: &clusters, edges: &edges };
    let views = [
        ("from the side", From::Side, [DVec2::new(4.0, -3.0), DVec2::new(11.0, 2.6)]),
        ("from above", From::Above, [DVec2::new(4.0, -3.2), DVec2::new(11.0, 2.4)]),
        ("from the eye", From::Eye, [DVec2::new(-0.4, -0.45), DVec2::new(0.5, 0.27)]),
    ];
    let picture = |&(name, from, window): &(&str, From, Window)| {
        shown.picture([350, 280], &format!("Clusters of a spot, {name}"), from, window).map(Some)
    };
    Ok(Figure {
        id: "KF11".into(),
        title: "Clusters of a spot light".into(),
        caption: format!(
            "Computed, not measured: a spot that reaches {} m, its mesh (edges) and the {} clusters of 24x12x64 exponential slices that \
             this meets, those that lie behind each other as one. Grey is what the camera sees.",
            sector.range,
            clusters.len()
        ),
        setting: String::new(),
        chart: Some(Chart {
            names: ["", "seen", "picture", "number"],
            columns: views.iter().map(|(name, ..)| (*name).into()).collect(),
            rows: vec![String::new()],
            panels: views.iter().map(picture).collect::<Result<_>>()?,
            ..Chart::default()
        }),
    })
}

/// The clusters that pixels of a rendered frame lie in; `None` where no picture tells.
///
/// # Errors
/// The file is no EXR image.
fn used_clusters(path: &Path) -> Result<Option<BTreeSet<u32>>> {
    if !path.is_file() {
        return Ok(None);
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .map_err(|error| Error::file(path, format!("is no EXR image that can be read: {error}")))?;
    let channels = image.layer_data.channel_data.list;
    let clusters = channels.into_iter().find(|channel| channel.name.to_string() == "cluster_index");
    Ok(match clusters.map(|channel| channel.sample_data) {
        Some(FlatSamples::U32(indices)) => Some(indices.into_iter().collect()),
        _ => None,
    })
}

/// The grid of the first frame of a run that has a picture, and the clusters that are used in it; `None` where its recording is not at
/// hand any more.
fn used(run: &Run) -> Result<Option<(Grid, BTreeSet<u32>)>> {
    let Some(picture) = run.pictures.first() else { return Ok(None) };
    let Ok(recording) = recording::load(&run.setting.recording) else { return Ok(None) };
    if recording.sha256() != run.setting.hashes[1] {
        return Ok(None);
    }
    let views = recording.views(picture.frame, run.setting.resolution)?;
    let grid = planned(run.method, &views, run.setting.resolution)?;
    let Some(mut clusters) = used_clusters(&picture.image.with_extension("exr"))? else { return Ok(None) };
    clusters.retain(|cluster| u64::from(*cluster) < grid.cluster_count());
    Ok((run.grid == Some(grid.dimensions)).then_some((grid, clusters)))
}

/// Runs by both laws.
type Laws<'a> = [&'a Case<'a>; 2];

/// Of the most lights of an evaluation, those of the grid of most clusters that has pictures.
fn both_laws<'a>(evaluation: &'a Evaluation) -> Option<Laws<'a>> {
    let most = evaluation.lights().last().copied()?;
    let pictured = || evaluation.of_lights(most).filter(|case| !case.run.pictures.is_empty());
    let pairs = pictured().filter(|case| !case.linear).filter_map(|case| {
        let linear = pictured().find(|other| other.linear && other.grid == case.grid)?;
        Some([case, linear])
    });
    pairs.max_by_key(|[case, _]| (case.clusters(), case.grid))
}

/// Those of each setting, however lists are kept: which clusters are used does not depend on that.
fn of_settings<'a>(evaluations: &'a [Evaluation]) -> Vec<(&'a Setting, Laws<'a>)> {
    let mut found: BTreeMap<Setting, (&Setting, Laws)> = BTreeMap::new();
    for evaluation in evaluations {
        let Some(laws) = both_laws(evaluation) else { continue };
        let this = (&evaluation.setting, laws);
        let kept = found.entry(evaluation.setting.by(&Way::default())).or_insert(this);
        if kept.1[0].clusters() < laws[0].clusters() {
            *kept = this;
        }
    }
    found.into_values().collect()
}

/// A picture of each law, with how many clusters are used.
fn chart(laws: Laws, from: From, window: Window) -> Result<Option<(Chart, String)>> {
    let mut chart =
        Chart { names: ["grid", "", "picture", "number"], columns: vec![String::new()], ..Chart::default() };
    let mut counts = vec![];
    for case in laws {
        let Some((grid, clusters)) = used(case.run)? else { return Ok(None) };
        let shown = Shown { grid: &grid, frustum: frustum_of(&grid)?, clusters: &clusters, edges: &[] };
        let alt = format!("Clusters that are used, {}", case.name());
        let size = (window[1] - window[0]) * (720.0 / (window[1].x - window[0].x));
        chart.panels.push(Some(shown.picture([720, size.y.round() as u32], &alt, from, window)?));
        chart.rows.push(case.name());
        counts.push(format!("{}: {}", case.name(), clusters.len()));
    }
    Ok(Some((chart, format!(" Clusters used in all: {}.", counts.join(", ")))))
}

/// KF16 and KF17.
///
/// # Errors
/// A rendered frame cannot be read.
pub fn near_and_far(evaluations: &[Evaluation]) -> Result<Vec<Figure>> {
    let missing =
        "needs rendered frames of raster methods by both laws, and their recording: replay with --exr";
    let near = Wanted {
        id: "KF16",
        title: "Clusters near the camera",
        caption: "Those that hold a pixel, from the side, up to 12 m; those that lie behind each other as one. Grey is what the camera sees.",
        missing,
    };
    let far = Wanted {
        id: "KF17",
        title: "Clusters far from the camera",
        caption: "The same from above, from 12 to 40 m.",
        missing,
    };
    let windows = [
        (near, From::Side, [DVec2::new(0.0, -2.5), DVec2::new(12.0, 2.5)]),
        (far, From::Above, [DVec2::new(12.0, -8.0), DVec2::new(40.0, 8.0)]),
    ];
    let mut all = vec![];
    for (wanted, from, window) in &windows {
        let mut drawn = vec![];
        for (setting, laws) in of_settings(evaluations) {
            if let Some((chart, remark)) = chart(laws, *from, *window)? {
                drawn.push(Drawn { setting, chart, remark });
            }
        }
        all.extend(figures(wanted, drawn));
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::results::Picture;
    use crate::report::testing::run;
    use exr::prelude::{AnyChannel, AnyChannels, Encoding, Image, Layer, LayerAttributes, WritableImage};

    fn pictured(grid: &Grid, clusters: &BTreeSet<u32>, from: From, place: DVec2) -> DVec3 {
        let shown = Shown { grid, frustum: frustum_of(grid).unwrap(), clusters, edges: &[] };
        let keys = clusters.iter().map(|&cluster| from.key(grid.cluster_at(cluster))).collect();
        shown.color(from, &keys, place)
    }

    #[test]
    fn a_cluster_is_seen_from_each_side_where_it_lies() {
        let grid = grid_of_a_spot().unwrap();
        let point = DVec3::new(1.0, -0.6, -7.0);
        let cluster = grid.linear(grid.cluster_of_local(point).unwrap());
        let clusters = BTreeSet::from([cluster]);
        for from in [From::Side, From::Above, From::Eye] {
            let at = from.projected(point);
            assert!(CLUSTERS.contains(&pictured(&grid, &clusters, from, at)), "{from:?}");
            let deeper = from.projected(DVec3::new(1.0, -0.6, -12.0));
            assert_eq!(pictured(&grid, &clusters, from, deeper), SEEN, "{from:?}");
            assert_eq!(pictured(&grid, &clusters, from, DVec2::new(3.0, 30.0)), PAPER, "{from:?}");
        }
    }

    /// Each cluster that the twin finds is near the mesh, and what lies in the spot is in one of them.
    #[test]
    fn the_clusters_of_the_spot_are_those_around_its_mesh() {
        let grid = grid_of_a_spot().unwrap();
        let sector = SphericalSector {
            apex: DVec3::new(0.0, 0.0, -9.0),
            axis: DVec3::NEG_Y,
            range: 2.0,
            half_angle: 0.4,
        };
        let clusters =
            clusters_of(&grid, &LightMesh::new(MeshKind::Spot), &MeshFrame::of_sector(&sector)).unwrap();
        let at =
            |point: DVec3| grid.cluster_of_local(point).map(|cell| clusters.contains(&grid.linear(cell)));
        assert_eq!(at(DVec3::new(0.0, -1.9, -9.0)), Some(true));
        assert_eq!(at(DVec3::new(0.5, -1.8, -9.3)), Some(true));
        assert_eq!(at(DVec3::new(0.0, 1.0, -9.0)), Some(false));
        assert_eq!(at(DVec3::new(0.0, -1.0, -12.0)), Some(false));
        assert!((20..150).contains(&clusters.len()), "{}", clusters.len());
    }

    /// A run of one frame whose EXR image says in which clusters its pixels are.
    fn rendered(directory: &Path, clusters: &[u32]) -> Run {
        let exr = directory.join("000003.exr");
        let channel = AnyChannel::new("cluster_index", FlatSamples::U32(clusters.to_vec()));
        let channels = AnyChannels::sort(std::iter::once(channel).collect());
        let (size, attributes) = ((clusters.len(), 1), LayerAttributes::named("mono"));
        let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels);
        Image::from_layer(layer).write().to_file(&exr).unwrap();
        let mut run = run("raster-24-12-64-e", 1, 400, |_, _| None);
        run.setting.recording = "aisle".into();
        run.setting.resolution = [1536, 768];
        run.setting.hashes[1] = recording::load("aisle").unwrap().sha256().to_owned();
        run.grid = Some([24, 12, 64]);
        let image = exr.with_extension("png");
        run.pictures = vec![Picture { frame: 3, image, ..Picture::default() }];
        run
    }

    #[test]
    fn clusters_are_told_of_frames_whose_recording_and_grid_are_known() {
        let directory = tempfile::tempdir().unwrap();
        let made = rendered(directory.path(), &[7, 300, 7, u32::MAX]);
        let (grid, clusters) = used(&made).unwrap().unwrap();
        assert_eq!((grid.dimensions, clusters), ([24, 12, 64], BTreeSet::from([7, 300])));
        let without = |change: fn(&mut Run)| {
            let mut run = rendered(directory.path(), &[7]);
            change(&mut run);
            used(&run).unwrap().is_none()
        };
        assert!(without(|run| run.setting.hashes[1] = "of another recording".into()));
        assert!(without(|run| run.setting.recording = "gone".into()));
        assert!(without(|run| run.grid = Some([24, 12, 32])));
        assert!(without(|run| run.pictures.clear()));
        assert!(without(|run| run.pictures[0].image.set_file_name("4.png")), "no EXR image beside it");
    }
}
