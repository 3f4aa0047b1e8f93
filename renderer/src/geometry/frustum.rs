//! The asymmetric frustum (Gelderen definition 4.1, appendix E).

use crate::{Error, Result};
use glam::{DMat4, DVec2, DVec3, DVec4};

/// A frustum by the signed tangents of its side planes and its signed near and far depths.
///
/// A view-space point p projects to (p.x/-p.z, p.y/-p.z); it is inside where that lies within x0..x1, y0..y1
/// and p.z within z0..z1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frustum {
    /// Tangent of the left side.
    pub x0: f64,
    /// Tangent of the right side.
    pub x1: f64,
    /// Tangent of the bottom side.
    pub y0: f64,
    /// Tangent of the top side.
    pub y1: f64,
    /// Z of the far plane: -far, metres, below z1.
    pub z0: f64,
    /// Z of the near plane: -near, metres, below 0.
    pub z1: f64,
}

impl Frustum {
    /// A symmetric frustum from a field of view along the LONGER axis of `resolution`, square pixels.
    ///
    /// `fov` in radians, `resolution` in pixels (width, height), `near` and `far` in metres, positive.
    ///
    /// # Errors
    /// A field of view outside 0..pi, a resolution of zero, and whatever [`Frustum::validate`] refuses.
    pub fn from_fov(fov: f64, resolution: [u32; 2], near: f64, far: f64) -> Result<Self> {
        if !(fov > 0.0 && fov < std::f64::consts::PI) {
            return Err(Error::input(format!("field of view {fov} rad must lie between 0 and pi")));
        }
        let [width, height] = resolution.map(f64::from);
        if width == 0.0 || height == 0.0 {
            return Err(Error::input(format!("resolution {width}x{height} must not be zero")));
        }
        let tangent = (fov / 2.0).tan();
        let longer = width.max(height);
        let (x, y) = (tangent * width / longer, tangent * height / longer);
        let frustum = Self { x0: -x, x1: x, y0: -y, y1: y, z0: -far, z1: -near };
        frustum.validate()?;
        Ok(frustum)
    }

    /// Checks that this is a frustum at all.
    ///
    /// # Errors
    /// A field that is no finite number, x0 >= x1, y0 >= y1, near >= far, near <= 0.
    pub fn validate(&self) -> Result<()> {
        let Self { x0, x1, y0, y1, z0, z1 } = *self;
        let (near, far) = (-z1, -z0);
        let fault = if [x0, x1, y0, y1, z0, z1].iter().any(|v| !v.is_finite()) {
            "every tangent and depth must be a finite number".to_owned()
        } else if x0 >= x1 {
            format!("left tangent {x0} must be below right tangent {x1}")
        } else if y0 >= y1 {
            format!("bottom tangent {y0} must be below top tangent {y1}")
        } else if near <= 0.0 {
            format!("near {near} must be above 0")
        } else if near >= far {
            format!("near {near} must be below far {far}")
        } else {
            return Ok(());
        };
        Err(Error::input(format!("frustum x {x0}..{x1}, y {y0}..{y1}, near {near}, far {far}: {fault}")))
    }

    /// Width and height in tangents, (dx, dy).
    pub fn size(&self) -> DVec2 {
        DVec2::new(self.x1 - self.x0, self.y1 - self.y0)
    }

    /// Distance of the near plane, metres, positive.
    pub fn near(&self) -> f64 {
        -self.z1
    }

    /// Distance of the far plane, metres, positive.
    pub fn far(&self) -> f64 {
        -self.z0
    }

    /// Volume in cubic metres (Gelderen equation 4.2).
    pub fn volume(&self) -> f64 {
        let DVec2 { x: dx, y: dy } = self.size();
        dx * dy * (self.z1.powi(3) - self.z0.powi(3)) / 3.0
    }

    /// Near corners in view space: left before right, then bottom before top.
    pub fn near_corners(&self) -> [DVec3; 4] {
        self.corners_at(self.z1)
    }

    /// Far corners in view space, in the order of [`Frustum::near_corners`].
    pub fn far_corners(&self) -> [DVec3; 4] {
        self.corners_at(self.z0)
    }

    /// Near corners, then far corners.
    pub fn corners(&self) -> [DVec3; 8] {
        let (near, far) = (self.near_corners(), self.far_corners());
        std::array::from_fn(|i| if i < 4 { near[i] } else { far[i - 4] })
    }

    fn corners_at(&self, z: f64) -> [DVec3; 4] {
        let Self { x0, x1, y0, y1, .. } = *self;
        [(x0, y0), (x1, y0), (x0, y1), (x1, y1)].map(|(x, y)| DVec3::new(-z * x, -z * y, z))
    }

    /// Whether the view-space point lies inside, faces included.
    pub fn contains(&self, p: DVec3) -> bool {
        let (x, y) = (p.x / -p.z, p.y / -p.z);
        (self.z0..=self.z1).contains(&p.z)
            && (self.x0..=self.x1).contains(&x)
            && (self.y0..=self.y1).contains(&y)
    }

