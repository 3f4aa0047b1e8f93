//! The one table of methods.

use super::grid::{GridMethod, Space};
use super::sizes::{DEPTH, NODE, SLICES, Size, Sizes, Unit};
use super::{HashedMethod, Method, NodeSize, Sharing, WorldGrid};
use crate::assign::{Assigner, Bounds, Clusters};
use crate::geometry::{CellShape, SliceLaw, SphereTest};

/// What fragments that share a light list are grouped by, and who makes the lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Groups {
    /// Nothing: every fragment takes all lights, and there are no lists.
    Nothing,
    /// Cells of this shape, to whose lists the device assigns lights in each frame.
    Cells(CellShape),
    /// Leaves of an octree over the lights, which the host builds where the lights have changed.
    Leaves,
}

/// Most sizes of a kind.
const MOST_SIZES: usize = 3;

/// A kind of method: what is behind a name but for the sizes.
#[derive(Debug)]
pub struct Kind {
    /// Name of the kind: that of its methods without sizes.
    pub name: &'static str,
    /// What the numbers behind the name are, in order.
    pub sizes: &'static [&'static str],
    /// The sizes that its paper finds best, or that are usual.
    pub tuned: &'static [f64],
    /// What the names of its methods have behind the sizes.
    pub suffix: &'static str,
    /// Name of the kind in figures.
    pub title: &'static str,
    /// What the kind does, a line for help and README.
    pub about: &'static str,
    /// How views share the clusterings of the method.
    pub sharing: Sharing,
    /// How shading walks a list: a file in `shaders-glsl/lookup`.
    pub lookup: &'static str,
    /// What has lists.
    pub groups: Groups,
    make: fn(&Sizes) -> Method,
}

/// What rows of the table begin from: a perspective grid for each view.
const PERSPECTIVE: Kind = Kind {
    name: "",
    sizes: &[],
    tuned: &[],
    suffix: "",
    title: "",
    about: "",
    sharing: Sharing::Indi,
    lookup: "clustered",
    groups: Groups::Cells(CellShape::Frustum),
    make: |_| Method::AllLights,
};

/// What rows of grids of so many columns, rows and slices begin from.
const COUNTED: Kind = Kind {
    sizes: &["COLUMNS", "ROWS", SLICES],
    groups: Groups::Cells(CellShape::BoxedFrustum),
    ..PERSPECTIVE
};

