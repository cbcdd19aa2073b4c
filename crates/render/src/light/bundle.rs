//! The samples of a flat lamp at one point, several at once.
//!
//! What all samples need is worked out in lanes, without branches, so that the compiler does four or eight of them with
//! one instruction; only where something may stand in between does each lane trace its own ray.

use super::area::FlatLamp;
use super::direct::LitPoint;
use crate::phong::power;
use crate::sampler::Points;
use glam::{Vec2, Vec3};
use heliostat_scene::Rgb;

/// Samples at once.
pub(super) const LANES: usize = 16;

/// Some samples of a flat lamp and what they would send to the viewer if nothing stood in between.
pub(super) struct Bundle {
    /// Points on the lamp.
    pub(super) targets: [Vec3; LANES],
    /// What multiplies the diffuse colour.
    diffuse: [f32; LANES],
    /// What multiplies the specular colour.
    specular: [f32; LANES],
    /// Lanes that are in use.
    pub(super) count: usize,
}

impl Bundle {
    /// The next samples.
    #[inline]
    pub(super) fn draw(lamp: &FlatLamp<'_>, point: &LitPoint<'_>, samples: &mut Points) -> Self {
        let mut u = [Vec2::ZERO; LANES];
        let count = samples.next_lanes(&mut u);
        let targets = u.map(|u| lamp.flat.point(u));
        let mut bundle = Self { targets, diffuse: [0.0; LANES], specular: [0.0; LANES], count };
        let mut highlights = [0.0; LANES];
        for i in 0..LANES {
            let (to_light, share) = lamp.share(targets[i] - point.start.p);
            // Light from behind the surface is not seen, whatever the shading normal says.
            let geometric = if point.lifted { 1.0 } else { point.start.ng.dot(to_light) };
            let cos = point.ns.dot(to_light);
            let is_lit = cos > 0.0 && point.smooth.dot(to_light) > 0.0 && geometric > 0.0;
            let share = if is_lit { share } else { 0.0 };
            bundle.diffuse[i] = share * cos;
            bundle.specular[i] = share;
            highlights[i] = 2.0 * cos * point.ns.dot(point.view) - to_light.dot(point.view);
        }
        if point.fades() {
            bundle.fade(point);
        }
        // What the surface does not answer is not lit, and needs no shadow ray.
        if point.phong.diffuse == Rgb::ZERO {
            bundle.diffuse = [0.0; LANES];
        }
        if point.phong.specular == Rgb::ZERO {
            bundle.specular = [0.0; LANES];
        } else {
            for (specular, highlight) in bundle.specular.iter_mut().zip(highlights) {
                *specular *= if *specular > 0.0 { power(highlight, point.phong.shininess) } else { 0.0 };
            }
        }
        bundle
    }

    /// Weakens the light where the point says so.
    #[cold]
    fn fade(&mut self, point: &LitPoint<'_>) {
        for (i, target) in self.targets.iter().enumerate() {
            let share = point.facing((target - point.start.p).normalize_or_zero());
            self.diffuse[i] *= share;
            self.specular[i] *= share;
        }
    }

    /// Whether a lane has light to lose.
    #[inline]
    pub(super) fn is_lit(&self, lane: usize) -> bool {
        self.diffuse[lane] > 0.0 || self.specular[lane] > 0.0
    }

    /// What a lane sends to the viewer for one unit of radiance.
    #[inline]
    pub(super) fn answer(&self, lane: usize, point: &LitPoint<'_>) -> Rgb {
        self.diffuse[lane] * point.phong.diffuse + self.specular[lane] * point.phong.specular
    }

    /// The sum over all lanes.
    #[inline]
    pub(super) fn whole_answer(&self, point: &LitPoint<'_>) -> Rgb {
        let sum = |lanes: &[f32; LANES]| lanes[..self.count].iter().sum::<f32>();
        sum(&self.diffuse) * point.phong.diffuse + sum(&self.specular) * point.phong.specular
    }
}
