//! Whitted ray tracing over Heliostat scenes.

pub mod counters;
pub mod filter;
pub mod integrator;
pub mod sampler;
pub mod world;

pub use counters::RayCounters;
pub use integrator::{CameraRay, FirstHit, Integrator, Sample};
pub use sampler::Sampler;
pub use world::World;
