//! Structs shared by host and shaders.
