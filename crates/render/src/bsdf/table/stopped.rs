//! Light of facets that a cover stops.
//!
//! A cover lets the smaller of what passes along either direction: of light that facets send to a viewer from more grazing
//! directions it stops a part more than of what it lets pass there.

use super::axis::grazing_axis;
use super::chebyshev::{nodes, weights};
use super::curve::Curve;
use super::folded::LOWER_NODES;
use super::profile::Profile;
use super::reflection::{Place, Reflection};
use super::stored::{COS, CURVE, LOWER};
use crate::bsdf::ggx::Ggx;
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;

/// What is stopped of light that facets send to a viewer, by the viewer's direction.
#[derive(Clone, Debug)]
pub(crate) struct Stopped {
    profile: Profile<Rgb>,
    mean: Rgb,
}

impl Stopped {
    /// `passed` is what the cover lets pass along a direction, and `curve` what facets do with light over its angle to them.
    pub(crate) fn new(reflection: &Reflection, passed: impl Fn(Vec3) -> f32, curve: &Curve) -> Self {
        let Some(ggx) = reflection.ggx() else {
            return Self {
                profile: Profile::from_series([Rgb::ZERO; COS]),
                mean: Rgb::splat(f32::MIN_POSITIVE),
            };
        };
        let profile = if ggx.is_isotropic() {
            let passed = Passed::new(Vec2::X, &passed);
            let (low, high, between) = LOWER_NODES.around(ggx.mean_alpha());
            let levels = (&low[..], &high[..], between);
            let stopped = |w: Vec3, [_, c]: [usize; 2]| curve.sum(&at_node(levels, c, &passed.steps(w.z)));
            Profile::new(Some(ggx), |_| ggx.mean_alpha(), stopped)
        } else {
            Profile::new(Some(ggx), |w| ggx.width_along(w), |w, _| curve.sum(&drawn_out(ggx, &passed, w)))
        };
        let mean = reflection.mean_of_profile(&profile).max(Rgb::splat(f32::MIN_POSITIVE));
        Self { profile, mean }
    }

    /// At a place.
    pub(crate) fn at(&self, place: &Place) -> Rgb {
        self.profile.at(place.steep).max(Rgb::ZERO)
    }

    /// The mean over the hemisphere, weighted by the cosine; above 0.
    pub(crate) fn mean(&self) -> Rgb {
        self.mean
    }
}

/// The weights of a curve's nodes at one node of the cosine, for as much stopped at each lower direction.
fn at_node((low, high, between): (&[f32], &[f32], f32), node: usize, steps: &[f32; LOWER]) -> [f32; CURVE] {
    let mut sums = [0.0; CURVE];
    for (lower, step) in steps.iter().enumerate() {
        let at = (node * LOWER + lower) * CURVE;
        for (sum, (low, high)) in sums.iter_mut().zip(low[at..at + CURVE].iter().zip(&high[at..])) {
            *sum += step * (low + (high - low) * between);
        }
    }
    sums
}

/// The same in one direction at facets drawn out: by even ones as wide as these are along it and, the less grazing it is, by
/// those as wide as these are across.
fn drawn_out(ggx: &Ggx, passed: impl Fn(Vec3) -> f32, w: Vec3) -> [f32; CURVE] {
    let flat = w.truncate().normalize_or(ggx.tangent());
    let steps = Passed::new(flat, &passed).steps(w.z);
    let (along, across) = (ggx.width_along(w), ggx.width_along(flat.perp().extend(0.0)));
    let share = 0.5 * w.z;
    let mut sums = [0.0; CURVE];
    for (alpha, share) in [(along, 1.0 - share), (across, share)] {
        let (low, high, between) = LOWER_NODES.around(alpha);
        for (node, weight) in weights::<COS>(grazing_axis(w.z, alpha)).into_iter().enumerate() {
            let part = at_node((low.as_slice(), high.as_slice(), between), node, &steps);
            sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += share * weight * part);
        }
    }
    sums
}

/// What a cover lets pass along directions of one plane: lines between a few of them.
struct Passed([f32; PLACES]);

/// Directions, evenly over the root of the cosine.
const PLACES: usize = 33;

impl Passed {
    /// In the plane of the normal and `flat`.
    fn new(flat: Vec2, passed: &impl Fn(Vec3) -> f32) -> Self {
        Self(std::array::from_fn(|k| {
            let cos = (k as f32 / (PLACES - 1) as f32).powi(2);
            passed(((1.0 - cos * cos).sqrt() * flat).extend(cos))
        }))
    }

    fn at(&self, cos: f32) -> f32 {
        let x = cos.clamp(0.0, 1.0).sqrt() * (PLACES - 1) as f32;
        let k = (x as usize).min(PLACES - 2);
        self.0[k] + (self.0[k + 1] - self.0[k]) * (x - k as f32)
    }

    /// How much less passes at the nodes of lower directions than at this cosine.
    fn steps(&self, cos: f32) -> [f32; LOWER] {
        let here = self.at(cos);
        const { nodes::<LOWER>() }.map(|lower| (here - self.at(cos * (1.0 - lower))).max(0.0))
    }
}
