//! Tables of how much light lobes send back: integrals without a formula.
//!
//! They are stored as values at Chebyshev's nodes, and what a surface needs of them is put together once: series over the
//! cosine, which are summed wherever a direction is asked for. What depends on the roughness is read between levels of it.

mod axis;
mod chebyshev;
mod curve;
mod drawn;
mod edge;
mod even;
mod folded;
mod interface;
mod levels;
#[cfg(test)]
mod make;
mod means;
mod profile;
mod reflection;
mod sheen;
mod stopped;
mod stored;

pub(crate) use curve::Curve;
pub(crate) use even::{Even, EvenProfile, even_cosines, even_mean, lean_means};
pub(crate) use interface::Losses;
pub(crate) use reflection::{CurveSeen, Place, Reflection};
pub(crate) use sheen::{SheenAlbedo, SheenStopped};
pub(crate) use stopped::Stopped;
