//! The figures of the thesis (Gelderen chapters 4 and 6, appendices A and C), each from whatever data there are.

mod attenuation;
mod birdseye;
mod breakdown;
mod distribution;
mod enclosing;
mod falloff;
mod over_time;

use super::is_sun_temple;
use crate::Result;
use crate::methods::{Method, Space};
use crate::report::chart::{Chart, palette::Color};
use crate::report::figure::{Drawn, Figure, Wanted, figures};
use crate::report::pictures;
use crate::report::results::{ResultSet, Setting};
use over_time::Sweep;

/// Every figure in the order of the thesis.
///
/// # Errors
/// A picture cannot be read.
pub fn all(set: &ResultSet) -> Result<Vec<Figure>> {
    let street = Scene { set, sun_temple: false };
    let temple = Scene { set, sun_temple: true };
    let mut figures = vec![enclosing::figure()?];
    figures.extend(street.clusters("4.8", &[300, 580])?);
    figures.extend(street.pictures("6.1", "Frames of the replay", &[300, 580])?);
    figures.extend(street.sweeps(&[(Sweep::Persp, "6.2"), (Sweep::Ortho, "6.3"), (Sweep::Displ, "6.4")]));
    figures.extend(street.comparisons(["6.5", "6.6", "6.7", "6.8", "6.9", "6.10"]));
    figures.push(attenuation::figure());
    figures.extend(falloff::figures()?);
    figures.extend(temple.pictures("C.1", "A frame of the Sun Temple replay", &[250])?);
    figures.extend(temple.pictures("C.2", "A later frame of the Sun Temple replay", &[680])?);
    figures.extend(temple.sweeps(&[(Sweep::Ortho, "C.3"), (Sweep::Persp, "C.4")]));
    // The thesis prints no more of this scene; what was measured beyond is drawn like its counterparts.
    let mut further = temple.clusters("C-4.8", &[250, 680])?;
    further.extend(temple.sweeps(&[(Sweep::Displ, "C-6.4")]));
    further.extend(temple.comparisons(["C-6.5", "C-6.6", "C-6.7", "C-6.8", "C-6.9", "C-6.10"]));
    figures.extend(further.into_iter().filter(|figure| figure.chart.is_some()));
    Ok(figures)
}

/// The runs of the thesis's first or second scene, and of those that stand in for it.
struct Scene<'a> {
    set: &'a ResultSet,
    sun_temple: bool,
}

impl<'a> Scene<'a> {
    fn settings(&self, stereo: bool) -> Vec<&'a Setting> {
        self.own(self.set.settings(), stereo)
    }

    fn own(&self, settings: Vec<&'a Setting>, stereo: bool) -> Vec<&'a Setting> {
        let belongs =
            |setting: &&Setting| is_sun_temple(setting) == self.sun_temple && setting.is_stereo() == stereo;
        settings.into_iter().filter(belongs).collect()
    }

    fn clusters(&self, id: &str, frames: &[u32]) -> Result<Vec<Figure>> {
        let mut drawn = vec![];
        for setting in [false, true].into_iter().flat_map(|stereo| self.own(self.set.settings_once(), stereo))
        {
            if let Some(chart) = birdseye::clusters(self.set, setting, frames)? {
                drawn.push(Drawn { setting, chart, remark: String::new() });
            }
        }
        Ok(figures(&CLUSTERS.at(id), drawn))
    }

    /// One figure a mono setting that has data for it; of stereo settings where none has.
    fn mono_first(&self, wanted: &Wanted<'_>, draw: impl Fn(&'a Setting) -> Option<Chart>) -> Vec<Figure> {
        let from = |stereo: bool, remark: &str| -> Vec<Drawn<'a>> {
            let drawn = |setting| Some(Drawn { setting, chart: draw(setting)?, remark: remark.into() });
            self.settings(stereo).into_iter().filter_map(drawn).collect()
        };
        let mut drawn = from(false, "");
        if drawn.is_empty() {
            drawn = from(true, " There is no mono run: drawn from Indi in stereo, both views together.");
        }
        figures(wanted, drawn)
    }

    fn sweeps(&self, sweeps: &[(Sweep, &str)]) -> Vec<Figure> {
        let draw = |&(sweep, id): &(Sweep, &str)| {
            let name = sweep.name();
            let wanted = Wanted {
                id,
                title: &format!("{name} clustering by size"),
                caption: &format!(
                    "Profiling results of {name} over the frames of the replay, a line a size: {}. The heavier line \
                     is the size that the thesis judges best.",
                    sweep.sizes()
                ),
                missing: &format!("needs runs of Indi {name} in at least two sizes"),
            };
            self.mono_first(&wanted, |setting| over_time::sweep(self.set, setting, sweep))
        };
        sweeps.iter().flat_map(draw).collect()
    }

    fn comparisons(&self, [sharing, tuned, frame, clustering, lights, fragments]: [&str; 6]) -> Vec<Figure> {
        let needs_tuned = "needs runs of Indi Persp 64, Ortho 4 or Displ 64 32";
        let needs_timed = "needs temporal runs of Indi Persp 64, Ortho 4 or Displ 64 32";
        let stereo = self.settings(true).into_iter().filter_map(|setting| {
            Some(Drawn { setting, chart: over_time::sharing(self.set, setting)?, remark: String::new() })
        });
        let mut found = figures(&SHARING.at(sharing), stereo.collect());
        let tuned = TUNED.at(tuned).missing(needs_tuned);
        found.extend(self.mono_first(&tuned, |setting| over_time::tuned(self.set, setting)));
        let frame = FRAME.at(frame).missing(needs_timed);
        found.extend(self.mono_first(&frame, |setting| breakdown::frame(self.set, setting)));
        let clustering = CLUSTERING.at(clustering).missing(needs_timed);
        found.extend(self.mono_first(&clustering, |setting| breakdown::clustering(self.set, setting)));
        let lights = LIGHTS.at(lights).missing(needs_tuned);
        found.extend(self.mono_first(&lights, |setting| distribution::lights(self.set, setting)));
        let fragments = FRAGMENTS.at(fragments).missing(needs_tuned);
        found.extend(self.mono_first(&fragments, |setting| distribution::fragments(self.set, setting)));
        found
    }

    fn pictures(&self, id: &str, title: &str, frames: &[u32]) -> Result<Vec<Figure>> {
        let wanted = Wanted {
            id,
            title,
            caption: "Rendered frames, tone-mapped, a column a lighting.",
            missing: "needs rendered frames: replay with --exr and frame numbers",
        };
        for stereo in [false, true] {
            let mut drawn = vec![];
            for setting in self.own(self.set.settings_once(), stereo) {
                if let Some((chart, remark)) = pictures::frames(self.set, setting, frames)? {
                    drawn.push(Drawn { setting, chart, remark });
                }
            }
            if !drawn.is_empty() {
                return Ok(figures(&wanted, drawn));
            }
        }
        Ok(figures(&wanted, vec![]))
    }
}

