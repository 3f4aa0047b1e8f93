//! Pictures of a floor under lights that fade in different ways (A.2, A.3, A.4).

use crate::Result;
use crate::cpu::{LightLists, Surface, assign, attenuation, reflected};
use crate::geometry::views::{Pose, View};
use crate::geometry::{DisplacedVolume, Frustum, Grid, SphereTest};
use crate::lights::{Attenuation, Light};
use crate::methods::grid::plan;
use crate::methods::{Sharing, Space};
use crate::output::{cubehelix, tone_map};
use crate::report::chart::{Chart, Plot};
use crate::report::computed::picture;
use crate::report::figure::Figure;
use glam::{DQuat, DVec2, DVec3, Vec3};

/// Pixels.
const SIZE: [u32; 2] = [300, 180];
/// Pixels a cluster of A.3 takes.
const CLUSTER: f64 = 20.0;
/// Intensity I of the lights; R1 is 2 m at a cut-off of 1 and 4 m at 0.25.
const INTENSITY: f32 = 4.0;
/// Near radius R0 of the lights, metres.
const NEAR_RADIUS: f32 = 0.3;
/// As many lights of a cluster, or more, are white.
const MOST_LISTED: f64 = 4.0;
/// What the floor reflects of light from everywhere.
const AMBIENT: f64 = 0.004;

/// What lights a floor: a function with a cut-off I0, and which lights are asked.
#[derive(Clone, Copy)]
struct Falloff {
    function: Attenuation,
    cutoff: f32,
    by_clusters: bool,
}

impl Falloff {
    const fn new(function: Attenuation, cutoff: f32) -> Self {
        Self { function, cutoff, by_clusters: false }
    }
}

/// A.2, A.3 and A.4.
///
/// # Errors
/// A picture cannot be encoded.
pub fn figures() -> Result<Vec<Figure>> {
    let lin_and_stp = [
        ("lin, I₀ = 1", Falloff::new(Attenuation::Lin, 1.0)),
        ("stp, I₀ = 1", Falloff::new(Attenuation::Stp, 1.0)),
        ("stp, I₀ = 0.25", Falloff::new(Attenuation::Stp, 0.25)),
    ];
    let limited = [Attenuation::Red, Attenuation::Smo, Attenuation::PhyRed2];
    let names = limited.map(|function| format!("{function}, I₀ = 0.25"));
    let limited: [(&str, Falloff); 3] =
        std::array::from_fn(|i| (names[i].as_str(), Falloff::new(limited[i], 0.25)));
    let cut = Falloff { by_clusters: true, ..Falloff::new(Attenuation::Phy, 1.0) };
    let physical = [("phy, I₀ = 0", Falloff::new(Attenuation::Phy, 0.0)), ("phy, I₀ = 1, by clusters", cut)];
    let floor = Floor::new()?;
    let mut unlimited = floor.panels(&physical)?;
    unlimited.push(("lights of each cluster".to_owned(), floor.light_counts(cut)?));
    Ok(vec![
        figure(
            "A.2",
            "Linear and step attenuation",
            "Both serve illustration. The reach R₁ = √(I/I₀) shows at the floor's highlights most.",
            floor.panels(&lin_and_stp)?,
        ),
        figure(
            "A.3",
            "Physical attenuation and its end",
            "Without a cut-off, and with lights assigned to clusters by their reach R₁: as the attenuation does not end \
             there, where a cluster's list ends shows, and highlights far from their light are lost. On the right how \
             many lights each cluster lists.",
            unlimited,
        ),
        figure(
            "A.4",
            "Attenuation with limited reach",
            "The default, phy_red_2, keeps most of the brightness and shows no edge.",
            floor.panels(&limited)?,
        ),
    ])
}

