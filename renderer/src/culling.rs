//! What views may see: boxes around instances against the planes of frusta. Pure: no Vulkan.

use crate::geometry::OrientedBox;
use crate::geometry::views::View;
use crate::scene::{Bounds, Instance};
use clap::ValueEnum;
use glam::{DVec3, DVec4};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where instances outside the views are left out; what is seen is the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Culling {
    /// On the host, which records a draw for each run of instances seen.
    Cpu,
    /// On the device, which fills the draw commands that the host records.
    Gpu,
}

/// World-space box around an instance, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorldBox {
    /// Middle of the box, world space, metres.
    pub center: DVec3,
    /// Half the size of the box, metres.
    pub half_extent: DVec3,
}

impl WorldBox {
    /// Around an instance of a primitive with object-space `bounds`.
    pub fn new(instance: &Instance, bounds: &Bounds) -> Self {
        let matrix = instance.world_from_object;
        let (min, max) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let half = (max - min) * 0.5;
        let half_extent = matrix.x_axis.truncate().abs() * half.x
            + matrix.y_axis.truncate().abs() * half.y
            + matrix.z_axis.truncate().abs() * half.z;
        Self { center: matrix.transform_point3((min + max) * 0.5), half_extent }
    }

    /// No point of it is farther than this from `origin`, metres.
    pub fn reach(&self, origin: DVec3) -> f64 {
        self.center.distance(origin) + self.half_extent.length()
    }
}

impl OrientedBox {
    /// Around an instance of a primitive with object-space `bounds`; where the instance's matrix shears, along the world's axes,
    /// and true.
    pub fn around(instance: &Instance, bounds: &Bounds) -> (Self, bool) {
        let corners = [bounds.min.as_dvec3(), bounds.max.as_dvec3()];
        match Self::of(&instance.world_from_object, corners) {
            Some(found) => (found, false),
            None => {
                let WorldBox { center, half_extent } = WorldBox::new(instance, bounds);
                (Self::along_axes(center, half_extent), true)
            }
        }
    }
}

/// The six planes of a view in world space: (inward unit normal, offset); a point p is inside where n.p + o >= 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewPlanes([DVec4; 6]);

/// Rounding of a plane's test in f32, relative to the distances in it: each is rounded at most six times by 2^-24 of
/// itself, which comes to 3.6e-7.
const ROUNDING: f64 = 2e-6;

impl ViewPlanes {
    /// The planes of `view`.
    pub fn new(view: &View) -> Self {
        let f = &view.frustum;
        let local = [
            (DVec3::new(1.0, 0.0, f.x0), 0.0),
            (DVec3::new(-1.0, 0.0, -f.x1), 0.0),
            (DVec3::new(0.0, 1.0, f.y0), 0.0),
            (DVec3::new(0.0, -1.0, -f.y1), 0.0),
            (DVec3::new(0.0, 0.0, -1.0), f.z1),
            (DVec3::new(0.0, 0.0, 1.0), -f.z0),
        ];
        Self(local.map(|(normal, offset)| {
            let world = view.pose.transform_vector(normal.normalize());
            world.extend(offset - world.dot(view.eye()))
        }))
    }

    /// How far a box reaches inside the plane that it reaches inside least, metres; below zero where it lies wholly
    /// outside one.
    pub fn depth(&self, bounds: &WorldBox) -> f64 {
        let depth = |plane: &DVec4| {
            let normal = plane.truncate();
            normal.dot(bounds.center) + plane.w + normal.abs().dot(bounds.half_extent)
        };
        self.0.iter().map(depth).fold(f64::INFINITY, f64::min)
    }

    /// False only where the box lies wholly outside a plane.
    pub fn may_see(&self, bounds: &WorldBox) -> bool {
        self.depth(bounds) >= 0.0
    }

    /// The planes in f32, moved out so far that rounding there never loses a box within `reach` metres of the world's
    /// origin that [`Self::may_see`] lets through.
    pub fn for_device(&self, reach: f64) -> [[f32; 4]; 6] {
        self.0.map(|plane| {
            let slack = ROUNDING * (reach + plane.w.abs());
            plane.truncate().extend(plane.w + slack).as_vec4().to_array()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Frustum;
    use crate::geometry::views::{Mirror, Pose};
    use glam::DQuat;

    fn view() -> View {
        let frustum = Frustum { x0: -1.0, x1: 0.5, y0: -0.8, y1: 0.6, z0: -50.0, z1: -0.5 };
        let pose = Pose {
            position: DVec3::new(30.0, 2.0, -80.0),
            rotation: DQuat::from_rotation_y(0.9),
            mirror: None,
        };
        View { pose, frustum }
    }

    /// A cube of half a metre at a place in view space.
    fn cube(local: DVec3) -> WorldBox {
        WorldBox { center: view().pose.transform_point(local), half_extent: DVec3::splat(0.25) }
    }

    #[test]
    fn boxes_beyond_any_plane_are_not_seen() {
        let planes = ViewPlanes::new(&view());
        assert!(planes.may_see(&cube(DVec3::new(0.0, 0.0, -10.0))));
        let outside = [(-12.0, 0.0, -10.0), (7.0, 0.0, -10.0), (0.0, -10.0, -10.0), (0.0, 8.0, -10.0)];
        for place in outside.into_iter().chain([(0.0, 0.0, 1.0), (0.0, 0.0, -51.0)]) {
            assert!(!planes.may_see(&cube(place.into())), "{place:?}");
        }
    }

    #[test]
    fn a_mirror_shows_the_boxes_whose_images_are_seen() {
        let mirror = Mirror { normal: DVec3::new(0.0, 0.6, 0.8), offset: -70.0 };
        let planes = ViewPlanes::new(&View { pose: Pose { mirror: Some(mirror), ..view().pose }, ..view() });
        for place in [(0.0, 0.0, -10.0), (0.0, 0.0, 1.0), (3.0, -2.0, -30.0), (7.0, 0.0, -10.0)] {
            let direct = cube(place.into());
            // A cube of no size: its image is one too.
            let direct = WorldBox { half_extent: DVec3::ZERO, ..direct };
            let image = WorldBox { center: mirror.reflect_point(direct.center), ..direct };
            let depths = (planes.depth(&image), ViewPlanes::new(&view()).depth(&direct));
            assert!((depths.0 - depths.1).abs() < 1e-9, "{depths:?}");
        }
    }

    #[test]
    fn depth_is_in_metres() {
        let planes = ViewPlanes::new(&view());
        let ahead = planes.depth(&WorldBox { half_extent: DVec3::ZERO, ..cube(DVec3::new(0.0, 0.0, -49.0)) });
        assert!((ahead - 1.0).abs() < 1e-9, "{ahead} m before the far plane");
    }

    #[test]
    fn rounding_on_the_device_loses_no_box() {
        let planes = ViewPlanes::new(&view());
        let mut close = 0;
        for step in 0..20_000 {
            let at = DVec3::new(-10.5 + 1e-5 * f64::from(step), 0.1, -10.0);
            let bounds = cube(at);
            let [center, half] = [bounds.center, bounds.half_extent].map(|v| v.as_vec3());
            let device = planes.for_device(bounds.reach(DVec3::ZERO)).into_iter().all(|[x, y, z, w]| {
                let normal = glam::Vec3::new(x, y, z);
                normal.dot(center) + w >= -normal.abs().dot(half)
            });
            assert!(device || !planes.may_see(&bounds), "lost at {at}");
            close += i32::from(device != planes.may_see(&bounds));
        }
        assert!((1..200).contains(&close), "{close} boxes are drawn for rounding's sake");
    }
}
