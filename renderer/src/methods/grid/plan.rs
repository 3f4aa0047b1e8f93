//! From a method and the views of a frame to its clustering grids.

use super::{GridMethod, Space};
use crate::geometry::views::{Pose, View, common_mirror, head_space};
use crate::geometry::{
    ClusterSpace, DisplacedVolume, Frustum, Grid, PerspectiveDimensions, SliceLaw, Slices, average_volume,
    counted, counted_tiles, displaced, enclosing, from_metres, from_pixels, from_volume, sliced_tiles,
};
use crate::methods::{Method, Sharing};
use crate::{Error, Result};
use glam::DVec3;

/// Sizes above this (pixels or metres) are no use to anybody and would spoil the precision of what follows.
const LARGEST_SIZE: f64 = 1e6;

/// Slices up to so many, and thicker than this part of their depth, are told apart in single precision (see
/// `slice_of` in cluster_space.glsl).
const MOST_SLICES: f64 = 1e5;
const THINNEST_SLICE: f64 = 1e-5;

/// How grids are divided, beyond what a method's name says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Division {
    /// Which frustum sizes the clusters of [`Space::Displ`]; with [`Sharing::Encl`], volumes are averaged over the views, each
    /// by itself.
    pub volume: DisplacedVolume,
    /// Where slices begin, where there are several.
    pub slices: SliceLaw,
}

impl From<DisplacedVolume> for Division {
    /// With geometric slices.
    fn from(volume: DisplacedVolume) -> Self {
        Self { volume, slices: SliceLaw::Geometric }
    }
}

/// Plans the clusterings of a frame as [`GridMethod::plan`] does, for visible clusters and with implicit bounds.
///
/// # Errors
/// As there.
pub fn plan(
    space: Space,
    sharing: Sharing,
    views: &[View],
    resolution: [u32; 2],
    division: impl Into<Division>,
) -> Result<Vec<Grid>> {
    GridMethod::new(sharing, space).plan(views, resolution, division.into())
}

impl GridMethod {
    /// Plans the clusterings of a frame: one grid a view for [`Sharing::Indi`], in the order of the views, one grid in all for
    /// [`Sharing::Encl`]. `resolution` is that of each view in pixels (width, height).
    ///
    /// # Errors
    /// No views, an invalid view, a zero resolution, a size or displacement that is not a positive number, views that no
    /// frustum encloses, slices that their law cannot make, and a grid of more clusters than a u32 can index.
    pub fn plan(&self, views: &[View], resolution: [u32; 2], division: Division) -> Result<Vec<Grid>> {
        let planner = Planner { name: Method::Grid(*self), space: self.space, resolution, division };
        planner.check(views)?;
        match self.sharing {
            Sharing::Indi => views.iter().map(|view| planner.individual(view)).collect(),
            Sharing::Encl => Ok(vec![planner.enclosing(views)?]),
        }
    }
}

struct Planner {
    name: Method,
    space: Space,
    resolution: [u32; 2],
    division: Division,
}

impl Planner {
    fn check(&self, views: &[View]) -> Result<()> {
        if let Some(size) =
            self.space.sizes().into_iter().find(|size| !(*size > 0.0 && *size <= LARGEST_SIZE))
        {
            let message = format!("a size of {size} is not above 0 and at most {LARGEST_SIZE}");
            return Err(self.error(&message));
        }
        if views.is_empty() {
            return Err(self.error("there is no view to cluster"));
        }
        let [width, height] = self.resolution;
        if width == 0 || height == 0 {
            return Err(self.error(&format!("resolution {width}x{height} must not be zero")));
        }
        views.iter().enumerate().try_for_each(|(index, view)| {
            view.validate().map_err(|error| self.error(&format!("view {index}: {error}")))
        })
    }

