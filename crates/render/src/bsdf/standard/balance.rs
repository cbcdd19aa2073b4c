//! Rough matte matter under a boundary: keeps what the boundary lets in.
//!
//! A boundary lets more light in along some directions than along others, and a rough matte surface sends light of each
//! direction to others. So a profile that suits Lambert's surface does not suit this one: it is corrected by a factor for
//! either direction, from one step of the scaling that makes the sum due at every angle.
//!
//! # Source
//! Sinkhorn, "A Relationship Between Arbitrary Positive Matrices and Doubly Stochastic Matrices", 1964, for symmetric kernels,
//! to first order.

use crate::bsdf::diffuse::Matte;
use crate::bsdf::table::{Curve, EvenProfile, lean_means};
use glam::Vec3;
use heliostat_scene::Rgb;

/// The factors.
#[derive(Clone, Debug)]
pub(super) struct Balance {
    sent: EvenProfile<Rgb>,
    level: Rgb,
}

impl Balance {
    /// `passed` is what the boundary, and a cover, let pass over the cosine.
    pub(super) fn new(matte: &Matte, passed: impl Fn(f32) -> Rgb) -> Self {
        let curve = Curve::new(&passed);
        let mean = curve.cosine_mean().max(Rgb::splat(f32::MIN_POSITIVE));
        let between = Curve::new(|cos| passed(cos) * matte.missing(cos)).cosine_mean() / matte.missing_mean();
        // What white matter sends on, over what is due.
        let sent = EvenProfile::new(|cos, node| {
            let leaning = lean_means(node, &curve);
            (matte.once(mean, leaning) + between * matte.missing(cos)) / mean
        });
        let excess = Curve::new(|cos| passed(cos) * (sent.at(cos) - 1.0)).cosine_mean() / mean;
        Self { sent, level: 0.5 * excess + 2.0 }
    }

    /// The factor for one direction.
    pub(super) fn at(&self, w: Vec3) -> Rgb {
        (self.level - self.sent.at(w.z.abs())).max(Rgb::ZERO)
    }
}