/// Every kind of method. All serve transparent geometry, all views in stereo, and any number of samples (models: where fragments
/// run for each).
pub static KINDS: [Kind; 26] = [
    Kind {
        name: "indi-persp",
        sizes: &["PIXELS"],
        tuned: &[64.0],
        title: "Indi Persp",
        about: "a perspective grid for each view",
        make: |sizes| Method::grid(Sharing::Indi, Space::Persp { pixels: sizes[0] }),
        ..PERSPECTIVE
    },
    Kind {
        name: "encl-persp",
        sizes: &["PIXELS"],
        tuned: &[64.0],
        title: "Encl Persp",
        about: "one perspective grid on the frustum that encloses all views",
        sharing: Sharing::Encl,
        make: |sizes| Method::grid(Sharing::Encl, Space::Persp { pixels: sizes[0] }),
        ..PERSPECTIVE
    },
    Kind {
        name: "indi-ortho",
        sizes: &["METRES"],
        tuned: &[4.0],
        title: "Indi Ortho",
        about: "a grid of boxes for each view",
        groups: Groups::Cells(CellShape::Box),
        make: |sizes| Method::grid(Sharing::Indi, Space::Ortho { metres: sizes[0] }),
        ..PERSPECTIVE
    },
    Kind {
        name: "encl-ortho",
        sizes: &["METRES"],
        tuned: &[4.0],
        title: "Encl Ortho",
        about: "one grid of boxes around all views",
        sharing: Sharing::Encl,
        groups: Groups::Cells(CellShape::Box),
        make: |sizes| Method::grid(Sharing::Encl, Space::Ortho { metres: sizes[0] }),
        ..PERSPECTIVE
    },
    Kind {
        name: "indi-displ",
        sizes: &["PIXELS", "METRES"],
        tuned: &[64.0, 32.0],
        title: "Indi Displ",
        about: "a perspective grid for each view, its apex moved back",
        make: |sizes| displ(Sharing::Indi, sizes),
        ..PERSPECTIVE
    },
    Kind {
        name: "encl-displ",
        sizes: &["PIXELS", "METRES"],
        tuned: &[64.0, 32.0],
        title: "Encl Displ",
        about: "one perspective grid on the frustum that encloses all views, its apex moved back",
        sharing: Sharing::Encl,
        make: |sizes| displ(Sharing::Encl, sizes),
        ..PERSPECTIVE
    },
    Kind {
        name: "tiled",
        sizes: &["PIXELS"],
        tuned: &[16.0],
        title: "Tiled",
        about: "tiles of each view's screen, from the near to the far plane",
        make: |sizes| Method::grid(Sharing::Indi, Space::Tiled { pixels: sizes[0] }),
        ..PERSPECTIVE
    },
    Kind {
        name: "t-i",
        sizes: &["PIXELS"],
        tuned: &[28.0],
        title: "T-I",
        about: "tiles of each view's screen, all of them with lists",
        make: |sizes| Method::Grid(tiles(Bounds::Implicit, sizes)),
        ..PERSPECTIVE
    },
    Kind {
        name: "t-e",
        sizes: &["PIXELS"],
        tuned: &[28.0],
        title: "T-E",
        about: "tiles of each view's screen, each with the depths of its samples",
        make: |sizes| Method::Grid(tiles(Bounds::Measured, sizes)),
        ..PERSPECTIVE
    },
    Kind {
        name: "dc-i",
        sizes: &["PIXELS", SLICES],
        tuned: &[128.0, 64.0],
        title: "DC-I",
        about: "tiles of each view's screen in so many slices, all clusters with lists",
        make: |sizes| sliced((Clusters::All, Bounds::Implicit), sizes),
        ..PERSPECTIVE
    },
    Kind {
        name: "dc-e",
        sizes: &["PIXELS", SLICES],
        tuned: &[64.0, 40.0],
        title: "DC-E",
        about: "tiles of each view's screen in so many slices, each cluster with the box of its samples",
        make: |sizes| sliced((Clusters::All, Bounds::Measured), sizes),
        ..PERSPECTIVE
    },
    Kind {
        name: "sc-i",
        sizes: &["PIXELS", SLICES],
        tuned: &[48.0, 40.0],
        title: "SC-I",
        about: "tiles of each view's screen in so many slices, visible clusters with lists",
        make: |sizes| sliced((Clusters::Visible, Bounds::Implicit), sizes),
        ..PERSPECTIVE
    },
    Kind {
        name: "sc-e",
        sizes: &["PIXELS", SLICES],
        tuned: &[48.0, 40.0],
        title: "SC-E",
        about: "tiles of each view's screen in so many slices, visible clusters with lists and the box of their samples",
        make: |sizes| sliced((Clusters::Visible, Bounds::Measured), sizes),
        ..PERSPECTIVE
    },
    Kind {
        name: "ortiz",
        tuned: &[16.0, 9.0, 24.0],
        title: "Ortiz",
        about: "so many square tiles and slices of each view's screen, whatever its pixels, tested as the boxes around them",
        make: |sizes| {
            let [columns, rows, slices] = [sizes[0], sizes[1], sizes[2]];
            Method::grid(Sharing::Indi, Space::Counted { columns, rows, slices })
        },
        ..COUNTED
    },
    Kind {
        name: "tiled-mm",
        sizes: &["PIXELS"],
        tuned: &[32.0],
        title: "Tiled MM",
        about: "tiles of each view's screen, all of them with the lights whose rectangle on the screen meets them",
        make: |sizes| {
            let test = SphereTest::Projected;
            Method::Grid(GridMethod { test, ..tiles(Bounds::Implicit, sizes) })
        },
        ..PERSPECTIVE
    },
    Kind {
        name: "clustered-mm",
        sizes: &["PIXELS"],
        tuned: &[32.0],
        title: "Clustered MM",
        about: "tiles of each view's screen in slices as deep as tiles are high, visible clusters with such lights",
        make: |sizes| {
            let grid = GridMethod::new(Sharing::Indi, Space::Persp { pixels: sizes[0] });
            Method::Grid(GridMethod { test: SphereTest::Projected, slices: SliceLaw::Cubes, ..grid })
        },
        ..PERSPECTIVE
    },
    Kind {
        name: "raster",
        suffix: "-e",
        tuned: &[24.0, 12.0, 64.0],
        title: "Raster E",
        about: "so many tiles and slices, these geometric behind the first; all clusters that the mesh around a light meets have it",
        make: |sizes| rasterised((Assigner::Raster, Sharing::Indi), SLICES_E, sizes),
        ..COUNTED
    },
    Kind {
        name: "raster",
        suffix: "-l",
        tuned: &[24.0, 12.0, 128.0],
        title: "Raster L",
        about: "the same, in slices of equal depth",
        make: |sizes| rasterised((Assigner::Raster, Sharing::Indi), SliceLaw::Linear, sizes),
        ..COUNTED
    },
    Kind {
        name: "encl-raster",
        suffix: "-e",
        tuned: &[24.0, 12.0, 64.0],
        title: "Encl Raster E",
        about: "so many columns, rows and slices of the frustum that encloses all views, with the lights of raster",
        sharing: Sharing::Encl,
        make: |sizes| rasterised((Assigner::Raster, Sharing::Encl), SLICES_E, sizes),
        ..COUNTED
    },
    Kind {
        name: "encl-raster",
        suffix: "-l",
        tuned: &[24.0, 12.0, 128.0],
        title: "Encl Raster L",
        about: "the same, in slices of equal depth",
        sharing: Sharing::Encl,
        make: |sizes| rasterised((Assigner::Raster, Sharing::Encl), SliceLaw::Linear, sizes),
        ..COUNTED
    },
    Kind {
        name: "raster-count",
        suffix: "-e",
        tuned: &[24.0, 12.0, 64.0],
        title: "Raster Count E",
        about: "lists of raster, a light at a time: no slices of meshes are kept",
        make: |sizes| rasterised((Assigner::RasterCount, Sharing::Indi), SLICES_E, sizes),
        ..COUNTED
    },
    Kind {
        name: "raster-count",
        suffix: "-l",
        tuned: &[24.0, 12.0, 128.0],
        title: "Raster Count L",
        about: "the same, in slices of equal depth",
        make: |sizes| rasterised((Assigner::RasterCount, Sharing::Indi), SliceLaw::Linear, sizes),
        ..COUNTED
    },
    Kind {
        name: "g",
        sizes: &["CELLS"],
        tuned: &[20.0],
        suffix: "",
        title: "G",
        about: "one grid of so many cells an axis in a box of the world, whatever the views",
        sharing: Sharing::Encl,
        lookup: "world",
        groups: Groups::Cells(CellShape::Box),
        make: |sizes| Method::World(WorldGrid { cells: sizes[0] }),
    },
    Kind {
        name: "m",
        sizes: &[],
        tuned: &[],
        suffix: "",
        title: "M",
        about: "a list for each model, as it is drawn, whatever the views",
        sharing: Sharing::Encl,
        lookup: "model",
        groups: Groups::Cells(CellShape::Model),
        make: |_| Method::Models,
    },
    Kind {
        name: "hashed",
        sizes: &[NODE, DEPTH],
        tuned: &[0.5, 3.0],
        suffix: "",
        title: "Hashed",
        about: "an octree over the lights, its leaves found by perfect spatial hashes from a depth on; the size of its smallest \
                nodes is in radii of the smallest light, or in metres with `m` behind it",
        sharing: Sharing::Encl,
        lookup: "hashed",
        groups: Groups::Leaves,
        make: |sizes| {
            let size = sizes[0];
            let node = match sizes.unit(0) {
                Unit::Own => NodeSize::Radii(size),
                Unit::Metres => NodeSize::Metres(size),
            };
            Method::Hashed(HashedMethod { node, start_depth: sizes[1] })
        },
    },
    Kind {
        name: "all-lights",
        sizes: &[],
        tuned: &[],
        suffix: "",
        title: "All lights",
        about: "every light for every fragment: the truth",
        sharing: Sharing::Encl,
        lookup: "all_lights",
        groups: Groups::Nothing,
        make: |_| Method::AllLights,
    },
];