fn figure(id: &str, title: &str, caption: &str, panels: Vec<(String, Plot)>) -> Figure {
    let (columns, panels) = panels.into_iter().map(|(name, plot)| (name, Some(plot))).unzip();
    let chart = Chart {
        names: ["", "function", "picture", "number"],
        columns,
        rows: vec![String::new()],
        panels,
        ..Chart::default()
    };
    Figure {
        id: id.into(),
        title: title.into(),
        caption: format!(
            "Computed, not measured: a glossy floor under seven lights of intensity I = {INTENSITY} with near radius \
             R₀ = {NEAR_RADIUS} m. {caption}"
        ),
        setting: String::new(),
        chart: Some(chart),
    }
}

/// A floor seen by a camera, with its clusters.
struct Floor {
    view: View,
    grid: Grid,
}

impl Floor {
    fn new() -> Result<Self> {
        let pose =
            Pose { rotation: DQuat::from_rotation_x(-0.5), ..Pose::from_position(DVec3::new(0.0, 4.0, 8.5)) };
        let view = View { pose, frustum: Frustum::from_fov(1.1, SIZE, 0.4, 60.0)? };
        let grids =
            plan(Space::Persp { pixels: CLUSTER }, Sharing::Indi, &[view], SIZE, DisplacedVolume::View)?;
        Ok(Self { view, grid: grids[0] })
    }

    fn panels(&self, falloffs: &[(&str, Falloff)]) -> Result<Vec<(String, Plot)>> {
        let panel = |&(name, falloff): &(&str, Falloff)| {
            let lights = lights(falloff.cutoff);
            let lists = falloff.by_clusters.then(|| self.lists(&lights));
            let alt = format!("A floor under lights that fade by {name}");
            let seen = |at| self.radiance(at, falloff.function, &lights, lists.as_ref());
            let plot = picture(SIZE, &alt, |at| shown(seen(at)))?;
            Ok((name.to_owned(), plot))
        };
        falloffs.iter().map(panel).collect()
    }

    /// The point of the floor that is seen at a place of the picture; `None` above the horizon.
    fn seen(&self, at: DVec2) -> Option<DVec3> {
        let eye = self.view.eye();
        let ray = self.view.pose.transform_vector(self.view.frustum.unproject(at, 1.0));
        let far = -eye.y / ray.y;
        (ray.y < 0.0 && far < 200.0).then(|| (eye + far * ray).with_y(0.0))
    }

    /// The lists of all clusters.
    fn lists(&self, lights: &[Light]) -> LightLists {
        let clusters: Vec<u32> = (0..self.grid.cluster_count() as u32).collect();
        assign(&self.grid, &clusters, lights, SphereTest::HALF_SPACES, 0.0)
    }

    /// The lights on the list of the cluster that holds a point.
    fn listed<'a>(&self, point: DVec3, lists: &'a LightLists) -> &'a [u32] {
        let cell = self.grid.nearest_cluster(self.grid.pose.inverse_transform_point(point));
        cell.map_or(&[], |cell| lists.list(self.grid.linear(cell) as usize))
    }

    /// What the camera sees; with `lists`, a light counts on all of each cluster that lists it.
    fn radiance(
        &self,
        at: DVec2,
        function: Attenuation,
        lights: &[Light],
        lists: Option<&LightLists>,
    ) -> DVec3 {
        let Some(point) = self.seen(at) else { return DVec3::ZERO };
        let tile = (point.x.floor() + point.z.floor()).rem_euclid(2.0);
        let surface = Surface {
            normal: DVec3::Y,
            to_viewer: (self.view.eye() - point).normalize(),
            diffuse: DVec3::splat(0.35 + 0.15 * tile),
            f0: DVec3::splat(0.04),
            alpha: 0.06,
        };
        let lit = |light: &Light| {
            let away = position(light) - point;
            let tint = Vec3::from(light.tint).as_dvec3();
            reflected(&surface, away.normalize()) * tint * attenuation(function, light, away.length())
        };
        let endless = |&light: &u32| Light { r1: f32::INFINITY, ..lights[light as usize] };
        let sum: DVec3 = match lists {
            Some(lists) => self.listed(point, lists).iter().map(endless).map(|light| lit(&light)).sum(),
            None => lights.iter().map(lit).sum(),
        };
        AMBIENT * surface.diffuse + sum
    }

    fn light_counts(&self, falloff: Falloff) -> Result<Plot> {
        let lists = self.lists(&lights(falloff.cutoff));
        picture(SIZE, "How many lights the clusters of the floor list", |at| {
            self.seen(at).map_or(DVec3::ZERO, |point| {
                let part = self.listed(point, &lists).len() as f64 / MOST_LISTED;
                display(cubehelix(0.1 + 0.9 * part.min(1.0)))
            })
        })
    }
}

