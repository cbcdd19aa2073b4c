//! Groups against the same scene flattened by hand: every hit, every shadow, every pixel.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

#[path = "../common/mod.rs"]
mod common;
mod flat;
mod hits;
mod light;
mod memory;
mod pictures;
