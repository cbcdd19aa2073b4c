//! Groups against the same scene flattened by hand: every hit, every shadow, every pixel.

#[path = "../common/mod.rs"]
mod common;
mod flat;
mod hits;
mod light;
mod memory;
mod pictures;