const CLUSTERS: Wanted<'static> = Wanted {
    id: "",
    title: "Grids of clusters",
    caption: "Clusters in three colours, by the sum of their indices modulo 3: as the camera sees them (of several views \
              side by side), and from above, where the bird's eye only looks and clusters nothing. Grey surfaces lie in \
              no visible cluster. Green lines are the frusta of the views, red ones those of the clusterings, or their \
              boxes.",
    missing: "needs rendered frames of Persp 64, Ortho 4 or Displ 64 32: replay with --exr and frame numbers",
};

const SHARING: Wanted<'static> = Wanted {
    id: "",
    title: "Indi against Encl in stereo",
    caption: "Profiling results of one clustering a view (Indi, solid) and one enclosing clustering for all views \
              (Encl, broken), Persp 64 and Ortho 4.",
    missing: "needs stereo runs of Persp 64 or Ortho 4, both Indi and Encl",
};

const TUNED: Wanted<'static> = Wanted {
    id: "",
    title: "The tuned methods",
    caption: "Profiling results of Persp 64, Ortho 4 and Displ 64 32.",
    missing: "",
};

const FRAME: Wanted<'static> = Wanted {
    id: "",
    title: "Frame breakdown",
    caption: "GPU time of the frame (ms). Miscellaneous is what is neither clustering nor shading: lights, culling \
              and the resolve. Panels of one lighting have one scale.",
    missing: "",
};

const CLUSTERING: Wanted<'static> = Wanted {
    id: "",
    title: "Clustering breakdown",
    caption: "GPU time of clustering (ms). Visibility is the depth pass and the marking of visible clusters; count is with \
              transforming or culling lights and building the hierarchy; miscellaneous is compaction and prefix sums. \
              Panels of one lighting have one scale.",
    missing: "",
};

const LIGHTS: Wanted<'static> = Wanted {
    id: "",
    title: "Clusters by light count",
    caption: "How many clusters (colour, logarithmic) have how many lights (vertical: single values up to 7, then four \
              rows an octave), frame by frame.",
    missing: "",
};

const FRAGMENTS: Wanted<'static> = Wanted {
    id: "",
    title: "Clusters by fragment count",
    caption: "How many clusters (colour, logarithmic) have how many fragments (vertical: single values up to 7, then \
              four rows an octave), frame by frame. Opaque surfaces give a \
              cluster of Persp 64 at most 64² fragments at one sample a pixel; transparent ones add theirs.",
    missing: "",
};

/// The colour of a kind of grid.
fn space_color(method: Method) -> Color {
    match method {
        Method::AllLights => "black",
        Method::World(_) => "sky",
        Method::Models => "purple",
        Method::Hashed(_) => "yellow",
        Method::Grid(grid) => match grid.space {
            Space::Persp { .. } => "blue",
            Space::Tiled { .. } | Space::Sliced { .. } | Space::Counted { .. } => "orange",
            Space::Ortho { .. } => "vermillion",
            Space::Displ { .. } => "green",
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_have_one_space_between() {
        for Wanted { title, caption, .. } in [CLUSTERS, SHARING, TUNED, FRAME, CLUSTERING, LIGHTS, FRAGMENTS]
        {
            assert!(!caption.contains("  ") && !title.contains("  "), "{caption}");
        }
    }
}
