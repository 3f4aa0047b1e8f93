//! The claims of Gelderen chapter 6.

mod far;
mod limits;
mod stereo;

#[cfg(test)]
mod tests;

use super::super::claim::Stated;

/// Every claim, in the order of the chapter.
pub const CLAIMS: [Stated; 8] = [
    Stated {
        id: "G1",
        claim: "Encl about halves the total of visible clusters.",
        criterion: "In stereo, for Persp 64, Ortho 4 and Displ 64 32 where measured, under every lighting: the mean of \
                     visible clusters by Encl is 0.4 to 0.6 of that by Indi.",
        of_ways: true,
        find: stereo::visible_clusters,
    },
    Stated {
        id: "G2",
        claim: "Encl lowers clustering time, most at 100 000 lights and for Ortho with far geometry.",
        criterion: "In stereo: the mean clustering time by Encl is below that by Indi for each tuned size under every \
                     lighting; the time saved is greatest at 100 000 lights; for Ortho 4 it is greater at frames 530 to \
                     630 of the street's recording than at the others.",
        of_ways: true,
        find: stereo::clustering_time,
    },
    Stated {
        id: "G3",
        claim: "Encl Persp needs fewer lighting computations than Indi Persp.",
        criterion: "In stereo, Persp 64, under every lighting: the mean of lighting computations by Encl is below that \
                     by Indi.",
        of_ways: true,
        find: stereo::lighting_computations,
    },
    Stated {
        id: "G4",
        claim: "Far geometry, Persp: few visible clusters, more lights per cluster, shading dearer.",
        criterion: "Indi Persp 64 at frames 530 to 630 of the street's recording against the others, under every \
                     lighting: the mean of visible clusters is lower, of light indices a visible cluster higher, of \
                     shading time higher.",
        of_ways: false,
        find: far::persp,
    },
    Stated {
        id: "G5",
        claim: "Far geometry, Ortho: most visible clusters, clustering dearest.",
        criterion: "Indi Ortho 4, under every lighting: the frame with the most visible clusters and the frame with \
                     the dearest clustering both lie in 530 to 630 of the street's recording.",
        of_ways: false,
        find: far::ortho,
    },
    Stated {
        id: "G6",
        claim: "Displ 64 32 has a steadier frame time than Persp 64 and Ortho 4.",
        criterion: "Indi, under every lighting: the standard deviation of the frame's time over the replay is lower by \
                     Displ 64 32 than by Persp 64 and than by Ortho 4.",
        of_ways: false,
        find: limits::steadiness,
    },
    Stated {
        id: "G7",
        claim: "Persp 64 never has more than 4096 fragments per cluster at one sample a pixel.",
        criterion: "No cluster of any frame of any run of Indi Persp 64 at one sample a pixel has more than 4096 \
                     fragments. Fragments of transparent surfaces count too.",
        of_ways: false,
        find: limits::fragments,
    },
    Stated {
        id: "G8",
        claim: "Brute-force assignment grows linearly with the lights.",
        criterion: "For each Indi tuned size with two numbers of lights or more: the slope of the logarithm of \
                     intersection tests over that of the lights lies in 0.99 to 1.01, and that of the time to count and \
                     assign lights in 0.8 to 1.2.",
        of_ways: true,
        find: limits::growth,
    },
];

/// Frames of the street's recording that look at far geometry (Gelderen figures 6.2 and 6.3: around frame 580).
fn is_far(frame: u32) -> bool {
    (530..=630).contains(&frame)
}
