//! glTF 2.0 (.gltf, .glb).
