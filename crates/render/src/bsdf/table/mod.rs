//! Tables of how much light lobes send back: integrals without a formula, worked out at first use.

mod anisotropic;
mod axis;
mod interface;
mod reflection;
mod sheen;

pub(crate) use interface::{Interface, Loss};
pub(crate) use reflection::{Curve, Reflection, cosine_mean};
pub(crate) use sheen::{sheen_albedo, sheen_scale};
