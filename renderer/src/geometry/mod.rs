//! Clustering geometry, pure and in f64: frusta, enclosing frusta, cluster spaces, sphere tests.
//! It knows neither files nor GPU.

mod frustum;

pub use frustum::Frustum;
