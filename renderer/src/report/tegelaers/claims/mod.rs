//! The claims of the thesis. Few and many are the fewest and the most lights and pixels that what is compared was measured with;
//! counts are of the deferred pipeline, where there are runs of it.

mod compared;
mod growth;
mod memory;
mod nodes;
mod octree;
mod pipelines;
mod places;

#[cfg(test)]
mod tests;

use crate::report::claim::Stated;

/// Every claim, in order.
pub const CLAIMS: [Stated; 14] = [
    Stated {
        id: "H1",
        claim: "Hashed shading needs about half the lighting computations of tiled shading.",
        criterion: "In every scene, with many lights and pixels: the mean lighting computations by hashed with nodes of half a radius are 0.4 \
                     to 0.6 of those by tiled-mm.",
        of_ways: true,
        find: compared::half_of_tiled,
    },
    Stated {
        id: "H2",
        claim: "Forward, hashed shading is about twice as fast as tiled shading; deferred, both take the same time.",
        criterion: "In every scene, with many lights and pixels: the mean frame time by tiled-mm is 1.5 to 2.5 times that by hashed with nodes of \
                     half a radius forward, and 4/5 to 5/4 of it deferred. In the thesis the forward pipeline shades what is hidden later as well.",
        of_ways: true,
        find: compared::times,
    },
    Stated {
        id: "H3",
        claim: "With nodes of a quarter of a radius, hashed shading comes close to the computations of clustered shading.",
        criterion: "In every scene, with many lights and pixels: the mean lighting computations by hashed with nodes of a quarter of a radius are \
                     at most 1.2 times those by clustered-mm.",
        of_ways: true,
        find: compared::close_to_clustered,
    },
    Stated {
        id: "H4",
        claim: "Below a size of nodes, memory and time of building grow with the cube of their number along an axis.",
        criterion: "In every scene, under many lights: from the second smallest to the smallest size of nodes, of those up to a radius, the bytes of the \
                     octree grow with the power 2.8 to 3.2 of the nodes along an axis, the time of building with the power 2.5 to 3.5. What a light \
                     fills or leaves empty merges: where lights lie apart, nodes are those along their surfaces, and the power is 2.",
        of_ways: false,
        find: octree::cubic,
    },
    Stated {
        id: "H5",
        claim: "The seed of the hashes changes neither memory nor, much, the time of building.",
        criterion: "In every scene, of hashed by several seeds under many lights: the most bytes of the octree are at most 1.01 times the least, the most \
                     time of building at most 1.25 times the least.",
        of_ways: false,
        find: octree::seeds,
    },
    Stated {
        id: "H6",
        claim: "The starting depth changes neither computations nor memory.",
        criterion: "In every scene, of hashed of the size of nodes with most starting depths, with many lights and pixels: the most mean lighting \
                     computations are at most 1.02 times the least, the most bytes of the octree at most 1.1 times.",
        of_ways: false,
        find: octree::starting_depths,
    },
    Stated {
        id: "H7",
        claim: "Tiles cut the naive computations to a third or a quarter under many lights, to a half or two thirds under few; their size \
                hardly matters for large lights.",
        criterion: "In every scene: the mean lighting computations by all-lights are 2.5 to 5 times those by tiled-mm with many lights and pixels, \
                     1.25 to 2.5 times with few; with many, the most by any size of tiles are at most 1.25 times the least.",
        of_ways: true,
        find: compared::tiled,
    },
    Stated {
        id: "H8",
        claim: "Clusters nearly halve the computations of tiles, and vary less.",
        criterion: "In every scene, with many lights and pixels: the mean lighting computations by clustered-mm are 0.4 to 0.65 of those by \
                     tiled-mm, and their standard deviation over the frames is a smaller part of their mean.",
        of_ways: true,
        find: compared::clustered,
    },
    Stated {
        id: "H9",
        claim: "The deferred pipeline is faster and steadier than the forward one.",
        criterion: "In every scene, with many lights and pixels, by all-lights, tiled-mm and hashed with nodes of half a radius: the mean frame time, \
                     and its standard deviation over the frames as a part of it, are lower deferred than forward. In the thesis the forward \
                     pipeline shades what is hidden later as well.",
        of_ways: true,
        find: pipelines::deferred,
    },
    Stated {
        id: "H10",
        claim: "All methods grow linearly with lights and with pixels.",
        criterion: "In every scene, for all-lights, tiled-mm, clustered-mm and hashed with nodes of half a radius, with three numbers of lights, and of \
                     pixels, or more: mean frame times and lighting computations lie off their least-squares line by at most 10 % of their mean \
                     (root mean square).",
        of_ways: true,
        find: growth::linear,
    },
    Stated {
        id: "H11",
        claim: "Most of the memory lies in the two deepest layers.",
        criterion: "In every scene, under many lights, by hashed with each size of nodes up to a radius: structure, data and light indices of the two \
                     deepest depths are more than half of the bytes of the octree.",
        of_ways: false,
        find: octree::deepest,
    },
    Stated {
        id: "H12",
        claim: "Nodes larger than a light's diameter need not cost more computations.",
        criterion: "In one scene at least, with many lights and pixels: the mean lighting computations by hashed with the smallest nodes of more than two \
                     radii are at most 1.05 times those with the largest of two or fewer.",
        of_ways: false,
        find: nodes::large,
    },
    Stated {
        id: "H13",
        claim: "Under few lights smaller nodes make frames slower, for they take more steps to find.",
        criterion: "In every scene, with few lights and pixels: the mean frame time by hashed with the smallest nodes is above that with the largest.",
        of_ways: true,
        find: nodes::small,
    },
    Stated {
        id: "H14",
        claim: "The memory of hashed shading does not depend on the resolution, that of tiled and clustered shading does.",
        criterion: "In every scene, under the same lights: what groups and lists need with the fewest and with the most pixels differs by at most 1 % \
                     by hashed with nodes of half a radius, and by more than 10 % by tiled-mm and by clustered-mm.",
        of_ways: false,
        find: memory::of_resolution,
    },
];