/// Örtegren's exponential law.
const SLICES_E: SliceLaw = SliceLaw::SecondPlane { metres: 5.0 };

/// Tiles and slices, all with lists, to which meshes around lights are rasterised (Örtegren and Persson).
fn rasterised((rasterising, sharing): (Assigner, Sharing), slices: SliceLaw, sizes: &Sizes) -> Method {
    let space = Space::Counted { columns: sizes[0], rows: sizes[1], slices: sizes[2] };
    let grid = GridMethod::new(sharing, space);
    Method::Grid(GridMethod { clusters: Clusters::All, slices, rasterising: Some(rasterising), ..grid })
}

fn displ(sharing: Sharing, sizes: &Sizes) -> Method {
    Method::grid(sharing, Space::Displ { pixels: sizes[0], displacement: sizes[1] })
}

/// Tiles that all have lists (Enhuber section 3.1).
fn tiles(bounds: Bounds, sizes: &Sizes) -> GridMethod {
    let tiled = GridMethod::new(Sharing::Indi, Space::Tiled { pixels: sizes[0] });
    GridMethod { clusters: Clusters::All, bounds, ..tiled }
}

/// Tiles in slices (Enhuber section 3.2).
fn sliced((clusters, bounds): (Clusters, Bounds), sizes: &Sizes) -> Method {
    let sliced = GridMethod::new(Sharing::Indi, Space::Sliced { pixels: sizes[0], slices: sizes[1] });
    Method::Grid(GridMethod { clusters, bounds, ..sliced })
}

impl Groups {
    /// Shape of the cells to whose lists the device assigns lights; `None` without such.
    pub fn cells(self) -> Option<CellShape> {
        match self {
            Self::Cells(shape) => Some(shape),
            Self::Nothing | Self::Leaves => None,
        }
    }
}

