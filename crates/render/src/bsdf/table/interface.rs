//! How much light rough glass loses where facets shadow each other, in both directions.

use super::axis::index_axis;
use super::curve::Curve;
use super::profile::Profile;
use super::reflection::plane_at;
use super::stored::{COS, CURVE, GLASS, INDEX, WIDTH};
use crate::bsdf::ggx::Ggx;
use heliostat_scene::Rgb;

/// Light lost at one scattering, from one side, by the direction. `eta` is the index of the other side over that of this one,
/// and `curve` the reflectance over the cosine on the side of the smaller index; where that side sees no light, all is
/// reflected. With dispersion there is one of both per channel.
pub(crate) fn interface(ggx: &Ggx, rays: &[(f32, Curve)]) -> Profile<Rgb> {
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