    /// Clip from view: reversed depth (near 1, far 0) in Vulkan's clip space, +Y up (the viewport flips it).
    pub fn clip_from_view(&self) -> DMat4 {
        let Self { x0, x1, y0, y1, .. } = *self;
        let DVec2 { x: dx, y: dy } = self.size();
        let (near, far) = (self.near(), self.far());
        let depth = near / (far - near);
        DMat4::from_cols(
            DVec4::new(2.0 / dx, 0.0, 0.0, 0.0),
            DVec4::new(0.0, 2.0 / dy, 0.0, 0.0),
            DVec4::new((x0 + x1) / dx, (y0 + y1) / dy, depth, -1.0),
            DVec4::new(0.0, 0.0, depth * far, 0.0),
        )
    }

    /// The view-space point seen at a window position with a depth from the depth buffer.
    ///
    /// `window` is (0, 0) at the top left of the image, (1, 1) at its bottom right; `depth` is reversed, as
    /// [`Frustum::clip_from_view`] writes it.
    pub fn unproject(&self, window: DVec2, depth: f64) -> DVec3 {
        let (near, far) = (self.near(), self.far());
        let a = near / (far - near);
        let distance = a * far / (depth + a);
        let DVec2 { x: dx, y: dy } = self.size();
        DVec3::new(self.x0 + dx * window.x, self.y1 - dy * window.y, -1.0) * distance
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EYE: Frustum = Frustum { x0: -1.2, x1: 0.9, y0: -0.7, y1: 1.1, z0: -80.0, z1: -0.3 };

    #[test]
    fn the_field_of_view_spans_the_longer_axis() {
        let fov = std::f64::consts::FRAC_PI_2;
        let wide = Frustum::from_fov(fov, [1280, 720], 0.4, 100.0).unwrap();
        assert!((wide.x1 - 1.0).abs() < 1e-12 && (wide.y1 - 0.5625).abs() < 1e-12);
        let tall = Frustum::from_fov(fov, [720, 1280], 0.4, 100.0).unwrap();
        assert!((tall.x1 - 0.5625).abs() < 1e-12 && (tall.y1 - 1.0).abs() < 1e-12);
        assert_eq!((wide.near(), wide.far()), (0.4, 100.0));
    }

    #[test]
    fn what_is_no_frustum_is_refused() {
        assert!(EYE.validate().is_ok());
        for (broken, word) in [
            (Frustum { x1: f64::NAN, ..EYE }, "finite"),
            (Frustum { z0: f64::NEG_INFINITY, ..EYE }, "finite"),
            (Frustum { x1: EYE.x0, ..EYE }, "left"),
            (Frustum { y1: -2.0, ..EYE }, "bottom"),
            (Frustum { z1: 0.0, ..EYE }, "above 0"),
            (Frustum { z1: 1.0, ..EYE }, "above 0"),
            (Frustum { z0: EYE.z1, ..EYE }, "below far"),
        ] {
            let message = broken.validate().unwrap_err().to_string();
            assert!(message.contains(word), "{message}");
        }
        for (fov, resolution, near, far) in [
            (0.0, [4, 4], 0.4, 100.0),
            (4.0, [4, 4], 0.4, 100.0),
            (f64::NAN, [4, 4], 0.4, 100.0),
            (1.0, [0, 4], 0.4, 100.0),
            (1.0, [4, 4], 100.0, 0.4),
        ] {
            assert!(Frustum::from_fov(fov, resolution, near, far).is_err());
        }
    }

    #[test]
    fn corners_lie_on_the_frustum_and_points_beyond_do_not() {
        let middle = DVec3::new(-5.0, 5.0, -40.0);
        for corner in EYE.corners() {
            assert!(EYE.contains(corner.lerp(middle, 1e-9)));
            assert!(!EYE.contains(corner.lerp(middle, -1e-9)));
        }
        assert!(!EYE.contains(DVec3::new(0.0, 0.0, 1.0)));
        assert!(!EYE.contains(DVec3::ZERO));
    }

    #[test]
    fn the_volume_equals_that_of_the_two_pyramids() {
        let pyramid = |z: f64| EYE.size().x * EYE.size().y * z.powi(3) / 3.0;
        assert!((EYE.volume() / (pyramid(80.0) - pyramid(0.3)) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn clip_space_is_reversed_and_unprojection_undoes_it() {
        let clip = EYE.clip_from_view();
        for (corner, [x, y, z]) in EYE.corners().into_iter().zip([
            [-1.0, -1.0, 1.0],
            [1.0, -1.0, 1.0],
            [-1.0, 1.0, 1.0],
            [1.0, 1.0, 1.0],
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [-1.0, 1.0, 0.0],
            [1.0, 1.0, 0.0],
        ]) {
            let ndc = clip.project_point3(corner);
            assert!((ndc - DVec3::new(x, y, z)).length() < 1e-9, "{ndc}");
            let window = DVec2::new((ndc.x + 1.0) / 2.0, (1.0 - ndc.y) / 2.0);
            assert!((EYE.unproject(window, ndc.z) - corner).length() < 1e-9 * corner.length());
        }
    }
}
