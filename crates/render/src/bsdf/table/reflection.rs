//! How much light rough boundaries reflect, once, for any curve of reflectance over the angle.

use super::anisotropic;
use super::axis::{Place, grazing_axis, grazing_cos, grazing_decay, grazing_mean, node_width};
use crate::bsdf::ggx::Ggx;
use crate::bsdf::quadrature::gauss_legendre;
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;
use std::sync::LazyLock;

/// Nodes of a reflectance over the angle, at cosines `(k / (CURVE - 1))^2`.
const CURVE: usize = 16;
/// Nodes of the cosine of the viewer, even in its root.
const COS: usize = 64;
/// Nodes of the width.
const WIDTH: usize = 33;
/// Nodes of the cosine on the axis of grazing angles.
const GRAZING: usize = 64;
/// Nodes of the integrals over facets, around the normal (half of them, by symmetry) and away from it.
const TURNS: usize = 16;
const CAPS: usize = 32;

/// A reflectance at the nodes of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Curve([Rgb; CURVE]);

impl Curve {
    /// Of a reflectance over the cosine.
    pub(crate) fn new(reflectance: impl Fn(f32) -> Rgb) -> Self {
        Self(std::array::from_fn(|k| reflectance(node_cos(k))))
    }

    /// Whether it is 0 at every angle.
    pub(crate) fn is_zero(&self) -> bool {
        self.0 == [Rgb::ZERO; CURVE]
    }

    fn sum(&self, weights: &[f32; CURVE]) -> Rgb {
        let sum: Rgb = self.0.iter().zip(weights).map(|(&value, &weight)| value * weight).sum();
        // Cubic weights swing below 0.
        sum.max(Rgb::ZERO)
    }
}

impl Curve {
    /// The first channel at a cosine.
    fn at(&self, cos: f32) -> f32 {
        self.sum(&between_nodes(cos)).x
    }
}

fn node_cos(k: usize) -> f32 {
    (k as f32 / (CURVE - 1) as f32).powi(2)
}

/// Weights by which a curve at its nodes gives its value between them: cubic convolution over the root of the cosine.
///
/// # Source
/// Keys, "Cubic Convolution Interpolation for Digital Image Processing", 1981, equations 15 and 19.
fn between_nodes(cos: f32) -> [f32; CURVE] {
    let Place { index, share: s } = Place::even(cos.max(0.0).sqrt(), CURVE);
    let (s2, s3) = (s * s, s * s * s);
    let taps = [
        -0.5 * s3 + s2 - 0.5 * s,
        1.5 * s3 - 2.5 * s2 + 1.0,
        -1.5 * s3 + 2.0 * s2 + 0.5 * s,
        0.5 * s3 - 0.5 * s2,
    ];
    let mut weights = [0.0; CURVE];
    for (k, tap) in taps.into_iter().enumerate() {
        match (index + k).checked_sub(1) {
            // The root of the cosine is squared again: the curve is even there.
            None => weights[1] += tap,
            Some(CURVE) => {
                weights[CURVE - 1] += 3.0 * tap;
                weights[CURVE - 2] -= 3.0 * tap;
                weights[CURVE - 3] += tap;
            }
            Some(node) => weights[node] += tap,
        }
    }
    weights
}

/// What is known of reflection by one distribution of facets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reflection {
    /// `None` for a mirror.
    ggx: Option<Ggx>,
    /// Where its mean width lies in the table.
    width: Place,
}

impl Reflection {
    /// Of facets; `None` for a mirror.
    pub(crate) fn of(ggx: Option<Ggx>) -> Self {
        Self { ggx, width: Place::width(ggx.map_or(0.0, |ggx| ggx.mean_alpha()), WIDTH) }
    }

    /// Share of the light that facets which reflect all keep at first, and throw at each other, for a viewer along `w`.
    pub(crate) fn lost(&self, w: Vec3) -> f32 {
        let Some(ggx) = &self.ggx else { return 0.0 };
        let cos = w.z.abs().min(1.0);
        if !ggx.is_isotropic() {
            return anisotropic::lost(ggx, w);
        }
        let place = Place::even(grazing_axis(cos, ggx.mean_alpha()), GRAZING);
        let mut sum = 0.0;
        for (width, at_width) in self.width.pair() {
            for (x, at_cos) in place.pair() {
                sum += at_width * at_cos * TABLE.lost[width][x];
            }
        }
        sum * grazing_decay(cos, ggx.mean_alpha())
    }

    /// The mean of [`Self::lost`] over the hemisphere, weighted by the cosine; above 0.
    pub(crate) fn lost_mean(&self) -> f32 {
        let Some(ggx) = &self.ggx else { return f32::MIN_POSITIVE };
        if !ggx.is_isotropic() {
            return anisotropic::lost_mean(ggx).max(f32::MIN_POSITIVE);
        }
        let mean: f32 = self.width.pair().into_iter().map(|(w, share)| share * TABLE.lost_mean[w]).sum();
        (mean * ggx.mean_alpha().powi(2)).max(f32::MIN_POSITIVE)
    }

