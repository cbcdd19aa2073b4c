//! How much light rough glass loses where facets shadow each other, in both directions.

use super::axis::{Place, grazing_axis, grazing_cos, grazing_decay, grazing_mean, node_width};
use crate::bsdf::fresnel::{Affine, refraction};
use crate::bsdf::ggx::Ggx;
use crate::bsdf::quadrature::gauss_legendre;
use crate::bsdf::refract;
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;
use std::sync::LazyLock;

/// Nodes of the cosine on the axis of grazing angles, of the width, and of the index of refraction.
const GRAZING: usize = 32;
const WIDTH: usize = 25;
const INDEX: usize = 25;
/// Nodes of the integrals over facets, around the normal (half of them, by symmetry) and away from it.
const TURNS: usize = 12;
const CAPS: usize = 16;
/// The largest index of refraction, or the inverse of the smallest, that the table tells from others.
const LARGEST: f32 = 3.0;

/// Light lost at one scattering, as a function of the reflectance of facets: `total + constant r0 + factor r1`, where the
/// reflectance is `r0 + r1 F` with Fresnel's `F`, and 1 where that is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Loss {
    total: f32,
    constant: f32,
    factor: f32,
}

impl Loss {
    /// For facets of this reflectance.
    ///
    /// `scale` is by how much more is lost than at the same width along all tangents.
    pub(crate) fn with(&self, affine: &Affine, scale: f32) -> Rgb {
        let (constant, factor) = affine.line();
        (scale * (Rgb::splat(self.total) + self.constant * constant + self.factor * factor))
            .clamp(Rgb::ZERO, Rgb::ONE)
    }

    fn add(&mut self, other: &Self, weight: f32) {
        self.total += weight * other.total;
        self.constant += weight * other.constant;
        self.factor += weight * other.factor;
    }
}

/// A rough boundary between two kinds of clear matter, seen from one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interface {
    alpha: f32,
    width: Place,
    index: Place,
    side: usize,
}

impl Interface {
    /// `eta` is the index of the other side over that of the viewer's.
    pub(crate) fn of(alpha: f32, eta: f32) -> Self {
        let side = usize::from(eta < 1.0);
        let ior = eta.max(1.0 / eta).min(LARGEST);
        let index = Place::even(index_axis(ior), INDEX);
        Self { alpha, width: Place::width(alpha, WIDTH), index, side }
    }

    /// For a viewer at an angle of cosine `cos`.
    pub(crate) fn loss(&self, cos: f32) -> Loss {
        let place = Place::even(grazing_axis(cos, self.alpha), GRAZING);
        let mut loss = Loss::default();
        let decay = grazing_decay(cos, self.alpha);
        self.each(|nodes, weight| {
            for (x, share) in place.pair() {
                loss.add(&nodes.by_cos[x], weight * share * decay);
            }
        });
        loss
    }

    /// The mean of [`Self::loss`] over the hemisphere, weighted by the cosine.
    pub(crate) fn loss_mean(&self) -> Loss {
        let mut loss = Loss::default();
        let square = self.alpha * self.alpha;
        self.each(|nodes, weight| loss.add(&nodes.mean, weight * square));
        loss
    }

    fn each(&self, mut visit: impl FnMut(&Nodes, f32)) {
        for (i, at_index) in self.index.pair() {
            for (w, at_width) in self.width.pair() {
                visit(&TABLE[self.side][i][w], at_index * at_width);
            }
        }
    }
}

/// From an index of refraction in `[1, LARGEST]` to an even axis: the cosine from which on light gets out of the denser side.
fn index_axis(ior: f32) -> f32 {
    critical(ior) / critical(LARGEST)
}

/// The inverse of [`index_axis`].
fn axis_index(x: f32) -> f32 {
    1.0 / (1.0 - (x * critical(LARGEST)).powi(2)).sqrt()
}

fn critical(ior: f32) -> f32 {
    (1.0 - 1.0 / (ior * ior)).max(0.0).sqrt()
}

/// Light lost at one width and index.
struct Nodes {
    /// Over [`grazing_decay`].
    by_cos: [Loss; GRAZING],
    /// Over the square of the width, as it grows.
    mean: Loss,
}

/// By side (0 from that of the smaller index), index and width.
static TABLE: LazyLock<[Vec<Vec<Nodes>>; 2]> = LazyLock::new(|| {
    std::array::from_fn(|side| {
        let at_index = |i: usize| {
            let ior = axis_index(i as f32 / (INDEX - 1) as f32);
            let eta = if side == 0 { ior } else { 1.0 / ior };
            (0..WIDTH).map(|w| nodes(node_width(w, WIDTH), eta)).collect()
        };
        (0..INDEX).map(at_index).collect()
    })
});

fn nodes(alpha: f32, eta: f32) -> Nodes {
    let by_cos: [Loss; GRAZING] =
        std::array::from_fn(|x| lost(grazing_cos(x as f32 / (GRAZING - 1) as f32, alpha), alpha, eta));
    let mut mean = Loss::default();
    for (place, area) in grazing_mean(GRAZING, alpha, alpha) {
        for (x, share) in place.pair() {
            mean.add(&by_cos[x], area * share / (alpha * alpha));
        }
    }
    Nodes { by_cos, mean }
}

/// The integral over the facets that a viewer sees.
fn lost(cos: f32, alpha: f32, eta: f32) -> Loss {
    let ggx = Ggx::isotropic(alpha);
    let wo = Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
    let mut loss = Loss::default();
    let decay = grazing_decay(cos, alpha);
    for (y, weight) in gauss_legendre::<CAPS>() {
        for turn in 0..TURNS {
            let u = Vec2::new((turn as f32 + 0.5) / (2 * TURNS) as f32, y);
            loss.add(&lost_at(&ggx, wo, ggx.visible(wo, u), eta), weight / (decay * TURNS as f32));
        }
    }
    loss
}

/// At one facet.
fn lost_at(ggx: &Ggx, wo: Vec3, h: Vec3, eta: f32) -> Loss {
    let cos = wo.dot(h).clamp(0.0, 1.0);
    let mirrored = 2.0 * cos * h - wo;
    let kept = if mirrored.z > 0.0 { ggx.hidden(wo, mirrored) } else { 1.0 };
    let exact = refraction(cos, eta);
    if exact.cos == 0.0 {
        return Loss { total: kept, ..Loss::default() };
    }
    let bent = refract(wo, h, cos, exact.cos, eta);
    let stopped = if bent.z < 0.0 { ggx.hidden(wo, bent) } else { 1.0 };
    let swapped = kept - stopped;
    Loss { total: stopped, constant: swapped, factor: exact.reflectance * swapped }
}
