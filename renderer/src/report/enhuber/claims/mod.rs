//! The claims of Enhuber chapter 4. Each compares the methods that stand for their kinds, by the evaluation's test.

mod alike;
mod compared;
mod explicit;
mod growth;
mod histograms;
mod lists;
mod speed;
mod tests_of_lights;

#[cfg(test)]
mod tests;

use crate::report::claim::Stated;

/// Every claim, in the order of the chapter.
pub const CLAIMS: [Stated; 13] = [
    Stated {
        id: "E1",
        claim: "Measured bounds beat implicit ones at 10 000 lights: tiles, dense clusters, sparse clusters.",
        criterion: "In every scene, under 10 000 lights or else the most: the mean frame time by T-E is below that by T-I, by DC-E below \
                     DC-I, by SC-E below SC-I.",
        of_ways: true,
        find: explicit::faster,
    },
    Stated {
        id: "E2",
        claim: "The frame time grows linearly with the number of lights, by all seven methods.",
        criterion: "In every scene, for T-I, T-E, DC-I, SC-I, SC-E, G and M at three numbers of lights or more: the mean frame times lie off \
                     their least-squares line by at most 5 % of their mean (root mean square).",
        of_ways: true,
        find: growth::linear,
    },
    Stated {
        id: "E3",
        claim: "SC-E and SC-I have the lowest slopes of shading and of all, and the highest offset.",
        criterion: "In every scene, of the lines over lights of the seven methods: the slopes of shading and of all by both are below those \
                     of the five others, and the offsets of assignment above them.",
        of_ways: true,
        find: growth::sparse,
    },
    Stated {
        id: "E4",
        claim: "The frame time varies least by SC-E, then SC-I, and most by M, then T-I.",
        criterion: "In every scene, under 10 000 lights or else the most, of the standard deviations of the frame time over the frames: SC-E \
                     below SC-I, SC-I below the five others, T-I above the others but M, M above T-I.",
        of_ways: true,
        find: alike::deviations,
    },
    Stated {
        id: "E5",
        claim: "HS+SAT-N is the fastest test: for T-E in every scene, for SC-E in most; its shading takes about as long as that of HS+SAT-EPV.",
        criterion: "Of the 18 tests under 10 000 lights or else the most: the mean frame time of T-E is the least by hs+sat-n in every \
                     scene, that of SC-E in more than half of the scenes; the mean shading time by hs+sat-n is within 10 % of \
                     that by hs+sat-epv.",
        of_ways: true,
        find: tests_of_lights::best,
    },
    Stated {
        id: "E6",
        claim: "The fastest of the seven are DC-I at 100 lights, T-E at 1000 and SC-E at 10 000.",
        criterion: "The worst scene decides for each method: the greatest mean frame time over the scenes is the least by DC-I under 100 \
                     lights, by T-E under 1000, by SC-E under 10 000.",
        of_ways: true,
        find: speed::fastest,
    },
    Stated {
        id: "E7",
        claim: "M has the lowest slope of assignment and the highest of shading.",
        criterion: "In every scene, of the lines over lights of the seven methods: the slope of assignment by M is below all others, that of \
                     shading above all others.",
        of_ways: true,
        find: growth::models,
    },
    Stated {
        id: "E8",
        claim: "DC-I and G behave alike.",
        criterion: "In every scene, under 100, 1000 and 10 000 lights: the mean frame time by G is 2/3 to 3/2 of that by DC-I.",
        of_ways: true,
        find: alike::dense_and_world,
    },
    Stated {
        id: "E9",
        claim: "Measured bounds make the relative deviation of the frame time smaller: tiles and sparse clusters.",
        criterion: "In every scene, under 10 000 lights or else the most: the ratio of standard deviation to mean of the frame time over the \
                     frames is lower by T-E than by T-I, and by SC-E than by SC-I.",
        of_ways: true,
        find: explicit::steadier,
    },
    Stated {
        id: "E10",
        claim: "With depth discontinuity the lists of T-E grow, those of SC-E little.",
        criterion: "In every scene, under 10 000 lights or else the most, from the frame of least to that of most depth discontinuity of those \
                     rendered to files: the mean number of lights of a group grows by T-E more than twice as much as it changes by SC-E.",
        of_ways: false,
        find: histograms::shift,
    },
    Stated {
        id: "E11",
        claim: "The lists of G and M are the same for all views (their times are not).",
        criterion: "Of lights that stand still, in every run of G and M: all frames have as many light indices, and frames rendered to files \
                     the same groups by lights. How much the frame time differs all the same is told.",
        of_ways: false,
        find: lists::whatever_the_view,
    },
    Stated {
        id: "E12",
        claim: "Shading dominates every slope.",
        criterion: "In every scene, of the lines over lights of each of the seven methods: the slope of shading is above that of assignment.",
        of_ways: true,
        find: growth::shading,
    },
    Stated {
        id: "E13",
        claim: "Sparse clusters need far less memory for lists than dense ones.",
        criterion: "In every scene, under 10 000 lights or else the most, at the same size of clusters: the most lists that SC-E needs in any \
                     frame are at most half of those of DC-E or DC-I. A list has a fixed room in the thesis, so that lists \
                     are memory.",
        of_ways: false,
        find: lists::sparse,
    },
];
