//! Clustering geometry, pure and in f64: frusta, enclosing frusta, cluster spaces, tests of light volumes.
//! It knows neither files nor GPU.
//!
//! ```text
//! views ─> plan ─┬─ Indi: the view's frustum, one grid a view ─┬─ Persp: dimensions from pixels ──────┬─> Grid
//!                └─ Encl: enclosing frustum, one grid for all ─┼─ Displ: displaced, from a volume ────┤
//!                                                              └─ Ortho: bounds, from metres ─────────┘
//! ```

mod cell_test;
mod dimensions;
mod displaced;
mod enclosing;
mod frustum;
mod grid;
mod hexahedron;
mod light_mesh;
mod measured;
mod normal_cones;
mod oriented_box;
mod piece;
mod projected_sphere;
mod sector;
mod sharing;
mod slices;
mod sphere_test;
pub mod views;
mod volume;
mod volume_test;

pub use cell_test::{CellTest, Plane, axis_box, half_space};
pub use dimensions::{
    PerspectiveDimensions, average_volume, counted, counted_pixels, counted_tiles, from_metres, from_pixels,
    from_volume, side_in_tangents, sliced_tiles,
};
pub use displaced::{DisplacedVolume, displaced};
pub use enclosing::{Enclosing, enclosing};
pub use frustum::Frustum;
pub use grid::{CellShape, ClusterSpace, Grid, cell_at};
pub use hexahedron::Hexahedron;
pub use light_mesh::{LightMesh, MeshFrame, MeshKind, SphereLevel};
pub use measured::MeasuredBounds;
pub use normal_cones::{MOST_DIVISIONS, NormalCones};
pub use oriented_box::OrientedBox;
pub use projected_sphere::ProjectedSphere;
pub use sector::SphericalSector;
pub use sharing::Sharing;
pub use slices::{SliceLaw, Slices};
pub use sphere_test::{Separators, SphereTest};
pub use volume::{LightVolume, VolumeKind};
pub use volume_test::{ConeTest, VolumeTest};
