//! How a surface reflects light (Cook-Torrance, as `lib/brdf.glsl`).

use glam::DVec3;
use std::f64::consts::PI;

/// A dielectric or metal at one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Unit normal, on the viewer's side.
    pub normal: DVec3,
    /// Unit vector from the surface to the viewer.
    pub to_viewer: DVec3,
    /// Base colour of the dielectric part.
    pub diffuse: DVec3,
    /// Reflectance at normal incidence.
    pub f0: DVec3,
    /// Squared perceptual roughness of the surface.
    pub alpha: f64,
}

/// Outgoing radiance per incident irradiance times the cosine of its angle, for unit `to_light`.
pub fn reflected(surface: &Surface, to_light: DVec3) -> DVec3 {
    let Surface { normal, to_viewer, diffuse, f0, alpha } = *surface;
    let n_l = normal.dot(to_light);
    if n_l <= 0.0 {
        return DVec3::ZERO;
    }
    let halfway = (to_viewer + to_light).normalize();
    let n_v = normal.dot(to_viewer).max(1e-4);
    let n_h = normal.dot(halfway).clamp(0.0, 1.0);
    let v_h = to_viewer.dot(halfway).clamp(0.0, 1.0);
    let denominator = n_h * n_h * (alpha * alpha - 1.0) + 1.0;
    let distribution = alpha * alpha / (PI * denominator * denominator);
    let k = 0.5 * alpha;
    let visibility = 0.25 / ((n_v * (1.0 - k) + k) * (n_l * (1.0 - k) + k));
    let fresnel = f0 + (1.0 - f0) * (1.0 - v_h).powi(5);
    ((1.0 - fresnel) * diffuse / PI + distribution * visibility * fresnel) * n_l
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(to_viewer: DVec3, alpha: f64) -> Surface {
        let (diffuse, f0) = (DVec3::splat(0.5), DVec3::splat(0.04));
        Surface { normal: DVec3::Y, to_viewer, diffuse, f0, alpha }
    }

    #[test]
    fn light_from_below_is_not_reflected_and_a_mirror_direction_is_most() {
        let to_viewer = DVec3::new(1.0, 1.0, 0.0).normalize();
        let from = |x: f64, y: f64| reflected(&surface(to_viewer, 0.1), DVec3::new(x, y, 0.0).normalize()).x;
        assert_eq!(from(-1.0, -0.5), 0.0);
        assert!(from(-1.0, 1.0) > 2.0 * from(-1.0, 2.0) && from(-1.0, 1.0) > 2.0 * from(-2.0, 1.0));
    }

    #[test]
    fn no_more_is_reflected_than_arrives() {
        for alpha in [0.05, 0.3, 1.0] {
            let to_viewer = DVec3::new(0.6, 0.8, 0.0);
            let steps = 200;
            let mut sum = 0.0;
            for i in 0..steps {
                for j in 0..steps {
                    let (u, v) =
                        ((f64::from(i) + 0.5) / f64::from(steps), (f64::from(j) + 0.5) / f64::from(steps));
                    let (sin, cos) = ((1.0 - u * u).sqrt(), u);
                    let (s, c) = (2.0 * PI * v).sin_cos();
                    sum += reflected(&surface(to_viewer, alpha), DVec3::new(sin * c, cos, sin * s)).x;
                }
            }
            let total = 2.0 * PI * sum / f64::from(steps * steps);
            assert!((0.3..1.0).contains(&total), "{total} of 1 at {alpha}");
        }
    }
}