    fn individual(&self, view: &View) -> Result<Grid> {
        let frustum = &view.frustum;
        match self.space {
            Space::Persp { pixels } => {
                let counts = from_pixels(frustum, self.resolution, pixels);
                self.perspective(view.pose, self.grown(frustum, pixels, &counts), counts)
            }
            Space::Tiled { pixels } => self.sliced(view, pixels, 1.0),
            Space::Sliced { pixels, slices } => self.sliced(view, pixels, slices),
            Space::Counted { columns, rows, slices } => self.counted(view, DVec3::new(columns, rows, slices)),
            Space::Ortho { metres } => self.orthographic(view.pose, std::slice::from_ref(view), metres),
            Space::Displ { pixels, displacement } => {
                let volume = self.displaced_cluster_volume(frustum, pixels, displacement);
                self.displaced(view.pose, frustum, displacement, volume)
            }
        }
    }

    fn sliced(&self, view: &View, pixels: f64, slices: f64) -> Result<Grid> {
        let counts = sliced_tiles(&view.frustum, self.resolution, pixels, slices);
        self.perspective(view.pose, self.grown(&view.frustum, pixels, &counts), counts)
    }

    fn counted(&self, view: &View, counts: DVec3) -> Result<Grid> {
        let (pixels, counts) = counted_tiles(&view.frustum, self.resolution, counts);
        self.perspective(view.pose, self.grown(&view.frustum, pixels, &counts), counts)
    }

    fn enclosing(&self, views: &[View]) -> Result<Grid> {
        let head = head_space(views);
        let mean = |volume: &dyn Fn(&Frustum) -> f64| {
            views.iter().map(|view| volume(&view.frustum)).sum::<f64>() / views.len() as f64
        };
        match self.space {
            Space::Persp { pixels } => {
                let volume = mean(&|frustum| self.cluster_volume(frustum, pixels));
                let (pose, frustum) = self.enclosing_frustum(&head, views)?;
                self.perspective(pose, frustum, from_volume(&frustum, volume))
            }
            Space::Counted { columns, rows, slices } => {
                let (pose, frustum) = self.enclosing_frustum(&head, views)?;
                self.perspective(pose, frustum, counted(&frustum, DVec3::new(columns, rows, slices)))
            }
            Space::Tiled { .. } | Space::Sliced { .. } => {
                Err(self.error("tiles divide the screen of one view and are not shared"))
            }
            Space::Ortho { metres } => self.orthographic(head, views, metres),
            Space::Displ { pixels, displacement } => {
                let volume = mean(&|frustum| self.displaced_cluster_volume(frustum, pixels, displacement));
                let (pose, frustum) = self.enclosing_frustum(&head, views)?;
                self.displaced(pose, &frustum, displacement, volume)
            }
        }
    }

    fn enclosing_frustum(&self, head: &Pose, views: &[View]) -> Result<(Pose, Frustum)> {
        if common_mirror(views).is_none() {
            return Err(self.error(
                "not all views see the world in the same mirror, and no frustum encloses both sides of one; use an \
                 Ortho method (such as encl-ortho-4), which needs none, or Indi",
            ));
        }
        let found = enclosing(head, views).map_err(|error| self.error(&error.to_string()))?;
        Ok((*head * Pose::from_position(DVec3::Z * found.apex), found.frustum))
    }

    /// Average volume of a cluster of Persp on `frustum`.
    fn cluster_volume(&self, frustum: &Frustum, pixels: f64) -> f64 {
        average_volume(frustum, &from_pixels(frustum, self.resolution, pixels))
    }

    /// The cluster volume that Displ aims at.
    fn displaced_cluster_volume(&self, frustum: &Frustum, pixels: f64, displacement: f64) -> f64 {
        let counts = from_pixels(frustum, self.resolution, pixels);
        match self.division.volume {
            DisplacedVolume::View => average_volume(frustum, &counts),
            DisplacedVolume::Own => average_volume(&displaced(frustum, displacement).1, &counts),
        }
    }

