//! M. van Gelderen, *Stereoscopic Clustered Light Shading* (TU Delft 2020): the figures of chapters 4 and 6 and of
//! appendices A and C, and the claims of chapter 6.

mod claims;
mod figures;

use super::claim;
use super::paper::{Paper, Section};
use super::results::Setting;
use crate::methods::Method;

/// The thesis.
pub const PAPER: Paper = Paper {
    name: "Gelderen 2020",
    sections: &[
        Section { heading: "Chapter 4: grids", anchor: "chapter-4", ids: &["4."] },
        Section { heading: "Chapter 6: evaluation", anchor: "chapter-6", ids: &["6."] },
        Section { heading: "Appendix A: attenuation", anchor: "appendix-a", ids: &["A."] },
        Section { heading: "Appendix C: Sun Temple", anchor: "appendix-c", ids: &["C"] },
    ],
    figures: figures::all,
    tables: |_| vec![],
    claims: &claims::CLAIMS,
    judged: claim::by_way,
    measures,
};

/// Grids that every view has of its own or that enclose all, and what else no other paper's page is about.
fn measures(method: Method) -> bool {
    let others = [super::enhuber::measures, super::ortiz::measures, super::tegelaers::measures];
    // Whoever compares with all lights does so beside methods of their own.
    method != Method::AllLights && !others.iter().any(|measures| measures(method))
}

/// Whether the scene is that of the thesis's appendix C; else it is that of chapter 6.
fn is_sun_temple(setting: &Setting) -> bool {
    let belongs = |name: &str| {
        let name = name.to_ascii_lowercase();
        name.contains("temple") || name.contains("suntem")
    };
    belongs(&setting.scene) || belongs(&setting.recording)
}

/// Whether the camera flies the thesis's path through the street, which looks at far geometry around frame 580.
fn flies_the_street(setting: &Setting) -> bool {
    setting.recording.to_ascii_lowercase().contains("bistro")
}