impl Kind {
    /// Whether these are sizes of the kind: as many as [`Self::sizes`] names, each such as its name says.
    pub fn takes(&self, sizes: &[Size]) -> bool {
        sizes.len() == self.sizes.len() && self.sizes.iter().zip(sizes).all(|(name, size)| size.fits(name))
    }

    /// The method with these sizes, which it [takes](Self::takes).
    pub fn with_sizes(&self, sizes: &[Size]) -> Method {
        (self.make)(&Sizes(sizes))
    }

    /// The method with the tuned sizes.
    pub fn tuned(&self) -> Method {
        // Every frame asks, so that nothing may be allocated.
        let sizes: [Size; MOST_SIZES] =
            std::array::from_fn(|place| self.tuned.get(place).map_or(0.0, |&number| number).into());
        self.with_sizes(&sizes[..self.tuned.len()])
    }

    /// Shape of the cells to whose lists the device assigns lights; `None` without such.
    pub fn cells(&self) -> Option<CellShape> {
        self.groups.cells()
    }

    /// The name with what its numbers stand for: `indi-displ-PIXELS-METRES`.
    pub fn pattern(&self) -> String {
        [self.name].iter().chain(self.sizes).copied().collect::<Vec<_>>().join("-") + self.suffix
    }
}

impl Method {
    /// What kind it is.
    pub fn kind(&self) -> &'static Kind {
        KINDS.iter().find(|kind| kind.tuned().is_like(self)).expect("the table has every kind of method")
    }

    /// Sizes of the method, in the order of its name.
    pub fn sizes(&self) -> Vec<Size> {
        match self {
            Self::AllLights | Self::Models => vec![],
            Self::Grid(GridMethod { space, .. }) => space.sizes().into_iter().map(Size::from).collect(),
            Self::World(WorldGrid { cells }) => vec![Size::from(*cells)],
            Self::Hashed(hashed) => hashed.sizes().to_vec(),
        }
    }

    /// Whether fragments look their lights up in lists.
    pub fn has_lists(&self) -> bool {
        self.kind().groups != Groups::Nothing
    }

    /// Whether the device assigns lights to the lists of cells, so that ways of assignment, tests and stores of lists bear on
    /// the method.
    pub fn assigns(&self) -> bool {
        self.kind().cells().is_some()
    }

    /// Whether it makes its lists in a way of its own, so that neither ways of assignment nor tests bear on it.
    pub fn is_rasterised(&self) -> bool {
        self.rasterising().is_some()
    }

    /// How it makes its lists where that is by rasterising meshes.
    pub fn rasterising(&self) -> Option<Assigner> {
        match self {
            Self::Grid(grid) => grid.rasterising,
            Self::World(_) | Self::Models | Self::Hashed(_) | Self::AllLights => None,
        }
    }

    /// Whether it keeps where meshes lie, which are drawn in several ways.
    pub fn has_shells(&self) -> bool {
        self.rasterising() == Some(Assigner::Raster)
    }

    /// Whether it rasterises meshes around lights, which may be finer or coarser.
    pub fn has_meshes(&self) -> bool {
        self.rasterising().is_some()
    }

    /// Whether ways of assignment and tests of lights bear on the method.
    pub fn takes_ways(&self) -> bool {
        self.assigns() && !self.is_rasterised()
    }

    /// Whether its lists are those of an octree over the lights.
    pub fn has_octree(&self) -> bool {
        self.kind().groups == Groups::Leaves
    }

    /// Whether the two differ in their sizes alone.
    fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::AllLights, Self::AllLights)
            | (Self::World(_), Self::World(_))
            | (Self::Hashed(_), Self::Hashed(_))
            | (Self::Models, Self::Models) => true,
            (Self::Grid(a), Self::Grid(b)) => a.is_like(b),
            (Self::AllLights | Self::Grid(_) | Self::World(_) | Self::Models | Self::Hashed(_), _) => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_its_own() {
        for kind in &KINDS {
            let method = kind.tuned();
            assert_eq!((method.kind().name, method.kind().suffix), (kind.name, kind.suffix));
            let sizes: Vec<f64> = method.sizes().iter().map(|size| size.number).collect();
            assert_eq!((kind.sizes.len(), sizes.as_slice()), (kind.tuned.len(), kind.tuned));
            assert!(kind.takes(&method.sizes()));
            if let Method::Grid(grid) = method {
                assert_eq!((grid.sharing, Some(grid.space.shape())), (kind.sharing, kind.cells()));
                assert_eq!(grid.test == SphereTest::Projected, kind.name.ends_with("-mm"), "{}", kind.name);
            }
        }
    }
}