    /// Clusters tile the screen from its lower left pixel in steps of exactly `pixels`, so that the last
    /// column and row reach beyond its right and upper side.
    fn grown(&self, frustum: &Frustum, pixels: f64, counts: &PerspectiveDimensions) -> Frustum {
        let size = frustum.size();
        let screens = |axis: usize| counts.dimensions[axis] * pixels / f64::from(self.resolution[axis]);
        Frustum { x1: frustum.x0 + size.x * screens(0), y1: frustum.y0 + size.y * screens(1), ..*frustum }
    }

    fn displaced(&self, pose: Pose, frustum: &Frustum, displacement: f64, volume: f64) -> Result<Grid> {
        let (apex, seen) = displaced(frustum, displacement);
        self.perspective(pose * Pose::from_position(apex), seen, from_volume(&seen, volume))
    }

    fn perspective(&self, pose: Pose, frustum: Frustum, counts: PerspectiveDimensions) -> Result<Grid> {
        let law = if self.space.has_slices() { self.division.slices } else { SliceLaw::Geometric };
        self.check_law(law, &frustum, counts.dimensions.z)?;
        let (slices, dimensions) = counts.by_law(law, &frustum);
        let (count, thinnest) = (dimensions.z, slices.thinnest(dimensions.z));
        let least = self.thinnest_slice(&slices);
        if count > MOST_SLICES || (count > 1.0 && thinnest < least) {
            return Err(self.error(&format!(
                "{count} slices, from {thinnest:.1e} of their depth thick, are more than {MOST_SLICES} or thinner than \
                 {least:.1e}, which single precision does not tell apart; choose a larger size"
            )));
        }
        self.grid(pose, ClusterSpace::Perspective { frustum, slices }, dimensions)
    }

    /// How thin slices are told apart, in parts of their depth: where a bias is added, what is added rounds too.
    fn thinnest_slice(&self, slices: &Slices) -> f64 {
        let added = if self.space.adds_bias() { slices.bias() * slices.on_device()[1] } else { 0.0 };
        THINNEST_SLICE * (1.0 + added.abs())
    }

    /// A second plane needs a slice behind it.
    fn check_law(&self, law: SliceLaw, frustum: &Frustum, count: f64) -> Result<()> {
        match law {
            SliceLaw::SecondPlane { metres } if metres >= frustum.far() || count < 2.0 => {
                let far = frustum.far();
                Err(self.error(&format!(
                    "slices {law}: of {count} slices up to {far} m the first cannot end at {metres} m; there must be at \
                     least 2, and the plane before the far one"
                )))
            }
            _ => Ok(()),
        }
    }

    /// Bounds, in `space`, of all corners of all views.
    fn orthographic(&self, space: Pose, views: &[View], metres: f64) -> Result<Grid> {
        let corners = views.iter().flat_map(|view| {
            let space_from_view = space.inverse() * view.pose;
            view.frustum.corners().map(|corner| space_from_view.transform_point(corner))
        });
        let (min, max) = corners.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), corner| {
            (min.min(corner), max.max(corner))
        });
        self.grid(space, ClusterSpace::Orthographic { min, max }, from_metres(max - min, metres))
    }

    /// The grid, once its clusters are known to fit the indices.
    fn grid(&self, pose: Pose, space: ClusterSpace, dimensions: DVec3) -> Result<Grid> {
        let count = dimensions.element_product();
        // The index u32::MAX stays free to mean 'none'.
        if !(1.0..=f64::from(u32::MAX)).contains(&count) {
            let DVec3 { x, y, z } = dimensions;
            return Err(self.error(&format!(
                "a grid of {x} x {y} x {z} clusters is more than {}; choose a larger size",
                u32::MAX
            )));
        }
        Ok(Grid { pose, space, dimensions: dimensions.to_array().map(|n| n as u32) })
    }

    fn error(&self, message: &str) -> Error {
        Error::input(format!("method {}: {message}", self.name))
    }
}
