//! How much light rough boundaries keep at first whose highlights are drawn out.

use super::axis::{Place, grazing_axis, grazing_cos, grazing_decay, grazing_mean, node_width};
use crate::bsdf::ggx::Ggx;
use crate::bsdf::quadrature::gauss_legendre;
use glam::{Vec2, Vec3};
use std::f32::consts::FRAC_PI_2;
use std::sync::LazyLock;

/// Nodes of the smaller width, of the strength that makes the larger one, of the turn from one tangent to the other, and of
/// the cosine on the axis of grazing angles.
const WIDTH: usize = 13;
const STRENGTH: usize = 7;
const TURN: usize = 7;
const GRAZING: usize = 24;
/// Nodes of the integral over facets, around the normal and away from it.
const TURNS: usize = 24;
const CAPS: usize = 16;

/// A width by which nothing decays: across the highlight another width counts at every angle.
const FLAT: f32 = 1024.0;

/// See [`super::Reflection::lost`].
pub(super) fn lost(ggx: &Ggx, w: Vec3) -> f32 {
    let (cos, alpha) = (w.z.abs().min(1.0), ggx.width_along(w));
    let axis = grazing_axis(cos, alpha);
    let (turn, x) = (Place::even(ggx.turn_of(w) / FRAC_PI_2, TURN), Place::even(axis, GRAZING));
    grazing_decay(cos, FLAT)
        * sum_over(ggx, |nodes| {
            let mut sum = 0.0;
            for (t, at_turn) in turn.pair() {
                for (c, at_cos) in x.pair() {
                    sum += at_turn * at_cos * nodes.lost[t][c];
                }
            }
            sum
        })
}

/// See [`super::Reflection::lost_mean`].
pub(super) fn lost_mean(ggx: &Ggx) -> f32 {
    sum_over(ggx, |nodes| nodes.mean) * mean_square(ggx)
}

/// The mean square of the width along all turns.
fn mean_square(ggx: &Ggx) -> f32 {
    0.5 * ggx.alpha().length_squared()
}

fn sum_over(ggx: &Ggx, value: impl Fn(&Nodes) -> f32) -> f32 {
    let (width, strength) = (Place::width(ggx.alpha().y, WIDTH), Place::even(ggx.strength(), STRENGTH));
    let mut sum = 0.0;
    for (w, at_width) in width.pair() {
        for (s, at_strength) in strength.pair() {
            sum += at_width * at_strength * value(&TABLE[w][s]);
        }
    }
    sum
}

/// Light kept at one width and strength, by turn and cosine, over [`grazing_decay`]; and its mean over [`mean_square`].
struct Nodes {
    lost: [[f32; GRAZING]; TURN],
    mean: f32,
}

static TABLE: LazyLock<Vec<Vec<Nodes>>> = LazyLock::new(|| {
    let at = |w: usize, s: usize| {
        nodes(&Ggx::stretched_by(node_width(w, WIDTH), s as f32 / (STRENGTH - 1) as f32))
    };
    (0..WIDTH).map(|w| (0..STRENGTH).map(|s| at(w, s)).collect()).collect()
});

fn nodes(ggx: &Ggx) -> Nodes {
    let turn = |t: usize| Vec2::from_angle(FRAC_PI_2 * t as f32 / (TURN - 1) as f32);
    let (mut lost, mut mean) = ([[0.0; GRAZING]; TURN], 0.0);
    for (t, row) in lost.iter_mut().enumerate() {
        let alpha = ggx.width_along(turn(t).extend(0.0));
        for (x, value) in row.iter_mut().enumerate() {
            let cos = grazing_cos(x as f32 / (GRAZING - 1) as f32, alpha);
            let wo = ((1.0 - cos * cos).max(0.0).sqrt() * turn(t)).extend(cos);
            *value = lost_at(ggx, wo) / grazing_decay(cos, FLAT);
        }
        let at = |place: Place| place.pair().map(|(x, share)| share * row[x]).iter().sum::<f32>();
        // The trapezoid's rule over the turns.
        let share = if t == 0 || t == TURN - 1 { 0.5 } else { 1.0 } / (TURN - 1) as f32;
        mean += share * grazing_mean(GRAZING, alpha, FLAT).map(|(place, area)| area * at(place)).sum::<f32>();
    }
    Nodes { lost, mean: mean / mean_square(ggx) }
}

/// The integral over the facets that a viewer sees.
fn lost_at(ggx: &Ggx, wo: Vec3) -> f32 {
    let mut sum = 0.0;
    for (y, weight) in gauss_legendre::<CAPS>() {
        for turn in 0..TURNS {
            let h = ggx.visible_reflecting(wo, Vec2::new((turn as f32 + 0.5) / TURNS as f32, y));
            let wi = 2.0 * wo.dot(h) * h - wo;
            let hidden = if wi.z > 0.0 { ggx.hidden_reflecting(wo, wi) } else { 1.0 };
            sum += weight / TURNS as f32 * hidden;
        }
    }
    sum
}
