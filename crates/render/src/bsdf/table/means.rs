//! Means over the hemisphere of curves of reflectance seen through facets, over the roughness.
//!
//! Where textures vary the roughness, a surface is put together at every hit: these means would take most of the time.

use super::chebyshev::nodes;
use super::curve::Curve;
use super::levels::Levels;
use super::reflection::Reflection;
use super::stored::{CURVE, FINE_WIDTH};
use crate::bsdf::ggx::Ggx;
use std::sync::LazyLock;

/// How many levels of the roughness there are.
const LEVELS: usize = 257;

static MEANS: LazyLock<Levels<CURVE>> =
    LazyLock::new(|| Levels::new::<FINE_WIDTH>(LEVELS, &const { nodes::<FINE_WIDTH>() }.map(at_node)));

/// The means over the hemisphere, weighted by the cosine, of the weights of a curve's nodes in what facets that are the same in all
/// directions do not keep.
pub(super) fn curve_means(alpha: f32) -> [f32; CURVE] {
    MEANS.at(alpha)
}

fn at_node(x: f32) -> [f32; CURVE] {
    let reflection = Reflection::of(Some(Ggx::isotropic(x * x)));
    std::array::from_fn(|k| {
        let seen = reflection.seen(&Curve::unit(k));
        let kept = reflection.mean_around(|w| {
            let place = reflection.place(w);
            (1.0 - reflection.lost(&place)) * seen.weight_at(&place)
        });
        kept.x
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::Rgb;

    #[test]
    fn means_are_those_of_the_folded_surface() {
        for roughness in [0.03, 0.1, 0.23, 0.41, 0.5, 0.77, 1.0_f32] {
            let ggx = Ggx::isotropic(roughness * roughness);
            let reflection = Reflection::of(Some(ggx));
            let curve = Curve::new(|cos| Rgb::new(1.0, 0.04 + 0.96 * (1.0 - cos).powi(5), 1.0 - 0.5 * cos));
            let seen = reflection.seen(&curve);
            let kept = reflection.mean_around(|w| {
                let place = reflection.place(w);
                (1.0 - reflection.lost(&place)) * seen.at(&place)
            });
            let told = curve.sum(&curve_means(ggx.mean_alpha()));
            assert!((told - kept).abs().max_element() < 3e-4, "{roughness}: {told} for {kept}");
        }
    }
}
