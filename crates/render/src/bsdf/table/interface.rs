//! How much light rough glass loses where facets shadow each other, in both directions.

use super::axis::index_axis;
use super::chebyshev::weights;
use super::curve::Curve;
use super::folded::{GLASS_FAR, GLASS_NEAR, GLASS_SERIES};
use super::levels::Levels;
use super::profile::Profile;
use super::stored::{COS, CURVE, GLASS, INDEX, WIDTH};
use super::reflection::plane_at;
use crate::bsdf::ggx::Ggx;
use heliostat_scene::Rgb;

/// Light lost at one scattering, from one side, by the direction. `eta` is the index of the other side over that of this one,
/// and `curve` the reflectance over the cosine on the side of the smaller index; where that side sees no light, all is
/// reflected. With dispersion there is one of both per channel.
pub(crate) fn interface(ggx: &Ggx, rays: &[(f32, Curve)]) -> Profile<Rgb> {
    if !ggx.is_isotropic() {
        return drawn_out(ggx, rays);
    }
    let mut series = [Rgb::ZERO; COS];
    for (channel, (eta, curve)) in rays.iter().enumerate() {
        let part = even(ggx.mean_alpha(), *eta, curve);
        if rays.len() == 1 {
            series = part;
        } else {
            series.iter_mut().zip(part).for_each(|(sum, value)| sum[channel] = value[channel]);
        }
    }
    Profile::from_series(series)
}

/// The series for facets that are the same in all directions.
fn even(alpha: f32, eta: f32, curve: &Curve) -> [Rgb; COS] {
    let at = index_axis(eta.max(1.0 / eta));
    let numbers = if eta >= 1.0 {
        at_index(&GLASS_NEAR, alpha, weights::<{ INDEX[0] }>(at))
    } else {
        at_index(&GLASS_FAR, alpha, weights::<{ INDEX[1] }>(at))
    };
    let (plain, curves) = numbers.split_at(COS);
    let folded = curve.fold(curves);
    std::array::from_fn(|k| folded[k] + plain[k])
}

/// The numbers at a width and between the nodes of the index.
fn at_index<const I: usize, const N: usize>(levels: &Levels<N>, alpha: f32, weights: [f32; I]) -> [f32; GLASS_SERIES] {
    let (low, high, between) = levels.around(alpha);
    let mut sums = [0.0; GLASS_SERIES];
    let parts = low.as_chunks::<GLASS_SERIES>().0.iter().zip(high.as_chunks::<GLASS_SERIES>().0);
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
        let nodes = nodes(*eta);
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

const NODES: usize = WIDTH * COS * (1 + CURVE);

/// At an index of refraction: by width and cosine, what is lost without reflection, and weights of the nodes of a curve.
fn nodes(eta: f32) -> [f32; NODES] {
    let at = index_axis(eta.max(1.0 / eta));
    if eta >= 1.0 { GLASS[0].at::<{ INDEX[0] }, NODES>(at) } else { GLASS[1].at::<{ INDEX[1] }, NODES>(at) }
}
