//! Whitted ray tracing over Heliostat scenes.

pub mod sampler;

pub use sampler::Sampler;