/// Seven lights over the floor.
fn lights(cutoff: f32) -> [Light; 7] {
    std::array::from_fn(|i| {
        let (x, row) = ((i % 4) as f32 * 3.0 + if i < 4 { -4.5 } else { -3.0 }, i / 4);
        let tint = [[1.0, 0.85, 0.7], [0.7, 0.85, 1.0], [1.0, 0.7, 0.8]][i % 3];
        Light::new([x, 0.8, -3.0 * row as f32 + 1.5], tint, INTENSITY, cutoff, NEAR_RADIUS)
    })
}

fn position(light: &Light) -> DVec3 {
    Vec3::from(light.position).as_dvec3()
}

/// As a display shows it, 0 to 1.
fn shown(radiance: DVec3) -> DVec3 {
    display(tone_map(radiance.as_vec3().to_array()))
}

fn display(bytes: [u8; 3]) -> DVec3 {
    DVec3::from_array(bytes.map(|byte| f64::from(byte) / 255.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(floor: &Floor, falloff: Falloff) -> f64 {
        let lights = lights(falloff.cutoff);
        let places =
            (0..40 * 40).map(|i| DVec2::new(f64::from(i % 40) + 0.5, f64::from(i / 40) + 0.5) / 40.0);
        let lists = falloff.by_clusters.then(|| floor.lists(&lights));
        let radiance = |at| floor.radiance(at, falloff.function, &lights, lists.as_ref());
        places.map(|at| radiance(at).element_sum()).sum::<f64>() / 1600.0
    }

    #[test]
    fn all_limits_take_brightness_and_the_default_takes_least() {
        let floor = Floor::new().unwrap();
        let of = |function| mean(&floor, Falloff::new(function, 0.25));
        let full = mean(&floor, Falloff::new(Attenuation::Phy, 0.0));
        let (red, smo, default) = (of(Attenuation::Red), of(Attenuation::Smo), of(Attenuation::PhyRed2));
        assert!(smo < red && red < default && default < full, "{smo} {red} {default} {full}");
    }

    #[test]
    fn a_lower_cutoff_reaches_farther_and_lists_end_where_clusters_do() {
        let floor = Floor::new().unwrap();
        let step = |cutoff| mean(&floor, Falloff::new(Attenuation::Stp, cutoff));
        assert!(step(0.25) > 2.0 * step(1.0));
        let full = Falloff::new(Attenuation::Phy, 0.0);
        let cut = Falloff { by_clusters: true, ..Falloff::new(Attenuation::Phy, 1.0) };
        let lists = floor.lists(&lights(1.0));
        let places: Vec<DVec2> = (0..90).map(|i| DVec2::new(0.5, f64::from(i) / 90.0)).collect();
        let whole = |at: &&DVec2| {
            let point = floor.seen(**at);
            point.is_some_and(|point| floor.listed(point, &lists).len() == 7)
        };
        assert!(places.iter().filter(whole).count() < places.len());
        assert!(mean(&floor, cut) < 0.95 * mean(&floor, full));
        // Beyond R1 a light that is listed still counts.
        let beyond = Falloff { by_clusters: false, ..cut };
        assert!(mean(&floor, cut) > mean(&floor, beyond));
    }
}
