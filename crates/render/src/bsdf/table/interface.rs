//! How much light rough glass loses where facets shadow each other, in both directions.

use super::axis::index_axis;
use super::chebyshev::{nodes, weights};
use super::curve::Curve;
use super::drawn::Widths;
use super::edge::EdgeProfile;
use super::folded::{GLASS_NEAR, GLASS_SERIES};
use super::levels::Levels;
use super::profile::{self, AROUND, Profile};
use super::reflection::{Place, Reflection};
use super::stored::{COS, INDEX, TURN};
use crate::bsdf::ggx::Ggx;
use glam::Vec2;
use heliostat_scene::Rgb;

/// Light lost at one scattering, from one side, by the direction.
#[derive(Clone, Debug)]
pub(crate) enum Losses {
    /// From the side of the smaller index.
    Near(Profile<Rgb>),
    /// From the side of the larger index.
    Far(Inner),
}

/// For each ray, by the turn where highlights are drawn out.
#[derive(Clone, Debug)]
pub(crate) struct Inner {
    rays: Vec<Vec<EdgeProfile>>,
    /// Weights of the nodes of the turn in the mean around the normal.
    around: [f32; TURN],
}

impl Inner {
    fn new(ggx: &Ggx, rays: &[(f32, Curve)]) -> Self {
        let mut around = [0.0; TURN];
        for along in profile::around(ggx) {
            for (sum, weight) in around.iter_mut().zip(weights::<TURN>(turn_along(ggx, along))) {
                *sum += weight / AROUND as f32;
            }
        }
        Self { rays: rays.iter().map(|(eta, curve)| far(ggx, *eta, curve)).collect(), around }
    }

    /// The mean of what is known at the nodes of the turn, if it matters, by their weights.
    fn over_turns(&self, weights: impl Fn() -> [f32; TURN], value: impl Fn(&EdgeProfile) -> Rgb) -> Rgb {
        by_channel(&self.rays, |turns| match turns.as_slice() {
            [profile] => value(profile),
            _ => turns.iter().zip(weights()).map(|(profile, weight)| weight * value(profile)).sum(),
        })
    }
}

fn turn_along(ggx: &Ggx, along: Vec2) -> f32 {
    if ggx.is_isotropic() { 0.0 } else { ggx.turn_of(along.extend(0.0)) }
}

impl Losses {
    /// `eta` is the index of the other side over that of this one, and `curve` the reflectance over the cosine on the side of
    /// the smaller index; where that side sees no light, all is reflected. With dispersion there is one of both per channel.
    pub(crate) fn new(ggx: &Ggx, rays: &[(f32, Curve)]) -> Self {
        let is_far = rays.iter().any(|(eta, _)| *eta < 1.0);
        if is_far { Self::Far(Inner::new(ggx, rays)) } else { Self::Near(near(ggx, rays)) }
    }

    /// At a place.
    pub(crate) fn at(&self, place: &Place) -> Rgb {
        match self {
            Self::Near(profile) => profile.at(place.steep).max(Rgb::ZERO),
            Self::Far(inner) => {
                inner.over_turns(|| weights::<TURN>(place.steep.turn()), |profile| profile.at(place.cos))
            }
        }
    }

    /// The mean over the hemisphere, weighted by the cosine.
    pub(crate) fn mean(&self, reflection: &Reflection) -> Rgb {
        match self {
            Self::Near(profile) => reflection.mean_of_profile(profile),
            Self::Far(inner) => inner.over_turns(|| inner.around, EdgeProfile::mean),
        }
    }
}

/// One colour of all channels, from one ray of all or from one each.
fn by_channel<R>(rays: &[R], value: impl Fn(&R) -> Rgb) -> Rgb {
    match rays {
        [ray] => value(ray),
        _ => rays.iter().zip([Rgb::X, Rgb::Y, Rgb::Z]).map(|(ray, channel)| channel * value(ray)).sum(),
    }
}

fn far(ggx: &Ggx, eta: f32, curve: &Curve) -> Vec<EdgeProfile> {
    let ior = (1.0 / eta).max(1.0);
    let index = weights::<{ INDEX[1] }>(index_axis(ior));
    let profile = |alpha: f32| EdgeProfile::new(alpha, ior, index, curve);
    if ggx.is_isotropic() {
        return vec![profile(ggx.mean_alpha())];
    }
    let at_turn = |turn: f32| {
        let widths = Widths::new(ggx, turn);
        profile(widths.along).with_more(&widths.more_inside(ior, curve))
    };
    const { nodes::<TURN>() }.map(at_turn).to_vec()
}

fn near(ggx: &Ggx, rays: &[(f32, Curve)]) -> Profile<Rgb> {
    if ggx.is_isotropic() {
        return Profile::from_series(series_of(rays, |eta, curve| even(ggx.mean_alpha(), eta, curve)));
    }
    let at_turn = |turn: f32| {
        let widths = Widths::new(ggx, turn);
        series_of(rays, |eta, curve| {
            let mut series = even(widths.along, eta, curve);
            let more = widths.more_outside(eta, curve);
            series.iter_mut().zip(more).for_each(|(coefficient, more)| *coefficient += more);
            series
        })
    };
    Profile::from_turns(&const { nodes::<TURN>() }.map(at_turn))
}

fn series_of(rays: &[(f32, Curve)], series: impl Fn(f32, &Curve) -> [Rgb; COS]) -> [Rgb; COS] {
    let parts: Vec<[Rgb; COS]> = rays.iter().map(|(eta, curve)| series(*eta, curve)).collect();
    std::array::from_fn(|k| by_channel(&parts, |part| part[k]))
}

/// The series for facets that are the same in all directions.
fn even(alpha: f32, eta: f32, curve: &Curve) -> [Rgb; COS] {
    let numbers: [f32; GLASS_SERIES] = at_index(&GLASS_NEAR, alpha, weights::<{ INDEX[0] }>(index_axis(eta)));
    let (plain, curves) = numbers.split_at(COS);
    let folded = curve.fold::<COS>(curves);
    std::array::from_fn(|k| folded[k] + plain[k])
}

/// The numbers at a width and between the nodes of the index.
pub(super) fn at_index<const I: usize, const M: usize, const N: usize>(
    levels: &Levels<N>,
    alpha: f32,
    weights: [f32; I],
) -> [f32; M] {
    let (low, high, between) = levels.around(alpha);
    let mut sums = [0.0; M];
    let parts = low.as_chunks::<M>().0.iter().zip(high.as_chunks::<M>().0);
    for ((low, high), weight) in parts.zip(weights) {
        for (sum, (low, high)) in sums.iter_mut().zip(low.iter().zip(high)) {
            *sum += weight * (low + (high - low) * between);
        }
    }
    sums
}