    /// Share of the light that facets with this reflectance send on at once.
    pub(crate) fn albedo(&self, curve: &Curve, w: Vec3) -> Rgb {
        let place = Place::even(w.z.abs().sqrt(), COS);
        let width = match &self.ggx {
            Some(ggx) if !ggx.is_isotropic() => Place::width(ggx.width_along(w), WIDTH),
            _ => self.width,
        };
        let mut weights = [0.0; CURVE];
        for (w, at_width) in width.pair() {
            for (c, at_cos) in place.pair() {
                let share = at_width * at_cos;
                for (sum, weight) in weights.iter_mut().zip(&TABLE.angles[w][c]) {
                    *sum += share * weight;
                }
            }
        }
        (1.0 - self.lost(w)) * curve.sum(&weights)
    }

    /// The mean of [`Self::albedo`] over the hemisphere, weighted by the cosine.
    pub(crate) fn albedo_mean(&self, curve: &Curve) -> Rgb {
        if self.ggx.is_some_and(|ggx| !ggx.is_isotropic()) {
            return self.mean_around(|w| self.albedo(curve, w));
        }
        let mut weights = [0.0; CURVE];
        for (w, share) in self.width.pair() {
            for (sum, weight) in weights.iter_mut().zip(&TABLE.angles_mean[w]) {
                *sum += share * weight;
            }
        }
        curve.sum(&weights)
    }

    /// Of white light, what facets send to a viewer along `w` from more grazing directions and what a cover stops of it, because
    /// it lets the smaller of what passes along either direction; `passed` is that over the cosine.
    pub(crate) fn stopped(&self, passed: &Curve, w: Vec3) -> f32 {
        let Some(ggx) = &self.ggx else { return 0.0 };
        let cos = w.z.abs().min(1.0);
        let width = Place::width(ggx.width_along(w), WIDTH);
        let here = passed.at(cos);
        let steps = LOWER.map(|lower| (here - passed.at(cos * (1.0 - lower))).max(0.0));
        let mut sum = 0.0;
        for (width, at_width) in width.pair() {
            for (c, at_cos) in Place::even(cos.sqrt(), COS).pair() {
                for (step, weight) in steps.iter().zip(&TABLE.lower[width][c]) {
                    sum += at_width * at_cos * step * weight;
                }
            }
        }
        sum.max(0.0)
    }

    /// What is left, per unit of light that facets keep at first, of the light that they throw at each other until it leaves.
    ///
    /// # Source
    /// Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", 2017, pages 11 to 18; with the factor of Hill, "A
    /// Multi-Faceted Exploration", 2018, for light that has met two facets at least.
    pub(crate) fn between(&self, curve: &Curve) -> Rgb {
        let (mean, lost) = (cosine_mean(curve), self.lost_mean());
        mean * mean * (1.0 - lost) / (Rgb::ONE - mean * lost)
    }

    /// The mean over the hemisphere, weighted by the cosine, of what depends on a direction as the facets do.
    pub(crate) fn mean_around(&self, value: impl Fn(Vec3) -> Rgb) -> Rgb {
        let at = |cos: f32, turn: Vec2| ((1.0 - cos * cos).max(0.0).sqrt() * turn).extend(cos);
        match &self.ggx {
            Some(ggx) if !ggx.is_isotropic() => {
                // From one tangent to the other.
                let turns =
                    [0.196, 0.589, 0.982, 1.374].map(|angle| Vec2::from_angle(angle).rotate(ggx.tangent()));
                cosine_mean(&Curve::new(|cos| {
                    turns.iter().map(|turn| value(at(cos, *turn))).sum::<Rgb>() / 4.0
                }))
            }
            _ => cosine_mean(&Curve::new(|cos| value(at(cos, Vec2::X)))),
        }
    }
}

/// The mean over the hemisphere, weighted by the cosine, of a reflectance over the cosine.
pub(crate) fn cosine_mean(curve: &Curve) -> Rgb {
    curve.sum(&TABLE.angles_mean[0])
}

/// See [`Reflection`]; the first index is that of the width.
struct Table {
    /// Over [`grazing_decay`].
    lost: Vec<[f32; GRAZING]>,
    /// Over the square of the width, as it grows.
    lost_mean: Vec<f32>,
    /// Weights of the nodes of a curve, which add up to 1.
    angles: Vec<[[f32; CURVE]; COS]>,
    angles_mean: Vec<[f32; CURVE]>,
    /// Weights of what a function of the cosine of the light loses at each of [`LOWER`], in light from lower than the viewer.
    lower: Vec<[[f32; LOWER.len()]; COS]>,
}

