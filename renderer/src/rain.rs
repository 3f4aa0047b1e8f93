//! Falling lights.
