//! The `manylight` program.

fn main() {}