/// How much lower than the viewer, as a share of the cosine.
const LOWER: [f32; 6] = [0.1, 0.25, 0.45, 0.65, 0.85, 1.0];

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let widths = || (0..WIDTH).map(|w| node_width(w, WIDTH));
    let lost: Vec<[f32; GRAZING]> =
        widths().map(|alpha| std::array::from_fn(|x| lost_at(x, alpha))).collect();
    let mean = |(row, alpha): (&[f32; GRAZING], f32)| {
        let at = |place: Place| place.pair().map(|(x, share)| share * row[x]).iter().sum::<f32>();
        let sum: f32 = grazing_mean(GRAZING, alpha, alpha).map(|(place, area)| area * at(place)).sum();
        sum / (alpha * alpha)
    };
    Table {
        lost_mean: lost.iter().zip(widths()).map(mean).collect(),
        lost,
        angles: widths().map(|alpha| std::array::from_fn(|c| angles_at(c, alpha))).collect(),
        angles_mean: widths().map(angles_mean_at).collect(),
        lower: widths().map(|alpha| std::array::from_fn(|c| lower_at(c, alpha))).collect(),
    }
});

fn lost_at(x: usize, alpha: f32) -> f32 {
    let cos = grazing_cos(x as f32 / (GRAZING - 1) as f32, alpha);
    facets(cos, alpha).iter().map(|node| node.weight * node.hidden).sum::<f32>() / grazing_decay(cos, alpha)
}

fn angles_at(c: usize, alpha: f32) -> [f32; CURVE] {
    let cos = (c as f32 / (COS - 1) as f32).powi(2);
    let weights = curve_weights(cos, alpha);
    let sum: f32 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

/// Weights of the nodes of a curve, in the light that is sent on at once.
fn curve_weights(cos: f32, alpha: f32) -> [f32; CURVE] {
    let mut weights = [0.0; CURVE];
    for node in facets(cos, alpha) {
        for (sum, weight) in weights.iter_mut().zip(between_nodes(node.cos)) {
            *sum += node.weight * (1.0 - node.hidden) * weight;
        }
    }
    weights
}

/// Weights, at [`LOWER`], of what is 0 at the viewer's cosine and linear between, in the light from lower that is sent on.
fn lower_at(c: usize, alpha: f32) -> [f32; LOWER.len()] {
    let cos = (c as f32 / (COS - 1) as f32).powi(2);
    let mut weights = [0.0; LOWER.len()];
    for node in facets(cos, alpha).iter().filter(|node| node.height < cos) {
        let lower = ((cos - node.height) / cos).clamp(0.0, 1.0);
        let next = LOWER.iter().position(|at| lower <= *at).unwrap_or(LOWER.len() - 1);
        let before = next.checked_sub(1).map_or(0.0, |k| LOWER[k]);
        let share = (lower - before) / (LOWER[next] - before);
        let light = node.weight * (1.0 - node.hidden);
        weights[next] += light * share;
        if next > 0 {
            weights[next - 1] += light * (1.0 - share);
        }
    }
    weights
}

/// The mean of [`curve_weights`] over the hemisphere, weighted by the cosine.
fn angles_mean_at(alpha: f32) -> [f32; CURVE] {
    let mut sum = [0.0; CURVE];
    for (x, weight) in gauss_legendre::<CAPS>() {
        // Nodes crowd where the angle is grazing: the cosine is the square.
        let (cos, weight) = (x * x, weight * 4.0 * x * x * x);
        for (sum, node) in sum.iter_mut().zip(curve_weights(cos, alpha)) {
            *sum += weight * node;
        }
    }
    sum
}

/// A node of the integral over the facets that a viewer sees.
struct FacetNode {
    /// Cosine between facet and viewer.
    cos: f32,
    /// Cosine of the light that it reflects.
    height: f32,
    weight: f32,
    /// Share of the light that it keeps at first.
    hidden: f32,
}

/// The integral over the facets that a viewer sees.
fn facets(cos: f32, alpha: f32) -> Vec<FacetNode> {
    let ggx = Ggx::isotropic(alpha);
    let wo = Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
    let mut nodes = Vec::with_capacity(TURNS * CAPS);
    for (y, weight) in gauss_legendre::<CAPS>() {
        for turn in 0..TURNS {
            let u = Vec2::new((turn as f32 + 0.5) / (2 * TURNS) as f32, y);
            let h = ggx.visible_reflecting(wo, u);
            let cos = wo.dot(h);
            let wi = 2.0 * cos * h - wo;
            let hidden = if wi.z > 0.0 { ggx.hidden_reflecting(wo, wi) } else { 1.0 };
            let (cos, weight) = (cos.clamp(0.0, 1.0), weight / TURNS as f32);
            nodes.push(FacetNode { cos, height: wi.z, weight, hidden });
        }
    }
    nodes
}
