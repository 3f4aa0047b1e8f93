//! The ways of finding the lights of a fragment, by name.
//!
//! A method's name is its identity everywhere: on the command line, in configs, as run directory and as
//! row of every table. `indi-persp-64`, `encl-ortho-4`, `indi-displ-64-32`, `all-lights`.

pub mod grid;
mod spec;

pub use spec::{MethodSpec, Sharing, Space};
