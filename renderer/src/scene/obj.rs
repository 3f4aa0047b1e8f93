//! Wavefront OBJ with MTL.
