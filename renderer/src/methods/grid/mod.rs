//! Methods that group fragments by the cells of a grid.

mod plan;

#[cfg(test)]
mod properties;
#[cfg(test)]
mod worked_values;

pub use plan::plan;
