//! How much light rough glass loses where facets shadow each other, in both directions.

use super::axis::index_axis;
use super::chebyshev::{nodes, weights};
use super::curve::Curve;
use super::edge::EdgeProfile;
use super::folded::{GLASS_NEAR, GLASS_SERIES};
use super::levels::Levels;
use super::profile::Profile;
use super::reflection::{Place, Reflection, plane_at};
use super::stored::{COS, CURVE, GLASS, INDEX, TURN, WIDTH};
use crate::bsdf::ggx::Ggx;
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
pub(crate) struct Inner(Vec<Vec<EdgeProfile>>);

impl Losses {
    /// `eta` is the index of the other side over that of this one, and `curve` the reflectance over the cosine on the side of
    /// the smaller index; where that side sees no light, all is reflected. With dispersion there is one of both per channel.
    pub(crate) fn new(ggx: &Ggx, rays: &[(f32, Curve)]) -> Self {
        let is_far = rays.iter().any(|(eta, _)| *eta < 1.0);
        match (is_far, ggx.is_isotropic()) {
            (true, _) => Self::Far(Inner(rays.iter().map(|(eta, curve)| far(ggx, *eta, curve)).collect())),
            (false, true) => Self::Near(even(ggx.mean_alpha(), rays)),
            (false, false) => Self::Near(drawn_out(ggx, rays)),
        }
    }

    /// At a place.
    pub(crate) fn at(&self, place: &Place) -> Rgb {
        match self {
            Self::Near(profile) => profile.at(place.steep).max(Rgb::ZERO),
            Self::Far(Inner(rays)) => by_channel(rays, |turns| match turns.as_slice() {
                [profile] => profile.at(place.cos),
                _ => {
                    let turn = weights::<TURN>(place.steep.turn());
                    turns.iter().zip(turn).map(|(profile, weight)| weight * profile.at(place.cos)).sum()
                }
            }),
        }
    }

    /// The mean over the hemisphere, weighted by the cosine.
    pub(crate) fn mean(&self, reflection: &Reflection) -> Rgb {
        match self {
            Self::Near(profile) => reflection.mean_of_profile(profile),
            // The nodes of the turn lie evenly around the normal.
            Self::Far(Inner(rays)) => by_channel(rays, |turns| {
                turns.iter().map(|profile| profile.mean()).sum::<Rgb>() / turns.len() as f32
            }),
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
    const { nodes::<TURN>() }.map(|turn| profile(ggx.width_along(ggx.along(turn).extend(0.0)))).to_vec()
}

fn even(alpha: f32, rays: &[(f32, Curve)]) -> Profile<Rgb> {
    let parts: Vec<[Rgb; COS]> = rays
        .iter()
        .map(|(eta, curve)| {
            let index = weights::<{ INDEX[0] }>(index_axis(*eta));
            let numbers: [f32; GLASS_SERIES] = at_index(&GLASS_NEAR, alpha, index);
            let (plain, curves) = numbers.split_at(COS);
            let folded = curve.fold::<COS>(curves);
            std::array::from_fn(|k| folded[k] + plain[k])
        })
        .collect();
    Profile::from_series(std::array::from_fn(|k| by_channel(&parts, |part| part[k])))
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

fn drawn_out(ggx: &Ggx, rays: &[(f32, Curve)]) -> Profile<Rgb> {
    let mut plane = [[Rgb::ZERO; COS]; WIDTH];
    for (channel, (eta, curve)) in rays.iter().enumerate() {
        let nodes: [f32; WIDTH * COS * (1 + CURVE)] = GLASS.at::<{ INDEX[0] }, _>(index_axis(*eta));
        for (k, node) in nodes.as_chunks::<{ 1 + CURVE }>().0.iter().enumerate() {
            let value = curve.sum(&node[1..]) + node[0];
            let place = &mut plane[k / COS][k % COS];
            if rays.len() == 1 { *place = value } else { place[channel] = value[channel] }
        }
    }
    Profile::new(
        Some(ggx),
        |w| ggx.width_along(w),
        |w, _| plane_at(&plane, ggx.alike(w), ggx.alike(w), w).clamp(Rgb::ZERO, Rgb::ONE),
    )
}
