//! Whitted ray tracing over Heliostat scenes.

mod background;
mod camera_ray;
mod check;
pub mod counters;
pub mod error;
pub mod film;
pub mod filter;
pub mod integrator;
mod layers;
mod light;
mod material_eval;
mod meta;
mod phong;
mod post_dof;
pub mod prepared;
pub mod sampler;
pub mod schedule;
mod shading;
pub mod stats;
mod texture_eval;
pub mod world;

pub use counters::RayCounters;
pub use error::RenderError;
pub use film::Film;
pub use integrator::{CameraRay, FirstHit, Integrator, Sample};
pub use prepared::Prepared;
pub use sampler::Sampler;
pub use schedule::{Control, PassOutcome, TileDone};
pub use stats::RenderStats;
pub use world::{TreeCache, World, WorldError};
