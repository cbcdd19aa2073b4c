//! The samples of a flat lamp at one point, several at once.

use super::area::FlatLamp;
use super::direct::LitPoint;
use crate::lanes::{self, LANES, Lanes, Mask, Vec3Lanes, lanes_of, mask, widest};
use crate::phong::power;
use crate::sampler::Points;
use glam::Vec3;
use heliostat_scene::Rgb;
use pulp::NullaryFnOnce;

/// Some samples of a flat lamp and what they would send to the viewer if nothing stood in between.
#[derive(Debug)]
pub(super) struct Bundle {
    /// Points on the lamp.
    pub(super) targets: Vec3Lanes,
    /// Irradiance on a surface that faces the light per unit of radiance; 0 where none is seen.
    share: Lanes,
    /// What multiplies the diffuse colour; 0 in lanes without light.
    diffuse: Lanes,
    /// Cosine of the angle between the mirror direction and the viewer; then what multiplies the specular colour; 0 for a
    /// point that does not shine.
    specular: Lanes,
    /// Lanes that have light to lose.
    pub(super) lit: Mask,
}

/// The work of [`Bundle::draw`] that is done in lanes: all but the highlights.
struct Draw<'a> {
    lamp: &'a FlatLamp<'a>,
    point: &'a LitPoint<'a>,
    samples: &'a mut Points,
    shines: bool,
}

impl Bundle {
    /// The next samples; highlights are left out unless the point `shines`.
    #[inline]
    pub(super) fn draw(
        lamp: &FlatLamp<'_>,
        point: &LitPoint<'_>,
        samples: &mut Points,
        shines: bool,
    ) -> Self {
        let mut bundle = widest(Draw { lamp, point, samples, shines });
        if shines {
            bundle.add_highlights(point);
        }
        if point.horizon.fades() {
            bundle.fade(point);
        }
        bundle
    }

    #[inline]
    fn add_highlights(&mut self, point: &LitPoint<'_>) {
        for i in 0..LANES {
            let is_seen = self.share[i] > 0.0;
            self.specular[i] = if is_seen { power(self.specular[i], point.phong.shininess) } else { 0.0 };
        }
        (0..LANES).for_each(|i| self.specular[i] *= self.share[i]);
        self.lit |= mask(|i| self.specular[i] > 0.0);
    }

    /// Weakens the light where the point says so.
    #[cold]
    fn fade(&mut self, point: &LitPoint<'_>) {
        for i in lanes_of(self.lit) {
            let share =
                point.horizon.facing((self.targets.get(i) - point.horizon.start.p).normalize_or_zero());
            self.diffuse[i] *= share;
            self.specular[i] *= share;
        }
        self.lit = mask(|i| self.diffuse[i] > 0.0 || self.specular[i] > 0.0);
    }

    /// The sum over all lanes of what is sent to the viewer for one unit of radiance.
    #[inline]
    pub(super) fn answer(&self, point: &LitPoint<'_>) -> Rgb {
        let diffuse = lanes::sum(self.diffuse) * point.phong.diffuse;
        if point.phong.specular == Rgb::ZERO {
            return diffuse;
        }
        diffuse + lanes::sum(self.specular) * point.phong.specular
    }

    /// [`Bundle::answer`] of what a share of the light makes.
    #[inline]
    pub(super) fn answer_to(&self, shares: &Vec3Lanes, point: &LitPoint<'_>) -> Rgb {
        let sum = |answer: &Lanes| {
            let channel = |share: &Lanes| lanes::sum(std::array::from_fn(|i| answer[i] * share[i]));
            Vec3::new(channel(&shares.x), channel(&shares.y), channel(&shares.z))
        };
        let diffuse = sum(&self.diffuse) * point.phong.diffuse;
        if point.phong.specular == Rgb::ZERO {
            return diffuse;
        }
        diffuse + sum(&self.specular) * point.phong.specular
    }
}

impl NullaryFnOnce for Draw<'_> {
    type Output = Bundle;

    #[inline(always)]
    fn call(self) -> Bundle {
        let Self { lamp, point, samples, shines } = self;
        let (mut u, mut v) = ([0.0; LANES], [0.0; LANES]);
        let count = samples.next_lanes(&mut u, &mut v) as u32;
        let targets = lamp.flat.points(&u, &v);
        let start = point.horizon.start.p;
        let mut to_light = Vec3Lanes::splat(Vec3::ZERO);
        (0..LANES).for_each(|i| to_light.set(i, targets.get(i) - start));
        let arriving = lamp.shares(&mut to_light);

        let (ns, smooth, view) = (point.ns, point.horizon.smooth, point.view);
        // Light from behind the surface is not seen, whatever the shading normal says.
        let facet = if point.horizon.lifted { smooth } else { point.horizon.start.ng };
        let view_cos = 2.0 * ns.dot(view);
        let answers = if point.phong.diffuse == Rgb::ZERO { 0.0 } else { 1.0 };
        let (mut share, mut diffuse, mut specular) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            let to_light = to_light.get(i);
            let cos = ns.dot(to_light);
            let is_above = (cos > 0.0) & (smooth.dot(to_light) > 0.0) & (facet.dot(to_light) > 0.0);
            let is_seen = is_above & ((i as u32) < count);
            share[i] = if is_seen { arriving[i] } else { 0.0 };
            // What the surface does not answer is not lit, and needs no shadow ray.
            diffuse[i] = if is_seen { answers * arriving[i] * cos } else { 0.0 };
            specular[i] = cos * view_cos - to_light.dot(view);
        }
        if !shines {
            specular = [0.0; LANES];
        }
        let lit = mask(|i| diffuse[i] > 0.0);
        Bundle { targets, share, diffuse, specular, lit }
    }
}
