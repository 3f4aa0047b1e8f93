//! Clustering geometry, pure and in f64: frusta, enclosing frusta, cluster spaces, sphere tests.
//! It knows neither files nor GPU.
//!
//! ```text
//! views ─> plan ─┬─ Indi: the view's frustum, one grid a view ─┬─ Persp: dimensions from pixels ──────┬─> Grid
//!                └─ Encl: enclosing frustum, one grid for all ─┼─ Displ: displaced, from a volume ────┤
//!                                                              └─ Ortho: bounds, from metres ─────────┘
//! ```

mod dimensions;
mod displaced;
mod enclosing;
mod frustum;
mod grid;
mod piece;
mod plan;
mod sphere;
mod sphere_test;

#[cfg(test)]
mod properties;
#[cfg(test)]
mod worked_values;

pub use enclosing::{Enclosing, enclosing};
pub use frustum::Frustum;
pub use grid::{ClusterSpace, Grid, cell_at};
pub use plan::plan;
pub use sphere::{CellTest, Plane, axis_box, half_space};
pub use sphere_test::{Candidates, SphereTest};
